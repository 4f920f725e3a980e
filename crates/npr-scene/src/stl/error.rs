//! What can be wrong with an STL file.

use super::binary::HEADER_BYTES;

/// What is wrong with an STL file.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum StlError {
    /// The file is too short for a header.
    #[error("the file has {bytes} bytes, but the header alone takes {HEADER_BYTES}")]
    NoHeader {
        /// Size of the file.
        bytes: usize,
    },
    /// The file ends before its last triangle.
    #[error("the header announces {stated} triangles, but the file holds only {held}")]
    Truncated {
        /// How many triangles the header announces.
        stated: u32,
        /// How many whole triangles follow.
        held: usize,
    },
    /// A line of a text file makes no sense.
    #[error("line {line}: {fault}")]
    Line {
        /// Line, counted from 1.
        line: usize,
        /// What is wrong there.
        fault: &'static str,
    },
}
