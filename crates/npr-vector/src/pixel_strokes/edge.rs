//! Edges of a shape for drawing into the picture: which are drawn, as which kind, and in which direction.
//!
//! [`mark_edges`] is the twin of `vector.mark_edges`.

use crate::mesh_lines::contour::Eye;
use crate::mesh_lines::contour::steps::{Viewer, is_raised};
use crate::mesh_lines::feature::static_flags;
use bytemuck::{Pod, Zeroable};
use npr_core::crease::Creases;
use npr_core::edge_flags::EdgeFlags;
use npr_core::geometry::NONE;
use npr_core::gpu_layout;
use npr_core::line_kind::KindSet;
use npr_mesh::half_edge::HalfEdgeMesh;
use rayon::prelude::*;

/// A unique edge with the faces beside it.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct DrawnEdge {
    /// The vertex that the edge runs from, around its first face.
    pub tail: u32,
    /// The vertex that it runs to.
    pub head: u32,
    /// Its first face.
    pub face: u32,
    /// Its second face, or [`NONE`].
    pub across: u32,
    /// Corner of the second face that is not on the edge.
    pub beyond: u32,
    /// Corner of the first face that is not on the edge.
    pub beside: u32,
    /// Bits of the kinds that it has in every view, and [`EdgeFlags`] of how its faces meet.
    pub bits: u32,
}
gpu_layout!(DrawnEdge {
    tail,
    head,
    face,
    across,
    beyond,
    beside,
    bits
});

impl DrawnEdge {
    /// An edge of a shape; `bits` are those that the shape does not know.
    fn new(shape: &HalfEdgeMesh, edge: u32, bits: u32) -> Self {
        let sides = shape.sides(edge);
        let first = sides[0];
        let [tail, head] = shape.ends_of_half_edge(first);
        let second = sides.get(1);
        Self {
            tail,
            head,
            face: first / 3,
            across: second.map_or(NONE, |side| side / 3),
            beyond: second.map_or(tail, |side| shape.opposite(*side)),
            beside: shape.opposite(first),
            bits,
        }
    }

    /// A polyline, from its first vertex to its second.
    fn of_polyline([tail, head]: [u32; 2]) -> Self {
        Self {
            tail,
            head,
            bits: EdgeFlags::POLYLINE.0 | KindSet::MARKED,
            ..Self::nothing()
        }
    }

    /// An edge that is never drawn, and only keeps the numbers of the others.
    fn nothing() -> Self {
        Self {
            face: NONE,
            across: NONE,
            ..Self::default()
        }
    }
}

/// All edges of a shape in their order, and its polylines behind them; those that fold as `creases` says are creases.
///
/// `is_drawn` says of every surface whether it has lines; where it is empty, all have. O(edges), in parallel.
pub fn drawn_edges(
    shape: &HalfEdgeMesh,
    creases: impl Into<Creases>,
    is_drawn: &[bool],
) -> Vec<DrawnEdge> {
    let creases = creases.into();
    let is_open = open_objects(shape);
    let is_lined =
        |surface: u32| is_drawn.is_empty() || is_drawn.get(surface as usize) == Some(&true);
    let has_lines = |side: &u32| is_lined(shape.face_surfaces[*side as usize / 3]);

    // Polylines stand behind the edges of faces, which come first.
    let polylines = shape.polylines.iter().zip(&shape.polyline_surfaces);
    let polylines = polylines.map(|(ends, surface)| match is_lined(*surface) {
        true => DrawnEdge::of_polyline(*ends),
        false => DrawnEdge::nothing(),
    });

    // Note for each edge what no view changes.
    let mut edges: Vec<DrawnEdge> = (0..shape.edge_count() as u32)
        .into_par_iter()
        .with_min_len(4096)
        .map(|edge| {
            let traits = shape.edge_traits[edge as usize];
            let object = object_of(shape, shape.sides(edge)[0] / 3);
            let flags = static_flags(shape, edge, creases).unwrap_or(0);
            let meeting = traits.among(EdgeFlags::FLIPPED | EdgeFlags::NON_MANIFOLD)
                | EdgeFlags::OPEN.when(is_open.get(object) == Some(&true));
            let bits = flags | meeting.0;
            if shape.sides(edge).iter().any(has_lines) {
                DrawnEdge::new(shape, edge, bits)
            } else {
                DrawnEdge::nothing()
            }
        })
        .collect();
    edges.extend(polylines);
    edges
}

