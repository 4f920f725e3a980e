//! Why a picture cannot be filled, and how large it may be.

/// Longest side of a picture in pixels, so that areas on the grid fit into 64 bits.
pub const LONGEST_SIDE: u32 = 1 << 20;

/// Why a picture could not be filled.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FillError {
    /// The picture is too large.
    #[error("the picture has a side of {side} pixels, but can be filled up to {LONGEST_SIDE}")]
    TooLarge {
        /// The longer side in pixels.
        side: u32,
    },
    /// Lines cross each other too often, or too many lie in one place.
    #[error("lines cross too often to be filled between")]
    TooManyCrossings,
    /// The lines could not be triangulated.
    #[error("lines cannot be triangulated: {0}")]
    Triangulation(#[from] spade::InsertionError),
}
