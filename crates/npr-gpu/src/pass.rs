//! The parts of a pass: a shader, the buffers it binds, and a twin that does the same in Rust.

use bytemuck::{AnyBitPattern, NoUninit};
use npr_core::layout::{Field, GpuLayout};
pub use npr_shaders::Features;
use npr_shaders::Shader;
pub use npr_vector::rank::scan::RUN;

/// Invocations per workgroup of every compute pass: `WG` of the shaders.
pub const WORKGROUP_SIZE: u32 = 64;

/// One step of a frame, on either engine.
#[derive(Debug, Clone, Copy)]
pub struct Pass {
    /// `domain.verb_object`; also the shader's path with a dot.
    pub name: &'static str,
    /// The WGSL side.
    pub shader: Shader,
    /// The slots that it binds, in binding order of group 0.
    pub slots: &'static [Slot],
    /// The amount of work.
    pub work: Work,
    /// How closely a device must match the twin.
    pub agreement: Agreement,
    /// The Rust side.
    pub twin: fn(&mut Bindings<'_>),
}

/// The amount of work of a pass.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Work {
    /// One invocation of `main` per element of the named slot.
    PerElement {
        /// The slot that is counted.
        of: &'static str,
    },
    /// One invocation of `main` per run of [`RUN`] elements of the named slot.
    PerRun {
        /// The slot that is counted.
        of: &'static str,
    },
    /// One invocation of `main` per element of a list, which begins with their number.
    PerListed {
        /// The slot that holds the list.
        of: &'static str,
    },
    /// Triangles without vertex buffers: entry points `vertex` and `fragment`. Of indices there is one vertex each.
    Draw {
        /// The slot that is counted.
        of: &'static str,
        /// Vertices per element.
        vertices: u32,
        /// The images that are drawn into; a depth image last. Depth is reversed: greater wins, equal keeps the earlier
        /// one.
        targets: &'static [Format],
        /// Whether the twin writes every texel that a device clears or draws, so that nothing is cleared before it.
        fills: bool,
    },
}

/// The content of one texel of an image, of 4 bytes each.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// One unsigned integer.
    U32,
    /// Four bytes read and written as 0..1.
    Rgba8,
    /// Reversed depth 0..1.
    Depth,
}

/// A resource that a pass binds.
#[derive(Debug, Clone, Copy)]
pub struct Slot {
    /// Its name in the shader.
    pub name: &'static str,
    /// How it is bound.
    pub access: Access,
    /// The elements that it holds; texels for images.
    pub element: Element,
    /// The features without any of which a device leaves it out.
    pub serves: Features,
    /// Whether the twin alone reads it: a device finds the same in another slot.
    pub is_for_twin: bool,
}

impl Slot {
    /// The same slot, left out where a frame needs none of `features`.
    #[must_use]
    pub const fn serving(self, features: Features) -> Self {
        Self {
            serves: features,
            ..self
        }
    }

    /// The same slot for the twin alone; slots of this kind are the last ones.
    #[must_use]
    pub const fn for_twin(self) -> Self {
        Self {
            is_for_twin: true,
            ..self
        }
    }

    /// Whether a shader for `features` binds it.
    pub fn is_bound_for(&self, features: Features) -> bool {
        self.access != Access::Indices && self.is_read_for(features)
    }

    /// Whether a device reads or writes it for `features`, bound or as indices.
    pub fn is_read_for(&self, features: Features) -> bool {
        !self.is_for_twin && self.serves.serve(features)
    }
}

/// How a slot is bound.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Access {
    /// One struct in a uniform buffer.
    Uniform,
    /// An array in a storage buffer that is read.
    Read,
    /// An array in a storage buffer that is written, in whole.
    Write,
    /// An array in a storage buffer whose elements are read and then written anew.
    Update,
    /// An array in a storage buffer that is 0 before the pass, which writes some of its elements.
    Scatter,
    /// The index buffer of a draw: the element of every vertex. Shaders see `vertex_index` alone.
    Indices,
    /// A list in a storage buffer that invocations append to: the number of its elements, which is 0 before the pass,
    /// then the elements in any order.
    Append,
    /// An image of one layer whose texels are loaded.
    Texture(Format),
    /// An image of any number of layers whose texels are loaded.
    Layered(Format),
}

