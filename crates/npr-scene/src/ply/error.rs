//! What can be wrong with a PLY file.

/// What is wrong with a PLY file.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum PlyError {
    /// A line of the header makes no sense.
    #[error("line {line}: {fault}")]
    Header {
        /// Line, counted from 1.
        line: usize,
        /// What is wrong there.
        fault: &'static str,
    },
    /// The file ends early, or something else stands where a number should.
    #[error(
        "{} {row} of {count} is cut off or holds no number",
        crate::shown::shown(element)
    )]
    Row {
        /// Name of the element.
        element: String,
        /// Which one, counted from 0.
        row: u64,
        /// How many the header announces.
        count: u64,
    },
    /// Vertices have no positions.
    #[error("the vertices have no x, y and z")]
    NoPositions,
    /// An edge names a vertex that does not exist.
    #[error("edge {edge} uses vertex {vertex}, but the file has only {vertex_count}")]
    MissingEnd {
        /// Which edge, counted from 0.
        edge: usize,
        /// The vertex index as read; 0 where it is none.
        vertex: i64,
        /// How many vertices there are.
        vertex_count: usize,
    },
    /// A face names a vertex that does not exist.
    #[error("face {face} uses vertex {vertex}, but the file has only {vertex_count}")]
    MissingVertex {
        /// Which face, counted from 0.
        face: usize,
        /// The vertex index as read.
        vertex: i64,
        /// How many vertices there are.
        vertex_count: usize,
    },
}
