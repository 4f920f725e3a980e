//! What can be wrong with a `.npy` file.

use crate::shown::shown;

/// What is wrong with a `.npy` file.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum NpyFault {
    /// The first bytes are not those of such a file.
    #[error("this is no .npy file")]
    NotNpy,
    /// The version of the format is unknown.
    #[error("version {major}.{minor} of .npy files is not read, only 1.0, 2.0 and 3.0")]
    Version {
        /// The first number.
        major: u8,
        /// The second.
        minor: u8,
    },
    /// The header makes no sense.
    #[error("byte {at} of the header's text: {fault}")]
    Header {
        /// Bytes from the beginning of the text.
        at: usize,
        /// What is wrong there.
        fault: &'static str,
    },
    /// The elements are not real numbers.
    #[error(
        "the elements have type '{}', which is not read, only f2, f4 and f8",
        shown(descr)
    )]
    Type {
        /// The type as the file names it.
        descr: String,
    },
    /// The array has not three sides, and not three components at each of their places.
    #[error(
        "an array of shape {} is no volume: three sides are read, or four of which the last is 3",
        shape_text(shape)
    )]
    Shape {
        /// Its sides.
        shape: Vec<u64>,
    },
    /// There are more or fewer bytes than the shape needs.
    #[error("the shape needs {needed} bytes, but {held} follow the header")]
    Length {
        /// Bytes of all elements; `u64::MAX` where that overflows.
        needed: u64,
        /// Bytes there are.
        held: u64,
    },
}

fn shape_text(shape: &[u64]) -> String {
    let sides: Vec<_> = shape.iter().take(8).map(u64::to_string).collect();
    format!("({})", sides.join(", "))
}