impl Access {
    /// Whether the pass changes what the slot binds.
    pub fn writes(self) -> bool {
        matches!(
            self,
            Self::Write | Self::Update | Self::Scatter | Self::Append
        )
    }

    /// What the texels of an image hold, where it binds one.
    pub fn image_format(self) -> Option<Format> {
        match self {
            Self::Texture(format) | Self::Layered(format) => Some(format),
            _ => None,
        }
    }
}

/// The layout of an element, as the Rust side sees it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Element {
    /// Struct name, or WGSL type of a scalar.
    pub name: &'static str,
    /// Bytes from one element to the next.
    pub size: usize,
    /// Fields of a struct.
    pub fields: &'static [Field],
}

impl Element {
    /// The layout of `T`.
    pub const fn of<T: GpuLayout>() -> Self {
        Self {
            name: T::NAME,
            size: size_of::<T>(),
            fields: T::FIELDS,
        }
    }
}

/// How closely a device must match the twin, element by element.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Agreement {
    /// The same bits.
    Exact,
    /// Every float field within this relative bound (against the larger magnitude, at least 1); integers exact.
    Relative(f32),
    /// The same, except for a share of elements, where a place lies on the edge of a shadow.
    NearlyAll {
        /// Share of elements that may differ.
        share: f32,
        /// Relative bound of all others.
        bound: f32,
    },
    /// Pictures: at most this share of texels may differ by more than 2 of 255 in a channel.
    Texels(f32),
}

/// A uniform slot.
pub const fn uniform<T: GpuLayout>(name: &'static str) -> Slot {
    Slot {
        name,
        access: Access::Uniform,
        element: Element::of::<T>(),
        serves: Features::NONE,
        is_for_twin: false,
    }
}

/// A slot that is read.
pub const fn read<T: GpuLayout>(name: &'static str) -> Slot {
    Slot {
        name,
        access: Access::Read,
        element: Element::of::<T>(),
        serves: Features::NONE,
        is_for_twin: false,
    }
}

/// A slot that is written.
pub const fn write<T: GpuLayout>(name: &'static str) -> Slot {
    Slot {
        name,
        access: Access::Write,
        element: Element::of::<T>(),
        serves: Features::NONE,
        is_for_twin: false,
    }
}

/// A slot whose elements are read and written anew.
pub const fn update<T: GpuLayout>(name: &'static str) -> Slot {
    Slot {
        access: Access::Update,
        ..write::<T>(name)
    }
}

/// A slot of which some elements are written; the others become 0.
pub const fn scatter<T: GpuLayout>(name: &'static str) -> Slot {
    Slot {
        access: Access::Scatter,
        ..write::<T>(name)
    }
}

/// The indices of a draw: three vertices a triangle, shaded once where triangles share them. It comes after the slots
/// that shaders bind.
pub const fn indices(name: &'static str) -> Slot {
    Slot {
        access: Access::Indices,
        ..read::<u32>(name)
    }
}

/// A list that is appended to.
pub const fn append(name: &'static str) -> Slot {
    Slot {
        access: Access::Append,
        ..write::<u32>(name)
    }
}

/// An image slot whose texels are loaded.
pub const fn texture(name: &'static str, format: Format) -> Slot {
    Slot {
        name,
        access: Access::Texture(format),
        element: Element::of::<u32>(),
        serves: Features::NONE,
        is_for_twin: false,
    }
}

/// An image slot of any number of layers whose texels are loaded.
pub const fn layered(name: &'static str, format: Format) -> Slot {
    Slot {
        access: Access::Layered(format),
        ..texture(name, format)
    }
}

