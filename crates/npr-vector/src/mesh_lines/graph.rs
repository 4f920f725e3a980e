//! The curve graph: every line of a view as linked points on mesh edges.
//!
//! A node lies on a mesh edge, at a parameter along it, and names its successor; the piece of line from a node to its
//! successor lies in one face or along one edge. Producers differ only in where they put nodes: on corners for lines
//! that follow mesh edges ([`crate::mesh_lines::contour`], [`crate::mesh_lines::feature`]), between them for the zero
//! set of n.v ([`crate::mesh_lines::zero_set`]) and for intersections ([`crate::mesh_lines::intersect`]). Everything
//! after is shared.

use bytemuck::{Pod, Zeroable};
use npr_core::geometry::NONE;
use npr_core::gpu_layout;
use npr_core::line_kind::KindSet;
use npr_mesh::half_edge::HalfEdgeMesh;

/// A point of a line, and the properties of the piece that runs from it to its successor.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct CurveNode {
    /// The unique mesh edge that the point lies on.
    pub edge: u32,
    /// Where on the edge: 0 at its lower vertex, 1 at its higher.
    pub t: f32,
    /// Successor, or [`NONE`] at the end of an open line.
    pub next: u32,
    /// Predecessor, or [`NONE`] at the start of an open line.
    pub prev: u32,
    /// Bits of [`KindSet`], and [`CONCAVE`](npr_core::edge_flags::EdgeFlags::CONCAVE) of contours that their own
    /// surface hides, [`CUSP`](npr_core::edge_flags::EdgeFlags::CUSP) and
    /// [`SEAM`](npr_core::edge_flags::EdgeFlags::SEAM); the kind of a piece stands at its first node. A piece of no
    /// kind is a link, never drawn.
    pub flags: u32,
    /// A face beside the piece: the front face of a contour, the face that a zero-set piece crosses.
    pub face: u32,
}
gpu_layout!(CurveNode {
    edge,
    t,
    next,
    prev,
    flags,
    face
});

impl CurveNode {
    /// Whether the piece after this node runs along its mesh edge, from one end to the other.
    pub fn is_along_edge(&self) -> bool {
        (self.t == 0.0 || self.t == 1.0) && self.flags & KindSet::INTERSECTION == 0
    }
}

/// Lines of one view, or of all views.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct CurveGraph {
    /// All nodes; links are indices into this list.
    pub nodes: Vec<CurveNode>,
}

impl CurveGraph {
    /// Position of a node in the world.
    pub fn position(&self, shape: &HalfEdgeMesh, node: u32) -> [f64; 3] {
        let node = &self.nodes[node as usize];
        shape.point_on(node.edge, node.t).to_array()
    }

    /// The nodes that have pieces, line by line: open lines first, then closed ones, each in the order of first nodes.
    pub fn chains(&self) -> Vec<Vec<u32>> {
        let nodes = &self.nodes;
        let mut seen = vec![false; nodes.len()];

        // Begin with open chains; what is left then are loops.
        let starts = (0..nodes.len() as u32).filter(|node| nodes[*node as usize].prev == NONE);
        let mut chains = Vec::new();
        for start in starts.chain(0..nodes.len() as u32) {
            // Follow the links, without the last node of an open chain, which begins no piece.
            let mut chain = Vec::new();
            let mut at = start;
            while at != NONE && !seen[at as usize] {
                seen[at as usize] = true;
                if nodes[at as usize].next != NONE {
                    chain.push(at);
                }
                at = nodes[at as usize].next;
            }
            if !chain.is_empty() {
                chains.push(chain);
            }
        }
        chains
    }

    /// Whether the last node of a chain is followed by its first.
    pub fn is_loop(&self, chain: &[u32]) -> bool {
        let ends = chain.first().zip(chain.last());
        ends.is_some_and(|(first, last)| self.nodes[*last as usize].next == *first)
    }

    /// Adds the nodes of another graph behind those of this one.
    pub fn append(&mut self, other: &CurveGraph) {
        let base = self.nodes.len() as u32;
        let moved = |link: u32| if link == NONE { NONE } else { link + base };
        self.nodes.extend(other.nodes.iter().map(|node| CurveNode {
            next: moved(node.next),
            prev: moved(node.prev),
            ..*node
        }));
    }

    /// Digest of all nodes in order, for comparing runs and engines [FNV-1a].
    pub fn digest(&self) -> u64 {
        let bytes: &[u8] = bytemuck::cast_slice(&self.nodes);
        bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
            (hash ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3)
        })
    }

    /// Asserts that links lead back and forth and stay within the graph.
    ///
    /// # Panics
    ///
    /// When they do not, naming the node.
    pub fn sanity_check(&self) {
        for (index, node) in self.nodes.iter().enumerate() {
            if node.next != NONE {
                assert_eq!(
                    self.nodes[node.next as usize].prev, index as u32,
                    "successor of node {index}"
                );
            }
            if node.prev != NONE {
                assert_eq!(
                    self.nodes[node.prev as usize].next, index as u32,
                    "predecessor of node {index}"
                );
            }
            assert!((0.0..=1.0).contains(&node.t), "parameter of node {index}");
        }
    }
}
