//! A piece of line as drawn in a view.

use crate::mesh_lines::visibility::{Piece, Span};
use crate::stroke::Kind;

/// The piece of line after a node, as drawn in a view.
#[derive(Debug, Clone, PartialEq)]
pub struct Line {
    /// The kind that it is drawn as.
    pub kind: Kind,
    /// Surface that it lies on.
    pub surface: u32,
    /// Where it lies.
    pub piece: Piece,
    /// Its visible and hidden spans; gaps between them are left out.
    pub spans: Vec<Span>,
}
