//! What hides lines besides the faces of the shape.

use super::Piece;
use glam::DVec3;
use std::fmt;

/// What hides lines besides the faces of the shape, as smoke does; it counts as one surface.
pub trait Occluders: fmt::Debug + Sync {
    /// Shares of a piece's image at which it may begin or end being hidden, in no order.
    fn cuts(&self, piece: &Piece) -> Vec<f64>;

    /// Whether a point of the world is hidden.
    fn hide(&self, world: DVec3) -> bool;
}
