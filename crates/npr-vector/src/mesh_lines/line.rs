//! A piece of line as drawn in a view.

use crate::mesh_lines::visibility::{Piece, Span};
use crate::stroke::Kind;

/// The piece of line after a node, as drawn in a view.
#[derive(Debug, Clone, PartialEq)]
pub struct Line {
    /// What it is drawn as.
    pub kind: Kind,
    /// Surface that it lies on.
    pub surface: u32,
    /// Where it lies.
    pub piece: Piece,
    /// What is seen of it; gaps between them are left out.
    pub spans: Vec<Span>,
}
