//! Which stored vertices are one point of the surface.
//!
//! Files split a vertex wherever its texture coordinate or normal jumps, and some formats store three
//! vertices per triangle. Taken literally, every such seam would be a boundary and be drawn as a line.

use rayon::prelude::*;

use crate::buckets::Buckets;
use crate::cluster::clusters;

/// Groups of stored vertices that share a position: the welded vertices.
///
/// Welded vertices are numbered by the first stored vertex of each, ascending.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Weld {
    /// The welded vertex of every stored vertex.
    pub of_vertex: Vec<u32>,
    /// The first stored vertex of every welded vertex, which stands for it.
    pub first: Vec<u32>,
}

impl Weld {
    /// Number of welded vertices.
    pub fn count(&self) -> usize {
        self.first.len()
    }

    /// A triangle's corners as welded vertices.
    pub fn corners(&self, triangle: [u32; 3]) -> [u32; 3] {
        triangle.map(|vertex| self.of_vertex[vertex as usize])
    }

    /// One value per stored vertex from one value per welded vertex.
    pub fn spread<T: Copy>(&self, of_welded: &[T]) -> Vec<T> {
        self.of_vertex
            .iter()
            .map(|&welded| of_welded[welded as usize])
            .collect()
    }

    /// Numbers the groups in which vertex `v` belongs with the earlier vertex `first_of[v]`, or is first.
    pub(crate) fn from_first(first_of: &[u32]) -> Self {
        let mut of_vertex = vec![0; first_of.len()];
        let mut first = Vec::new();
        for (vertex, &leader) in first_of.iter().enumerate() {
            if leader as usize == vertex {
                of_vertex[vertex] = first.len() as u32;
                first.push(leader);
            } else {
                of_vertex[vertex] = of_vertex[leader as usize];
            }
        }
        Self { of_vertex, first }
    }
}

/// Welds equal positions, or nearly equal ones.
///
/// With `tolerance` 0 positions must agree in every bit, except that -0 equals 0. Otherwise `tolerance`
/// is a fraction of the bounding box's diagonal, and two positions belong together when a chain of
/// positions with no step longer than that joins them. Which vertices group does not depend on their
/// order; only the numbering does. Long chains can grow past the tolerance, so keep it well under the
/// shortest edge; 1e-6 mends most exports. Tolerances under 1e-12, negative or not a number count as 0.
/// Positions that are not finite weld with equal ones only, bit by bit.
///
/// Where dozens of positions crowd within one tolerance, steps up to an eighth longer may count too: no way
/// is known to find the nearest pair of two crowds exactly in O(n log n) [Gan & Tao 2015].
///
/// Counting sort by hash, O(n), or O(n log n) if all hashes collide; 20 bytes of scratch per vertex.
/// A tolerance costs as much again, and more only for vertices with a neighbour within reach.
pub fn weld(positions: &[[f32; 3]], tolerance: f32) -> Weld {
    let exact = weld_exact(positions);
    if tolerance >= 1e-12 {
        weld_near(positions, &exact, tolerance)
    } else {
        exact
    }
}

fn weld_exact(positions: &[[f32; 3]]) -> Weld {
    // Twice as many buckets as positions: most hold one position and need no comparison.
    let bits = (2 * positions.len())
        .next_power_of_two()
        .trailing_zeros()
        .max(1);
    let bucket_of: Vec<u32> = positions
        .par_iter()
        .map(|&p| (hash(key(p)) >> (64 - bits)) as u32)
        .collect();
    let buckets = Buckets::new(1 << bits, &bucket_of, |vertex| vertex);
    let repeats = buckets.gather(|run| {
        let mut repeats = Vec::new();
        run.for_each(|_, members| repeats_among(positions, members, &mut repeats));
        repeats
    });
    let mut first_of: Vec<u32> = (0..positions.len() as u32).collect();
    for [vertex, first] in repeats.into_iter().flatten() {
        first_of[vertex as usize] = first;
    }
    Weld::from_first(&first_of)
}

/// Appends every vertex that repeats the position of an earlier one, with the first at that position.
fn repeats_among(positions: &[[f32; 3]], members: &[u32], repeats: &mut Vec<[u32; 2]>) {
    if members.len() < 2 {
        return;
    }
    let mut sorted: Vec<_> = members
        .iter()
        .map(|&v| (key(positions[v as usize]), v))
        .collect();
    sorted.sort_unstable();
    for same in sorted.chunk_by(|a, b| a.0 == b.0) {
        repeats.extend(same[1..].iter().map(|&(_, vertex)| [vertex, same[0].1]));
    }
}

