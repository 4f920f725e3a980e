//! By how much an edge folds, whatever reads the mesh: the one place where creases of frames and of line drawings are
//! measured.
//!
//! Where a file's normals run on smoothly across an edge, its author wants no crease there, however far its faces
//! turn; where they break, or where the file has none, the angle counts. The angle itself, and whether normals or
//! faces decide, come with [`Creases`](npr_core::crease::Creases).

use glam::DVec3;
use npr_core::edge_flags::EdgeFlags;
use rayon::prelude::*;

use crate::edges::{Edge, NO_FACE};
use crate::triangle::Triangle;
use crate::weld::Weld;

/// The file's normals on one side of an edge: at its lower and its higher end. Zeros where the file has none.
pub(crate) type SideNormals = [[f32; 3]; 2];

/// Cosine of the angle between the file's normals in the middle of an edge; none where one side has no normal there.
///
/// In the middle, because a break at one end alone, as around the tip of a cone, is no crease. Where faces are wound
/// against each other (`is_flipped`) a normal stands for both its directions.
pub(crate) fn cos_between(sides: [SideNormals; 2], is_flipped: bool) -> Option<f32> {
    let unit = |normal: [f32; 3]| DVec3::from_array(normal.map(f64::from)).try_normalize();
    let middle = |[low, high]: SideNormals| (unit(low)? + unit(high)?).try_normalize();
    let [one, other] = sides;
    let cos = middle(one)?.dot(middle(other)?).clamp(-1.0, 1.0) as f32;
    Some(if is_flipped { cos.abs() } else { cos })
}

/// By how much edges fold: cosines, 1 where an edge has not two faces.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Folds {
    /// Between the faces.
    pub faces: Vec<f32>,
    /// Between the file's normals, or the faces where it has none.
    pub normals: Vec<f32>,
}

/// A stored mesh whose folds are measured.
#[derive(Debug, Clone, Copy)]
pub struct FoldInput<'a> {
    /// Its vertices in the world: faces fold as they are seen.
    pub world: &'a [[f32; 3]],
    /// Its triangles.
    pub triangles: &'a [[u32; 3]],
    /// Which of its vertices are one.
    pub weld: &'a Weld,
    /// The file's normals, one for every stored vertex, zero where it has none; empty where it has none at all.
    pub normals: &'a [[f32; 3]],
}

impl FoldInput<'_> {
    /// The folds of the edges of [`unique_edges`](crate::unique_edges). Edges of more than two faces fold all the way.
    /// O(edges), parallel.
    pub fn folds(&self, edges: &[Edge]) -> Folds {
        let folds = edges
            .par_iter()
            .with_min_len(4096)
            .map(|edge| self.fold(edge));
        let (faces, normals) = folds.unzip();
        Folds { faces, normals }
    }

    fn fold(&self, edge: &Edge) -> (f32, f32) {
        if edge.faces[1] == NO_FACE {
            return (1.0, 1.0);
        }
        if edge.flags.contains(EdgeFlags::NON_MANIFOLD) {
            return (-1.0, -1.0);
        }
        let is_flipped = edge.flags.contains(EdgeFlags::FLIPPED);
        let faces = self.cos_of_faces(edge.faces, is_flipped);
        let sides = edge.faces.map(|face| self.side_normals(face, edge.ends));
        let normals = match sides {
            [Some(one), Some(other)] => cos_between([one, other], is_flipped),
            _ => None,
        };
        (faces, normals.unwrap_or(faces))
    }

    fn cos_of_faces(&self, faces: [u32; 2], is_flipped: bool) -> f32 {
        let normal = |face: u32| Triangle::new(self.world, self.triangles[face as usize]).normal();
        let [Some(one), Some(other)] = faces.map(normal) else {
            return 1.0;
        };
        let cos = one.dot(other).clamp(-1.0, 1.0) as f32;
        if is_flipped { -cos } else { cos }
    }

    /// The normals that a face has at the ends of an edge.
    fn side_normals(&self, face: u32, ends: [u32; 2]) -> Option<SideNormals> {
        let stored = self.triangles[face as usize];
        let welded = self.weld.corners(stored);
        let normal = |end: u32| {
            let wanted = self.weld.of_vertex[end as usize];
            let corner = welded.iter().position(|vertex| *vertex == wanted)?;
            self.normals.get(stored[corner] as usize).copied()
        };
        Some([normal(ends[0])?, normal(ends[1])?])
    }
}

#[cfg(test)]
mod tests;
