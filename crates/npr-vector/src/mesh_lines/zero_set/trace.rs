//! Pieces of the border between front and back, linked.

use super::signs::Signs;
use crate::mesh_lines::graph::{CurveGraph, CurveNode};
use npr_core::geometry::NONE;
use npr_core::line_kind::KindSet;
use npr_mesh::half_edge::HalfEdgeMesh;
use rayon::prelude::*;

/// What a node marks; ascending roles order the nodes of an edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Role {
    /// A piece through a face, starting where a half-edge goes from front to back.
    Through,
    /// A piece along a half-edge whose side is front while the other is back.
    Along,
    /// The end of an open line; it has no piece.
    End,
}

/// The key of a node: half-edges order as (edge, half-edge), and each has at most one node of a role.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Key {
    edge: u32,
    half_edge: u32,
    role: Role,
}

/// A piece of line: the node where it starts, and the node that follows.
#[derive(Debug, Clone, Copy)]
struct Piece {
    key: Key,
    t: f32,
    next: Option<Key>,
}

/// A graph, and which of its pieces run along edges.
pub(super) struct Traced {
    pub graph: CurveGraph,
    /// For every node, whether its piece runs along the node's edge, between two faces; of the others, pieces cross a
    /// face.
    pub along: Vec<bool>,
}

/// Links all borders between front and back into one graph, nodes ordered by (edge, half-edge).
///
/// The front is on the left of travel, seen from outside. O(faces) to find the pieces, in parallel; O(n log n) for
/// the rest.
pub(super) fn trace(signs: &Signs<'_>) -> Traced {
    let mut pieces: Vec<Piece> = signs.crossed_faces();
    pieces.extend(signs.steps());
    signs.close_ends(&mut pieces);
    pieces.par_sort_unstable_by_key(|piece| piece.key);
    Traced {
        along: pieces
            .iter()
            .map(|piece| piece.key.role == Role::Along)
            .collect(),
        graph: link(&pieces),
    }
}

impl Signs<'_> {
    /// The pieces through faces with front and back corners.
    fn crossed_faces(&self) -> Vec<Piece> {
        (0..self.shape.faces.len() as u32)
            .into_par_iter()
            .with_min_len(4096)
            .filter_map(|face| self.piece_through(face))
            .collect()
    }

    fn piece_through(&self, face: u32) -> Option<Piece> {
        let start = self.side_where(face, true)?;
        Some(Piece {
            key: self.key(start, Role::Through),
            t: self.crossing(start)?.t,
            next: self.after_face(face),
        })
    }

    /// The half-edge of a face that goes from front to back, or from back to front; a face has at most one of each.
    fn side_where(&self, face: u32, from_front: bool) -> Option<u32> {
        let front = [0, 1, 2].map(|i| self.front(3 * face + i));
        (0..3)
            .find(|i| front[*i] == from_front && front[(i + 1) % 3] != from_front)
            .map(|i| 3 * face + i as u32)
    }

    /// The pieces along edges whose two sides disagree.
    fn steps(&self) -> Vec<Piece> {
        let mut edges: Vec<u32> = self.normals.split_edges().to_vec();
        let sides = |face: &u32| [0, 1, 2].map(|i| 3 * *face + i);
        edges.extend(self.flat.faces().iter().flat_map(sides).filter_map(|side| {
            let twin = self.shape.twins[side as usize];
            (twin != NONE).then_some(side.min(twin))
        }));
        if !self.flat.faces().is_empty() {
            edges.par_sort_unstable();
            edges.dedup();
        }
        edges
            .par_iter()
            .with_min_len(1024)
            .flat_map_iter(|half_edge| [*half_edge, self.shape.twins[*half_edge as usize]])
            .filter_map(|half_edge| self.piece_along(half_edge))
            .collect()
    }

    fn piece_along(&self, half_edge: u32) -> Option<Piece> {
        let twin = self.shape.twins[half_edge as usize];
        if self.joined(half_edge, twin) {
            return None;
        }
        let [from, to] = self.step(half_edge, twin)?;
        let next = match to.half_edge {
            NONE => self.around_head(half_edge),
            // One side changes here: its own front ends, or the other's begins. Either way the border goes into its
            // face.
            side => Some(self.key(side, Role::Through)),
        };
        Some(Piece {
            key: self.key(half_edge, Role::Along),
            t: from.t,
            next,
        })
    }

    /// The node that follows a piece through a face.
    fn after_face(&self, face: u32) -> Option<Key> {
        let exit = self.side_where(face, false)?;
        let twin = self.shape.twins[exit as usize];
        if twin == NONE {
            return None;
        }
        if self.joined(exit, twin) {
            return Some(self.key(twin, Role::Through));
        }
        // Keep the front on the left: follow this side of the edge where the other side is back, else the other.
        let front_beyond = self.front_at(twin, self.crossing(exit)?);
        Some(self.key(if front_beyond { twin } else { exit }, Role::Along))
    }

    /// The node that follows a piece that arrives at a vertex: the next step met when turning through the front.
    fn around_head(&self, half_edge: u32) -> Option<Key> {
        let mut side = HalfEdgeMesh::following(half_edge);
        // The turn leads back to this half-edge's twin at the latest, whose side is back here.
        loop {
            let twin = self.shape.twins[side as usize];
            if twin == NONE {
                return None;
            }
            let beyond = HalfEdgeMesh::following(twin);
            if !self.front(beyond) {
                return Some(self.key(side, Role::Along));
            }
            side = beyond;
        }
    }

    /// Gives every piece without a successor a last node.
    fn close_ends(&self, pieces: &mut Vec<Piece>) {
        for index in 0..pieces.len() {
            if pieces[index].next.is_none() {
                let end = self.end_of(pieces[index].key);
                pieces[index].next = end.map(|end| end.key);
                pieces.extend(end);
            }
        }
    }

    /// The node at the end of a piece.
    fn end_of(&self, piece: Key) -> Option<Piece> {
        let half_edge = piece.half_edge;
        let (side, t) = match piece.role {
            Role::Through => {
                let exit = self.side_where(half_edge / 3, false)?;
                (exit, self.crossing(exit)?.t)
            }
            _ if self.shape.runs_up(half_edge) => (half_edge, 1.0),
            _ => (half_edge, 0.0),
        };
        Some(Piece {
            key: self.key(side, Role::End),
            t,
            next: None,
        })
    }

    fn key(&self, half_edge: u32, role: Role) -> Key {
        Key {
            edge: self.shape.edge_of[half_edge as usize],
            half_edge,
            role,
        }
    }
}

/// Turns sorted pieces into nodes.
fn link(pieces: &[Piece]) -> CurveGraph {
    // Make a node of each piece, pointing at the piece that follows.
    let find = |key: Key| match pieces.binary_search_by_key(&key, |piece| piece.key) {
        Ok(index) => index as u32,
        Err(_) => NONE,
    };
    let node = |piece: &Piece| CurveNode {
        edge: piece.key.edge,
        t: piece.t,
        next: piece.next.map_or(NONE, find),
        prev: NONE,
        flags: if piece.key.role == Role::End {
            0
        } else {
            KindSet::CONTOUR
        },
        face: piece.key.half_edge / 3,
    };
    let mut nodes: Vec<CurveNode> = pieces.par_iter().with_min_len(256).map(node).collect();

    // Point back.
    for index in 0..nodes.len() {
        let next = nodes[index].next;
        if next != NONE {
            nodes[next as usize].prev = index as u32;
        }
    }
    CurveGraph { nodes }
}
