//! Objects that hide lines besides the faces of the shape.

use super::Piece;
use glam::DVec3;
use std::fmt;

/// Something that hides lines besides the faces of the shape, as smoke does; it counts as one surface.
pub trait Occluders: fmt::Debug + Sync {
    /// Shares of a piece's image at which it may begin or end hiding the piece, in no order.
    fn cuts(&self, piece: &Piece) -> Vec<f64>;

    /// Whether it hides a point of the world.
    fn hide(&self, world: DVec3) -> bool;
}
