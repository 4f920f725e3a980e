//! Smooth contours: the zero set of interpolated n.v, linked [Hertzmann & Zorin 2000].
//!
//! At every corner of a face stands a normal; `g = n . (eye - p)` there, interpolated along edges, is zero on lines
//! that cross faces. They are smoother than contours along mesh edges, and degree and direction come for free: a face
//! has at most one piece, with the front (`g >= 0`) on its left.
//!
//! Where normals break, at creases, the front may end at the edge itself. Lines then go on along the edge up to where
//! both sides agree again, so that nothing slides off sharp edges: without borders of the surface all lines are
//! closed.
//!
//! On coarse meshes interpolated contours leave the polygon's outline. So any set of faces may be declared flat
//! ([`FlatFaces`]): a flat face is front or back as a whole, by its own plane, and lines run along the edges around
//! it. With all faces flat the lines are those of [`crate::mesh_lines::contour`], without the borders.
//! [`PolygonOutline::flat_faces`] chooses the flat faces that a picture needs.

mod agree;
mod cusp;
mod normals;
mod patches;
mod segment_grid;
mod signs;
mod trace;

pub use agree::{PolygonOutline, SeenContour};
pub use normals::CornerNormals;
pub use segment_grid::{Nearest, SegmentGrid, snap_to_outline};
pub use signs::{END_GAP, FlatFaces};

use crate::mesh_lines::graph::CurveGraph;
use npr_core::geometry::NONE;
use npr_mesh::half_edge::HalfEdgeMesh;
use signs::Signs;

/// The border between front and back: closed lines, and open ones that end at borders of the surface.
///
/// Nodes are ordered by edge and half-edge. A piece either crosses its node's face, or runs along its node's edge with
/// the node's face as front; the latter may cover a part of the edge. All have
/// [`CONTOUR`](npr_core::line_kind::KindSet::CONTOUR), except the last node of an open line, which has no piece.
/// Pieces that their own surface hides are marked [`CONCAVE`](npr_core::edge_flags::EdgeFlags::CONCAVE), changes of
/// that [`CUSP`](npr_core::edge_flags::EdgeFlags::CUSP).
///
/// `eye` is homogeneous, in the world: a point with `w = 1`, or the direction towards a parallel camera with `w = 0`.
///
/// O(faces + n log n) for n nodes, on all threads; the same for any number of them.
pub fn zero_set(
    shape: &HalfEdgeMesh,
    normals: &CornerNormals,
    eye: [f64; 4],
    flat: &FlatFaces,
) -> CurveGraph {
    let signs = Signs::new(shape, normals, flat, eye);
    let mut traced = trace::trace(&signs);
    cusp::mark_cusps(&signs, &mut traced);
    traced.graph
}

/// Whether the piece after a node of [`zero_set`]'s graph runs along the node's edge; others cross the node's face.
///
/// The part of the edge that it covers runs from the node's place to that of the next node, if that lies on the same
/// edge, else to the end of the edge. False at the end of a line.
pub fn runs_along_edge(graph: &CurveGraph, node: u32) -> bool {
    let node = &graph.nodes[node as usize];
    if node.next == NONE {
        return false;
    }
    // Pieces through faces end inside another edge of the face.
    let next = &graph.nodes[node.next as usize];
    next.edge == node.edge || next.t == 0.0 || next.t == 1.0
}

#[cfg(test)]
mod tests;
