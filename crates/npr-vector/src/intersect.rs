//! To come.

use crate::bvh::FaceTree;
use crate::graph::CurveGraph;
use npr_core::shape::Shape;

/// Where surfaces cut through each other.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Crossings {
    /// Intersection curves.
    pub graph: CurveGraph,
    /// Where mesh edges go through faces, ordered by edge.
    pub piercings: Vec<Piercing>,
}

/// A place where a mesh edge goes through a face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Piercing {
    /// The unique mesh edge.
    pub edge: u32,
    /// Place on it, 0 at its lower vertex.
    pub t: f32,
    /// The face.
    pub face: u32,
}

impl Crossings {
    /// The piercings of an edge.
    pub fn of_edge(&self, edge: u32) -> &[Piercing] {
        let from = self.piercings.partition_point(|p| p.edge < edge);
        let count = self.piercings[from..].partition_point(|p| p.edge == edge);
        &self.piercings[from..from + count]
    }
}

/// Finds them.
pub fn crossings(_shape: &Shape, _tree: &FaceTree) -> Crossings {
    Crossings::default()
}
