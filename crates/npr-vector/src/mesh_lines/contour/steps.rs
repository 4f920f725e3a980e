//! Contours in steps in which all faces or half-edges work at once: the twins of `vector.face_eye`,
//! `vector.mark_contours`, `vector.link_contours` and `vector.list_nodes`.
//!
//! Before linking, the marked half-edges are put in a row by [`crate::rank::scan`], so nodes come in the order of
//! half-edges and the graph is that of [`contours`](super::contours), bit for bit.

use super::{Eye, cross, dot};
use crate::mesh_lines::graph::CurveNode;
use crate::rank::Link;
use bytemuck::{Pod, Zeroable};
use npr_core::edge_flags::EdgeFlags;
use npr_core::geometry::NONE;
use npr_core::gpu_layout;
use npr_core::line_kind::KindSet;
use npr_mesh::half_edge::HalfEdgeMesh;
use rayon::prelude::*;

/// A half-edge of a [`HalfEdgeMesh`], with all that linking reads.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct HalfEdge {
    /// The vertex that it runs from.
    pub tail: u32,
    /// The half-edge on the other side, or [`NONE`].
    pub twin: u32,
    /// Its unique edge.
    pub edge: u32,
    /// [`HalfEdgeMesh::edge_traits`] of that edge.
    pub traits: EdgeFlags,
}
gpu_layout!(HalfEdge {
    tail,
    twin,
    edge,
    traits
});

/// An [`Eye`] as shaders read it.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct Viewer {
    /// [`Eye::position`].
    pub position: [f32; 4],
    /// [`Eye::scale`].
    pub scale: f32,
    /// 0, which a shader compiler cannot know: with it shaders keep sums and products apart.
    pub zero: u32,
    /// Keeps the size a multiple of 16 bytes.
    pub unused: [u32; 2],
}
gpu_layout!(Viewer {
    position,
    scale,
    zero,
    unused
});

impl From<&Eye> for Viewer {
    fn from(eye: &Eye) -> Self {
        Self {
            position: eye.position,
            scale: eye.scale,
            ..Self::default()
        }
    }
}

impl From<&Viewer> for Eye {
    fn from(viewer: &Viewer) -> Self {
        Self {
            position: viewer.position,
            scale: viewer.scale,
        }
    }
}

/// All half-edges of a shape.
pub fn half_edges(shape: &HalfEdgeMesh) -> Vec<HalfEdge> {
    let corners = shape.faces.as_flattened();
    let sides = shape.twins.iter().zip(&shape.edge_of).zip(corners);
    sides
        .map(|((twin, edge), tail)| HalfEdge {
            tail: *tail,
            twin: *twin,
            edge: *edge,
            traits: shape.edge_traits[*edge as usize],
        })
        .collect()
}

/// The face that decides for each face whether it is front: itself, or the stand-in of a face without area.
pub fn judges(shape: &HalfEdgeMesh) -> Vec<u32> {
    let mut judges: Vec<u32> = (0..shape.faces.len() as u32).collect();
    for [face, stand_in] in &shape.degenerate_faces {
        judges[*face as usize] = *stand_in;
    }
    judges
}

/// Whether each face is turned to the eye: 1 or 0.
///
/// `positions` are the coordinates of all vertices. A face whose judge is [`NONE`] is not.
pub fn face_eye(
    viewer: &Viewer,
    positions: &[f32],
    corners: &[u32],
    judges: &[u32],
    front: &mut [u32],
) {
    let eye = Eye::from(viewer);
    front.par_iter_mut().zip(judges).for_each(|(front, judge)| {
        *front = 0;
        if *judge != NONE {
            let corner = |i: usize| point(positions, corners[*judge as usize * 3 + i]);
            let height = eye.height_over([corner(0), corner(1), corner(2)]);
            *front = u32::from(height > 0.0);
        }
    });
}

/// Marks the half-edges of front faces that have no front face across.
pub fn mark_contours(front: &[u32], half_edges: &[HalfEdge], flags: &mut [u32]) {
    let sides = half_edges.par_iter().zip(flags).enumerate();
    sides.for_each(|(element, (side, flag))| {
        let is_open = side.twin == NONE || front[side.twin as usize / 3] == 0;
        *flag = u32::from(front[element / 3] != 0 && is_open);
    });
}

