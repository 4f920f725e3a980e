//! Struct layouts that shaders are checked against.

use bytemuck::Pod;

/// A field of a struct that lives in GPU memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Field {
    /// Its name, the same in Rust and in WGSL.
    pub name: &'static str,
    /// Bytes from the start of the struct.
    pub offset: usize,
}

/// A plain struct (or scalar) with the same layout in Rust and in WGSL.
///
/// Implement it with [`gpu_layout!`](crate::gpu_layout), never by hand: the shader test compares every
/// shader's structs with it, so a field that moves on one side alone fails.
pub trait GpuLayout: Pod + Send + Sync {
    /// The struct's name, the same in Rust and in WGSL; the WGSL type for scalars and vectors.
    const NAME: &'static str;
    /// Fields in order; empty for scalars and vectors.
    const FIELDS: &'static [Field];
}

/// Declares that a `#[repr(C)]` struct has a WGSL twin with the same field names and offsets.
///
/// ```
/// #[repr(C)]
/// #[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
/// struct Hop { next: u32, dist: u32 }
/// npr_core::gpu_layout!(Hop { next, dist });
/// ```
#[macro_export]
macro_rules! gpu_layout {
    ($name:ident { $($field:ident),+ $(,)? }) => {
        impl $crate::layout::GpuLayout for $name {
            const NAME: &'static str = stringify!($name);
            const FIELDS: &'static [$crate::layout::Field] = &[
                $($crate::layout::Field {
                    name: stringify!($field),
                    offset: ::core::mem::offset_of!($name, $field),
                }),+
            ];
        }
    };
}

macro_rules! gpu_scalar {
    ($($rust:ty => $wgsl:literal),+) => {
        $(impl GpuLayout for $rust {
            const NAME: &'static str = $wgsl;
            const FIELDS: &'static [Field] = &[];
        })+
    };
}

gpu_scalar!(u32 => "u32", i32 => "i32", f32 => "f32", [f32; 2] => "vec2<f32>", [f32; 4] => "vec4<f32>",
    [u32; 2] => "vec2<u32>", [u32; 4] => "vec4<u32>", [[f32; 4]; 4] => "mat4x4<f32>");
