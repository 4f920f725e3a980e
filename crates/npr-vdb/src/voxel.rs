//! What voxels hold, and how files store it.

use crate::half::f32_from_half;

/// What the voxels of a grid hold in the file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ValueType {
    /// `bool`, read as 0 and 1.
    Bool,
    /// `int32`, rounded to single precision.
    Int32,
    /// `int64`, rounded to single precision.
    Int64,
    /// `float`.
    Float,
    /// `double`, rounded to single precision.
    Double,
    /// `vec3i`, components rounded to single precision.
    Vec3i,
    /// `vec3s`: vectors of `float`.
    Vec3s,
    /// `vec3d`: vectors of `double`, components rounded to single precision.
    Vec3d,
}

impl ValueType {
    /// All of them.
    pub const ALL: [Self; 8] = [
        Self::Bool,
        Self::Int32,
        Self::Int64,
        Self::Float,
        Self::Double,
        Self::Vec3i,
        Self::Vec3s,
        Self::Vec3d,
    ];

    /// The name that files use.
    pub fn name(self) -> &'static str {
        match self {
            Self::Bool => "bool",
            Self::Int32 => "int32",
            Self::Int64 => "int64",
            Self::Float => "float",
            Self::Double => "double",
            Self::Vec3i => "vec3i",
            Self::Vec3s => "vec3s",
            Self::Vec3d => "vec3d",
        }
    }

    /// The type of this name.
    pub(crate) fn of_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }

    /// Whether it has three components.
    pub fn is_vector(self) -> bool {
        matches!(self, Self::Vec3i | Self::Vec3s | Self::Vec3d)
    }

    /// How each component is stored; `is_half` where real numbers are stored as half floats.
    pub(crate) fn number(self, is_half: bool) -> Number {
        match self {
            Self::Bool => Number::Bool,
            Self::Int32 | Self::Vec3i => Number::Int32,
            Self::Int64 => Number::Int64,
            _ if is_half => Number::Half,
            Self::Float | Self::Vec3s => Number::Float,
            Self::Double | Self::Vec3d => Number::Double,
        }
    }
}

impl std::fmt::Display for ValueType {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str(self.name())
    }
}

/// How a number is stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Number {
    Bool,
    Int32,
    Int64,
    Half,
    Float,
    Double,
}

impl Number {
    /// Bytes of one.
    pub(crate) fn bytes(self) -> usize {
        match self {
            Self::Bool => 1,
            Self::Half => 2,
            Self::Int32 | Self::Float => 4,
            Self::Int64 | Self::Double => 8,
        }
    }

    /// Fills `numbers` with the numbers of `bytes`, rounded to single precision.
    pub(crate) fn decode(self, bytes: &[u8], numbers: &mut Vec<f32>) {
        numbers.clear();
        match self {
            Self::Bool => numbers.extend(bytes.iter().map(|&byte| f32::from(u8::from(byte != 0)))),
            Self::Int32 => extend(bytes, numbers, |b| i32::from_le_bytes(b) as f32),
            Self::Int64 => extend(bytes, numbers, |b| i64::from_le_bytes(b) as f32),
            Self::Half => extend(bytes, numbers, |b| f32_from_half(u16::from_le_bytes(b))),
            Self::Float => extend(bytes, numbers, f32::from_le_bytes),
            Self::Double => extend(bytes, numbers, |b| f64::from_le_bytes(b) as f32),
        }
    }
}

fn extend<const N: usize>(bytes: &[u8], numbers: &mut Vec<f32>, number: impl Fn([u8; N]) -> f32) {
    numbers.extend(bytes.as_chunks().0.iter().map(|&bytes| number(bytes)));
}

/// What a voxel holds once it is read: `f32` or `[f32; 3]`. Nothing else implements it.
pub trait Voxel:
    Copy + PartialEq + std::fmt::Debug + Send + Sync + sealed::Parts + 'static
{
}

impl Voxel for f32 {}
impl Voxel for [f32; 3] {}

pub(crate) mod sealed {
    /// A voxel's components.
    pub trait Parts: Sized {
        /// How many components there are.
        const COUNT: usize;

        /// All components zero.
        const ZERO: Self;

        /// Appends one voxel for every `COUNT` numbers.
        fn gather(numbers: &[f32], voxels: &mut Vec<Self>);

        /// Every component changed by `change`.
        fn map(self, change: impl Fn(f32) -> f32) -> Self;

        /// Whether the bits are the same, so that NaN equals itself.
        fn is_same(&self, other: &Self) -> bool;
    }

    impl Parts for f32 {
        const COUNT: usize = 1;
        const ZERO: Self = 0.0;

        fn gather(numbers: &[f32], voxels: &mut Vec<Self>) {
            voxels.extend_from_slice(numbers);
        }

        fn map(self, change: impl Fn(f32) -> f32) -> Self {
            change(self)
        }

        fn is_same(&self, other: &Self) -> bool {
            self.to_bits() == other.to_bits()
        }
    }

    impl Parts for [f32; 3] {
        const COUNT: usize = 3;
        const ZERO: Self = [0.0; 3];

        fn gather(numbers: &[f32], voxels: &mut Vec<Self>) {
            voxels.extend_from_slice(numbers.as_chunks().0);
        }

        fn map(self, change: impl Fn(f32) -> f32) -> Self {
            <[f32; 3]>::map(self, change)
        }

        fn is_same(&self, other: &Self) -> bool {
            <[f32; 3]>::map(*self, f32::to_bits) == other.map(f32::to_bits)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::sealed::Parts;
    use super::*;

    #[test]
    fn numbers_are_read_in_every_storage() {
        let mut numbers = Vec::new();
        let mut decode = |number: Number, bytes: &[u8]| {
            number.decode(bytes, &mut numbers);
            numbers.clone()
        };
        assert_eq!(decode(Number::Bool, &[0, 1, 7]), [0.0, 1.0, 1.0]);
        assert_eq!(decode(Number::Int32, &(-3i32).to_le_bytes()), [-3.0]);
        assert_eq!(
            decode(Number::Int64, &(1i64 << 40).to_le_bytes()),
            [1_099_511_627_776.0]
        );
        assert_eq!(decode(Number::Half, &[0, 0x3c, 0, 0xc0]), [1.0, -2.0]);
        assert_eq!(decode(Number::Float, &2.5f32.to_le_bytes()), [2.5]);
        assert_eq!(
            decode(Number::Double, &1e300f64.to_le_bytes()),
            [f32::INFINITY]
        );
    }

    #[test]
    fn not_a_number_is_the_same_as_itself() {
        assert!(f32::NAN.is_same(&f32::NAN));
        assert!(!0.0f32.is_same(&-0.0));
        assert!([1.0, f32::NAN, 2.0].is_same(&[1.0, f32::NAN, 2.0]));
    }

    #[test]
    fn names_lead_back_to_their_types() {
        for kind in ValueType::ALL {
            assert_eq!(ValueType::of_name(kind.name()), Some(kind));
        }
        assert_eq!(ValueType::of_name("ptdataidx32"), None);
    }
}