impl Pass {
    /// The images that the pass draws into, none for compute passes.
    pub fn targets(&self) -> &'static [Format] {
        match self.work {
            Work::PerElement { .. } | Work::PerRun { .. } | Work::PerListed { .. } => &[],
            Work::Draw { targets, .. } => targets,
        }
    }

    /// The part of `features` that decides what a device compiles for the pass.
    pub fn deciding(&self, features: Features) -> Features {
        let text = npr_shaders::deciding(&self.shader, features);
        let slots = self.slots.iter().map(|slot| slot.serves);
        features.and(slots.fold(text, Features::or))
    }

    /// Vertices drawn for each element, none for compute passes.
    pub fn vertices(&self) -> u32 {
        match self.work {
            Work::PerElement { .. } | Work::PerRun { .. } | Work::PerListed { .. } => 0,
            Work::Draw { vertices, .. } => vertices,
        }
    }

    /// The position of the slot that counts the work.
    ///
    /// # Panics
    ///
    /// When the declaration names a slot that it does not list.
    pub fn counted_slot(&self) -> usize {
        let (Work::PerElement { of }
        | Work::PerRun { of }
        | Work::PerListed { of }
        | Work::Draw { of, .. }) = self.work;
        let found = self.slots.iter().position(|slot| slot.name == of);
        found.unwrap_or_else(|| {
            panic!(
                "pass {} counts '{of}', which is none of its slots",
                self.name
            )
        })
    }
}

/// An image as a twin reads it.
#[derive(Debug, Clone, Copy)]
pub struct Image<'a> {
    /// Width and height.
    pub size: [u32; 2],
    /// Texels, layer by layer, row by row from the top: integers, packed bytes, or float bits.
    pub texels: &'a [u32],
}

/// A layer of an image as a twin writes it.
#[derive(Debug)]
pub struct ImageMut<'a> {
    /// Width and height.
    pub size: [u32; 2],
    /// Texels, row by row from the top.
    pub texels: &'a mut [u32],
}

/// The resources that a node binds, handed to its pass's twin: the slots in order, then the targets.
#[derive(Debug)]
pub struct Bindings<'a> {
    pub(crate) bound: Vec<Bound<'a>>,
}

#[derive(Debug)]
pub(crate) enum Bound<'a> {
    Read {
        words: &'a [u32],
        size: [u32; 2],
    },
    Write {
        words: &'a mut [u32],
        size: [u32; 2],
    },
    Taken,
}

impl<'a> Bindings<'a> {
    /// The struct of uniform slot `index`.
    ///
    /// # Panics
    ///
    /// When the declaration binds something else there; so do the methods below.
    pub fn one<T: AnyBitPattern>(&self, index: usize) -> T {
        let elements: &[T] = self.read(index);
        elements[0]
    }

    /// The elements of slot `index`, which is read.
    pub fn read<T: AnyBitPattern>(&self, index: usize) -> &'a [T] {
        bytemuck::cast_slice(self.image(index).texels)
    }

    /// The elements of slot `index`, which is written or updated; can be taken once.
    pub fn write<T: NoUninit + AnyBitPattern>(&mut self, index: usize) -> &'a mut [T] {
        bytemuck::cast_slice_mut(self.image_mut(index).texels)
    }

    /// The image of slot `index`.
    pub fn image(&self, index: usize) -> Image<'a> {
        match self.bound[index] {
            Bound::Read { words, size } => Image {
                size,
                texels: words,
            },
            _ => panic!("binding {index} is not read"),
        }
    }

    /// The texels of each layer of the image of slot `index`; none of those that it does not have.
    pub fn layers<const N: usize>(&self, index: usize) -> [&'a [u32]; N] {
        let Image { size, texels } = self.image(index);
        let area = size[0] as usize * size[1] as usize;
        let mut layers = texels.chunks_exact(area.max(1));
        std::array::from_fn(|_| layers.next().unwrap_or_default())
    }

    /// The target `index`, counted after the slots; can be taken once.
    pub fn image_mut(&mut self, index: usize) -> ImageMut<'a> {
        match std::mem::replace(&mut self.bound[index], Bound::Taken) {
            Bound::Write { words, size } => ImageMut {
                size,
                texels: words,
            },
            _ => panic!("binding {index} is not written, or was taken before"),
        }
    }
}