/// For every object, whether it has a boundary.
fn open_objects(shape: &HalfEdgeMesh) -> Vec<bool> {
    let mut is_open = Vec::new();
    for edge in 0..shape.edge_count() as u32 {
        if shape.edge_traits[edge as usize].contains(EdgeFlags::BOUNDARY) {
            let object = object_of(shape, shape.sides(edge)[0] / 3);
            is_open.resize(is_open.len().max(object + 1), false);
            is_open[object] = true;
        }
    }
    is_open
}

fn object_of(shape: &HalfEdgeMesh, face: u32) -> usize {
    shape.surfaces[shape.face_surfaces[face as usize] as usize].object as usize
}

/// The input of [`mark_edges`].
#[derive(Debug, Clone, Copy)]
pub struct Facing<'a> {
    /// The eye.
    pub viewer: &'a Viewer,
    /// Bits of [`KindSet::BITS`] that are drawn.
    pub wanted: u32,
    /// Whether contours in valleys are left out.
    pub is_convex_only: bool,
    /// Coordinates of all vertices.
    pub positions: &'a [f32],
    /// Whether each face is turned to the eye: 1 or 0.
    pub front: &'a [u32],
}

/// Which edges are drawn: their flag is 1, and their mark holds the kind and [`EdgeFlags::REVERSED`].
///
/// Edges run as the face turned to the eye is wound, so that its surface lies on the left hand as the eye sees it
/// [Jiang et al. 2022]. O(edges).
///
/// Differs: the publication marks both sides of a face seen exactly edge-on, drops edges of more than two faces, and
/// freezes convexity when the mesh is read.
pub fn mark_edges(on: &Facing<'_>, edges: &[DrawnEdge], flags: &mut [u32], marks: &mut [u32]) {
    let outputs = flags.par_iter_mut().zip(marks);
    edges
        .par_iter()
        .zip(outputs)
        .for_each(|(edge, (flag, mark))| {
            let found = on.mark_of(edge);
            *mark = found;
            *flag = u32::from(found != 0);
        });
}

impl Facing<'_> {
    /// The kind and the direction of an edge; 0 where it is not drawn.
    fn mark_of(&self, edge: &DrawnEdge) -> u32 {
        if EdgeFlags::POLYLINE.is_in(edge.bits) {
            return edge.bits & self.wanted & KindSet::BITS;
        }
        if edge.face == NONE {
            return 0;
        }
        let is_front = self.front[edge.face as usize] != 0;
        let has_pair = edge.across != NONE && !EdgeFlags::NON_MANIFOLD.is_in(edge.bits);
        let is_front_across = has_pair && self.front[edge.across as usize] != 0;
        let is_flipped = EdgeFlags::FLIPPED.is_in(edge.bits);
        let is_contour = has_pair && (is_front != is_front_across) != is_flipped;
        let is_seen = is_front || is_front_across || EdgeFlags::OPEN.is_in(edge.bits);
        let direction = if is_front { 0 } else { EdgeFlags::REVERSED.0 };
        if is_contour && self.wanted & KindSet::CONTOUR != 0 {
            let is_valley = self.is_convex_only && !is_flipped && self.is_concave(edge);
            return if is_valley {
                0
            } else {
                KindSet::CONTOUR | direction
            };
        }
        let kinds = edge.bits & self.wanted & KindSet::BITS;
        if kinds == 0 || !is_seen {
            return 0;
        }
        // The first kind, in the order in which kinds are layered.
        let kind = kinds & kinds.wrapping_neg();
        kind | direction
    }

    /// Whether the face across rises over the plane of the first.
    fn is_concave(&self, edge: &DrawnEdge) -> bool {
        let point = |vertex: u32| std::array::from_fn(|i| self.positions[3 * vertex as usize + i]);
        let eye = Eye::from(self.viewer);
        let [tail, head, own, across] = [edge.tail, edge.head, edge.beside, edge.beyond].map(point);
        is_raised(&eye, tail, head, own, across)
    }
}
