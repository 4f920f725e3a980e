//! Lines where surfaces cut through each other, and places where mesh edges go through faces.
//!
//! Which edge pierces which face is decided once, by exact signs of volumes, with ties broken as if every
//! coordinate were moved by an infinitesimal of its own [Edelsbrunner & Mücke 1990]. Moved so, two faces have
//! nothing or one segment in common, and segments of neighbouring faces share their ends: lines never
//! break at mesh edges, and on closed surfaces they close.
//!
//! What the infinitesimals invent is taken away again: where surfaces only touch, along an edge or over an area,
//! there is no line. Faces in one plane have none in common, so a line that runs into such an area ends at its rim.

mod cut;
mod link;
mod pairs;
mod rows;
mod side;
#[cfg(test)]
mod tests;

use crate::mesh_lines::bvh::FaceTree;
use crate::mesh_lines::graph::CurveGraph;
use cut::Segment;
use npr_core::budget::{Budget, OverBudget};
use npr_mesh::half_edge::HalfEdgeMesh;
use rayon::prelude::*;

/// Most pairs of faces that are decided exactly, beside [`PAIRS_PER_FACE`] for every face: a second of work.
///
/// Where thousands of faces all overlap each other, pairs grow with the square of their number.
pub const PAIRS: usize = 1 << 18;

/// Most pairs of faces that are decided exactly, for every face of the shape.
pub const PAIRS_PER_FACE: usize = 16;

/// Most pieces of intersection that become lines, beside [`PAIRS_PER_FACE`] for every face: each is compared with all
/// outlines before it.
///
/// Where a thousand faces all cut each other, nobody could read the lines.
pub const PIECES: usize = 1 << 15;

/// A place where a mesh edge goes through the inside of a face that it does not touch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Piercing {
    /// The unique mesh edge.
    pub edge: u32,
    /// Where on the edge: 0 at its lower vertex, 1 at its higher.
    pub t: f32,
    /// The face that is pierced.
    pub face: u32,
}

/// Where the surfaces of a shape cut each other.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Crossings {
    /// Lines of intersection; two nodes that follow each other are the ends of the piece that two faces share.
    ///
    /// Nodes carry [`KindSet::INTERSECTION`](npr_core::line_kind::KindSet::INTERSECTION) and the lower of the
    /// two faces. Where other than two pieces meet, on a border, at an edge of three faces or at a vertex shared by
    /// surfaces that cut each other, lines end; closed ones run on to their first node.
    pub graph: CurveGraph,
    /// All piercings by edge, place and face.
    ///
    /// An edge that starts or ends on a face counts for one of its sides, so that a path along edges through a
    /// face is counted once. Edges that lie in the plane of a face pierce nothing.
    pub piercings: Vec<Piercing>,
    /// Too many faces overlap, [`PAIRS`] and [`PAIRS_PER_FACE`], so that lines and piercings are missing; or too many
    /// cut each other, [`PIECES`], so that there are no lines.
    pub overflow: bool,
}

impl Crossings {
    /// The piercings at a place of an edge. O(log n).
    pub fn at(&self, edge: u32, t: f32) -> &[Piercing] {
        let of_edge = self.of_edge(edge);
        let from = of_edge.partition_point(|p| p.t < t);
        &of_edge[from..from + of_edge[from..].partition_point(|p| p.t == t)]
    }

    /// The piercings of an edge, by place. O(log n).
    pub fn of_edge(&self, edge: u32) -> &[Piercing] {
        let from = self.piercings.partition_point(|p| p.edge < edge);
        let count = self.piercings[from..].partition_point(|p| p.edge == edge);
        &self.piercings[from..from + count]
    }
}

/// All places where faces of a shape cut each other.
///
/// Exact for any finite positions, the same for any number of threads. About O(n log n) in faces plus the number of
/// overlapping pairs, which is bounded; memory likewise. Faces that share an edge meet there alone.
///
/// # Errors
///
/// [`OverBudget`] where there is no memory for the pairs.
pub fn crossings(
    shape: &HalfEdgeMesh,
    tree: &FaceTree,
    budget: &mut Budget,
) -> Result<Crossings, OverBudget> {
    // Find pairs of faces that overlap.
    let limit = PAIRS + PAIRS_PER_FACE * shape.faces.len();
    let bytes = size_of::<[u32; 2]>() + size_of::<Segment>() + 2 * size_of::<Piercing>();
    let found = pairs::find(shape, tree, limit, &mut |count| {
        budget.take("pairs of faces that overlap", count, bytes)
    })?;

    // Cut each pair, and note where edges go through faces.
    let mut segments: Vec<Segment> = found
        .pairs
        .par_iter()
        .filter_map(|pair| cut::cut(shape, *pair))
        .collect();
    let piercings = piercings(&segments);
    segments.retain(|segment| !segment.contact);

    // Give up intersections so dense that nobody could read them.
    let is_dense = segments.len() > PIECES + PAIRS_PER_FACE * shape.faces.len();
    if is_dense {
        segments.clear();
    }

    // Link what is left.
    segments.par_sort_unstable_by_key(|segment| segment.faces);
    Ok(Crossings {
        graph: link::link(shape, &segments),
        piercings,
        overflow: found.overflow || is_dense,
    })
}

/// Every piercing once, although it ends segments on all faces of its edge.
fn piercings(segments: &[Segment]) -> Vec<Piercing> {
    let ends = segments.par_iter().flat_map_iter(|segment| segment.ends);
    let mut piercings: Vec<Piercing> = ends
        .filter(|end| end.pierces)
        .map(|end| Piercing {
            edge: end.edge,
            t: end.t,
            face: end.key[1],
        })
        .collect();
    piercings.par_sort_unstable_by(|a, b| {
        let edges = a.edge.cmp(&b.edge);
        edges.then(a.t.total_cmp(&b.t)).then(a.face.cmp(&b.face))
    });
    piercings.dedup();
    piercings
}
