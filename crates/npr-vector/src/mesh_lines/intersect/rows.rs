//! Crossings as rows of numbers, for files.

use super::{Crossings, Piercing};
use crate::mesh_lines::graph::{CurveGraph, CurveNode};
use npr_core::geometry::NONE;
use npr_core::line_kind::KindSet;
use npr_mesh::half_edge::HalfEdgeMesh;

/// Numbers of a node and of a piercing.
const NODE: usize = 6;
const PIERCING: usize = 3;

impl Crossings {
    /// Everything as numbers: overflow and how many nodes first, then nodes, then piercings.
    pub fn to_rows(&self) -> Vec<u32> {
        let nodes = self.graph.nodes.iter();
        let nodes = nodes.flat_map(|n| [n.edge, n.t.to_bits(), n.next, n.prev, n.flags, n.face]);
        let piercings = self.piercings.iter();
        let piercings = piercings.flat_map(|p| [p.edge, p.t.to_bits(), p.face]);
        let head = [u32::from(self.overflow), self.graph.nodes.len() as u32];
        head.into_iter().chain(nodes).chain(piercings).collect()
    }

    /// The crossings that [`Self::to_rows`] turned into numbers, if they may belong to the shape: every edge and face
    /// exists, links go both ways, places lie on edges, and piercings are in order. `None` for other numbers.
    pub fn from_rows(rows: &[u32], shape: &HalfEdgeMesh) -> Option<Self> {
        // Split the numbers into nodes and piercings.
        let ([overflow, count], rest) = rows.split_first_chunk()?;
        let (nodes, piercings) = rest.split_at_checked((*count as usize).checked_mul(NODE)?)?;
        let (nodes, _) = nodes.as_chunks::<NODE>();
        let (piercings, left) = piercings.as_chunks::<PIERCING>();
        let nodes = nodes
            .iter()
            .map(|&[edge, t, next, prev, flags, face]| CurveNode {
                edge,
                t: f32::from_bits(t),
                next,
                prev,
                flags,
                face,
            });
        let piercings = piercings.iter().map(|&[edge, t, face]| Piercing {
            edge,
            t: f32::from_bits(t),
            face,
        });

        // Take them only where they may belong to the shape.
        let found = Self {
            graph: CurveGraph {
                nodes: nodes.collect(),
            },
            piercings: piercings.collect(),
            overflow: *overflow == 1,
        };
        let is_sound = *overflow < 2 && left.is_empty() && found.may_belong_to(shape);
        is_sound.then_some(found)
    }

    fn may_belong_to(&self, shape: &HalfEdgeMesh) -> bool {
        // Places must lie on the shape.
        let lies = |edge: u32, t: f32, face: u32| {
            (edge as usize) < shape.edge_count()
                && (0.0..=1.0).contains(&t)
                && (face as usize) < shape.faces.len()
        };

        // Links must agree in both directions.
        let nodes = &self.graph.nodes;
        let is_linked = |(index, node): (usize, &CurveNode)| {
            let goes_on = node.next == NONE
                || nodes
                    .get(node.next as usize)
                    .is_some_and(|next| next.prev == index as u32);
            let comes_from = node.prev == NONE
                || nodes
                    .get(node.prev as usize)
                    .is_some_and(|prev| prev.next == index as u32);
            goes_on
                && comes_from
                && node.flags == KindSet::INTERSECTION
                && lies(node.edge, node.t, node.face)
        };

        // Piercings must ascend, for they are searched.
        let order = |p: &Piercing| (p.edge, p.t.to_bits(), p.face);
        nodes.iter().enumerate().all(is_linked)
            && self.piercings.iter().all(|p| lies(p.edge, p.t, p.face))
            && self
                .piercings
                .windows(2)
                .all(|pair| order(&pair[0]) < order(&pair[1]))
    }
}
