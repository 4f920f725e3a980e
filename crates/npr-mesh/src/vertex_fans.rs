//! Which corners of which faces meet at each welded vertex.

use crate::weld::Weld;

/// A corner of a face: face `corner / 3`, its vertex `corner % 3`.
pub type Corner = u32;

/// For every welded vertex, the corners that meet there, in ascending order.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct VertexFans {
    corners: Vec<Corner>,
    /// Where each welded vertex's corners start, and one more for the end.
    corner_start: Vec<u32>,
}

impl VertexFans {
    /// Gathers the corners of all triangles, degenerate ones too, by counting sort; O(n).
    pub fn new(triangles: &[[u32; 3]], weld: &Weld) -> Self {
        let welded = |vertex: &u32| weld.of_vertex[*vertex as usize] as usize;
        let mut corner_start = vec![0; weld.count() + 1];
        triangles
            .as_flattened()
            .iter()
            .for_each(|vertex| corner_start[welded(vertex)] += 1);
        let mut end = 0;
        for start in &mut corner_start {
            end += *start;
            *start = end;
        }
        // Fill every fan from its end, last corner first, which leaves its start behind.
        let mut corners = vec![0; triangles.len() * 3];
        for (corner, vertex) in triangles.as_flattened().iter().enumerate().rev() {
            let start = &mut corner_start[welded(vertex)];
            *start -= 1;
            corners[*start as usize] = corner as Corner;
        }
        Self {
            corners,
            corner_start,
        }
    }

    /// Number of welded vertices.
    pub fn count(&self) -> usize {
        self.corner_start.len() - 1
    }

    /// The corners that meet at a welded vertex.
    pub fn around(&self, welded: u32) -> &[Corner] {
        let [start, end] = [0, 1].map(|i| self.corner_start[welded as usize + i] as usize);
        &self.corners[start..end]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{random_soup, unindexed};
    use crate::weld::weld;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn every_corner_is_in_the_fan_of_its_vertex(seed: u64, faces in 0usize..40) {
            let mesh = unindexed(&random_soup(faces, seed));
            let weld = weld(mesh.positions(), 0.0);
            let fans = VertexFans::new(mesh.triangles(), &weld);
            prop_assert_eq!(fans.count(), weld.count());
            for welded in 0..weld.count() as u32 {
                let expected: Vec<Corner> = mesh.triangles().as_flattened().iter().zip(0..)
                    .filter(|(vertex, _)| weld.of_vertex[**vertex as usize] == welded)
                    .map(|(_, corner)| corner)
                    .collect();
                prop_assert_eq!(fans.around(welded), expected);
            }
        }
    }
}