/// What [`link_contours`] works on.
#[derive(Debug, Clone, Copy)]
pub struct Marked<'a> {
    /// The eye.
    pub viewer: &'a Viewer,
    /// The first is the number of marked half-edges.
    pub extent: &'a [u32],
    /// Marked half-edges, ascending.
    pub contours: &'a [u32],
    /// Where each marked half-edge is in that list.
    pub slots: &'a [u32],
    /// 1 for marked half-edges.
    pub flags: &'a [u32],
    /// All half-edges.
    pub half_edges: &'a [HalfEdge],
    /// Coordinates of all vertices.
    pub positions: &'a [f32],
}

/// Makes a node of every marked half-edge and links it to the one that starts where it ends.
///
/// Where `nodes` has no room for all of them, its content is of no use.
pub fn link_contours(on: &Marked<'_>, nodes: &mut [CurveNode]) {
    let count = (on.extent[0] as usize).min(nodes.len());

    // Make a node of each contour half-edge, and point it at its successor.
    nodes[..count]
        .par_iter_mut()
        .zip(on.contours)
        .for_each(|(node, half_edge)| {
            let side = on.half_edges[*half_edge as usize];
            let head = on.half_edges[HalfEdgeMesh::following(*half_edge) as usize].tail;
            node.edge = side.edge;
            node.t = if side.tail < head { 0.0 } else { 1.0 };
            node.next = on.slots[on.successor(*half_edge) as usize];
            node.flags = on.flags_of(*half_edge);
            node.face = *half_edge / 3;
        });

    // Point back.
    for element in 0..count {
        let next = nodes[element].next as usize;
        if next < count {
            nodes[next].prev = element as u32;
        }
    }
}

/// The links of nodes, as ranking reads them; edges are the keys.
///
/// Each element after the first `extent[0]` nodes becomes a loop of its own; these come last, since heads are in order.
/// Where there was no room for all nodes, links would lead nowhere, and all elements become such loops.
pub fn list_nodes(extent: &[u32], nodes: &[CurveNode], links: &mut [Link]) {
    let count = extent[0] as usize;
    let count = if count <= nodes.len() { count } else { 0 };
    let pairs = nodes.par_iter().zip(links).enumerate();
    pairs.for_each(|(element, (node, link))| {
        let is_node = element < count;
        let element = element as u32;
        link.next = if is_node { node.next } else { element };
        link.prev = if is_node { node.prev } else { element };
        link.key = if is_node { node.edge } else { 0 };
    });
}

impl Marked<'_> {
    /// The marked half-edge that starts where this one ends, around the same wedge of front faces.
    fn successor(&self, half_edge: u32) -> u32 {
        let mut next = HalfEdgeMesh::following(half_edge);
        // A shape's twins lead to a marked half-edge; the bound is for what is no shape.
        for _ in 0..self.half_edges.len() {
            if self.flags[next as usize] != 0 {
                break;
            }
            next = HalfEdgeMesh::following(self.half_edges[next as usize].twin);
        }
        next
    }

    fn flags_of(&self, half_edge: u32) -> u32 {
        let HalfEdge { twin, traits, .. } = self.half_edges[half_edge as usize];
        let odd = EdgeFlags::BOUNDARY | EdgeFlags::NON_MANIFOLD | EdgeFlags::FLIPPED;
        if twin == NONE || traits.intersects(odd) {
            return EdgeFlags::SEAM.0;
        }
        if self.is_concave(half_edge, twin) {
            KindSet::CONTOUR | EdgeFlags::CONCAVE.0
        } else {
            KindSet::CONTOUR
        }
    }

    fn is_concave(&self, half_edge: u32, twin: u32) -> bool {
        let tail_of = |side: u32| point(self.positions, self.half_edges[side as usize].tail);
        let following = HalfEdgeMesh::following(half_edge);
        let (tail, head) = (tail_of(half_edge), tail_of(following));
        let own = tail_of(HalfEdgeMesh::following(following));
        let across = tail_of(HalfEdgeMesh::following(HalfEdgeMesh::following(twin)));
        is_raised(&Eye::from(self.viewer), tail, head, own, across)
    }
}

/// Whether `across` lies above the plane of the face of `tail`, `head` and `own`.
pub(crate) fn is_raised(
    eye: &Eye,
    tail: [f32; 3],
    head: [f32; 3],
    own: [f32; 3],
    across: [f32; 3],
) -> bool {
    let from_tail = |p| eye.scaled_difference(p, tail);
    dot(cross(from_tail(head), from_tail(own)), from_tail(across)) > 0.0
}

fn point(positions: &[f32], vertex: u32) -> [f32; 3] {
    std::array::from_fn(|i| positions[3 * vertex as usize + i])
}