/// The position's bits; adding zero turns -0 into 0.
fn key(position: [f32; 3]) -> [u32; 3] {
    position.map(|v| (v + 0.0).to_bits())
}

/// Spreads keys evenly, the highest bits best.
fn hash([x, y, z]: [u32; 3]) -> u64 {
    let mixed = (u64::from(x) << 32 | u64::from(y)).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let mixed = mixed ^ mixed >> 32 ^ u64::from(z) << 16;
    let mixed = mixed.wrapping_mul(0xbf58_476d_1ce4_e5b9);
    (mixed ^ mixed >> 29).wrapping_mul(0x94d0_49bb_1331_11eb)
}

/// Welds the points that [`weld_exact`] left distinct by distance.
fn weld_near(positions: &[[f32; 3]], exact: &Weld, tolerance: f32) -> Weld {
    let points: Vec<[f32; 3]> = exact
        .first
        .iter()
        .map(|&vertex| positions[vertex as usize])
        .collect();
    let leader_of_point = clusters(&points, tolerance);
    let leaders: Vec<u32> = leader_of_point
        .iter()
        .map(|&leader| exact.first[leader as usize])
        .collect();
    Weld::from_first(&exact.spread(&leaders))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{shuffled_vertices, unindexed, uv_sphere};
    use proptest::prelude::*;

    /// Compares every vertex with every earlier one.
    fn weld_by_comparison(positions: &[[f32; 3]]) -> Weld {
        let first_of: Vec<u32> = (0..positions.len())
            .map(|v| positions.iter().position(|p| *p == positions[v]).unwrap() as u32)
            .collect();
        Weld::from_first(&first_of)
    }

    #[test]
    fn nothing_welds_to_nothing() {
        assert_eq!(weld(&[], 0.0).count(), 0);
        assert_eq!(weld(&[], 0.1).count(), 0);
    }

    #[test]
    fn minus_zero_is_zero() {
        assert_eq!(
            weld(&[[0.0, -0.0, 1.0], [-0.0, 0.0, 1.0]], 0.0).of_vertex,
            [0, 0]
        );
    }

    #[test]
    fn unindexed_meshes_weld_back() {
        let sphere = uv_sphere(12, 8);
        let soup = unindexed(&sphere);
        assert_eq!(
            weld(soup.positions(), 0.0).count(),
            sphere.positions().len()
        );
    }

    #[test]
    fn a_wide_tolerance_welds_everything() {
        let sphere = uv_sphere(12, 8);
        assert_eq!(weld(sphere.positions(), 1.0).count(), 1);
    }

    #[test]
    fn noise_below_the_tolerance_is_welded_away() {
        let sphere = uv_sphere(12, 8);
        let mut soup = unindexed(&sphere).positions().to_vec();
        for (vertex, position) in soup.iter_mut().enumerate() {
            position[vertex % 3] += 1e-6 * (vertex % 5) as f32;
        }
        assert_eq!(weld(&soup, 1e-5).count(), sphere.positions().len());
    }

    proptest! {
        #[test]
        fn agrees_with_comparing_all_pairs(
            positions in prop::collection::vec(prop::array::uniform3((-2i8..3).prop_map(f32::from)), 0..80),
        ) {
            prop_assert_eq!(weld(&positions, 0.0), weld_by_comparison(&positions));
        }

        #[test]
        fn order_of_vertices_does_not_matter(seed: u64, tolerance in prop_oneof![Just(0.0f32), 0.001f32..0.3]) {
            let mesh = unindexed(&crate::testing::random_soup(20, seed));
            let (mixed, moved_to) = shuffled_vertices(&mesh, seed);
            let (before, after) = (weld(mesh.positions(), tolerance), weld(mixed.positions(), tolerance));
            prop_assert_eq!(before.count(), after.count());
            // Two vertices weld before exactly when their moved twins weld after.
            for (vertex, &to) in moved_to.iter().enumerate() {
                let leader = before.first[before.of_vertex[vertex] as usize];
                let moved_leader = moved_to[leader as usize];
                prop_assert_eq!(after.of_vertex[to as usize], after.of_vertex[moved_leader as usize]);
            }
        }
    }
}
