//! Averaging a value over neighbouring vertices.

use crate::edges::Edge;
use crate::triangle::Triangle;
use crate::vertex_fans::VertexFans;
use crate::weld::Weld;
use rayon::prelude::*;

/// Area of the surface nearest to each welded vertex, in square units of the positions.
///
/// Voronoi areas, or half and quarters in obtuse triangles [Meyer et al. 2003, 3.3]; they add up to
/// the area of the mesh. They are the weights of [`smooth_curvature`].
pub fn vertex_areas(positions: &[[f32; 3]], triangles: &[[u32; 3]], weld: &Weld) -> Vec<f32> {
    let fans = VertexFans::new(triangles, weld);
    let corner_areas: Vec<[f64; 3]> = triangles
        .par_iter()
        .map(|&indices| Triangle::new(positions, indices).corner_areas())
        .collect();
    let area = |&corner: &u32| corner_areas.as_flattened()[corner as usize];
    (0..fans.count() as u32)
        .map(|welded| fans.around(welded).iter().map(area).sum::<f64>() as f32)
        .collect()
}

/// A value per welded vertex, averaged `rounds` times with the neighbours across each edge.
///
/// Each round replaces a value by the mean of its own and its neighbours', weighted by `areas`. Line
/// width that follows raw curvature flickers on scans; two or three rounds calm it. Values are in any
/// unit, and so are `areas`; vertices without area, or without edges, keep what they have.
///
/// `edges` are those of [`unique_edges`](crate::unique_edges). O(edges) a round.
pub fn smooth_curvature(
    values: &[f32],
    edges: &[Edge],
    weld: &Weld,
    areas: &[f32],
    rounds: u32,
) -> Vec<f32> {
    // Weigh every vertex by its area.
    let pairs = neighbours(edges, weld);
    let weights: Vec<f64> = areas.iter().map(|&area| f64::from(area)).collect();
    let total = gather(&pairs, &weights);
    let mut smoothed = values.to_vec();

    // Replace every value by the mean of those around it, round by round.
    for _ in 0..rounds {
        let weighted: Vec<f64> = smoothed
            .iter()
            .zip(&weights)
            .map(|(&value, weight)| f64::from(value) * weight)
            .collect();
        for (value, (sum, total)) in smoothed
            .iter_mut()
            .zip(gather(&pairs, &weighted).iter().zip(&total))
        {
            if *total > 0.0 {
                *value = (sum / total) as f32;
            }
        }
    }
    smoothed
}

/// The welded ends of every edge, once each.
fn neighbours(edges: &[Edge], weld: &Weld) -> Vec<[u32; 2]> {
    let welded_ends = |edge: &Edge| edge.ends.map(|end| weld.of_vertex[end as usize]);
    // Edges with the same ends, where three or more faces meet, are listed side by side.
    edges
        .chunk_by(|a, b| a.ends == b.ends)
        .map(|same| welded_ends(&same[0]))
        .collect()
}

/// The sum of each vertex's own value and its neighbours'.
fn gather(pairs: &[[u32; 2]], values: &[f64]) -> Vec<f64> {
    let mut sums = values.to_vec();
    for &[a, b] in pairs {
        sums[a as usize] += values[b as usize];
        sums[b as usize] += values[a as usize];
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::edges::unique_edges;
    use crate::mesh::Mesh;
    use crate::testing::{icosphere, random_soup, torus};
    use crate::weld::weld;
    use proptest::prelude::*;

    fn smoothed(mesh: &Mesh, values: &[f32], rounds: u32) -> Vec<f32> {
        let weld = weld(mesh.positions(), 0.0);
        let edges = unique_edges(mesh.positions(), mesh.triangles(), &weld, &[]);
        let areas = vertex_areas(mesh.positions(), mesh.triangles(), &weld);
        smooth_curvature(values, &edges, &weld, &areas, rounds)
    }

    fn spread(values: &[f32]) -> f32 {
        let high = values.iter().copied().fold(f32::MIN, f32::max);
        high - values.iter().copied().fold(f32::MAX, f32::min)
    }

    #[test]
    fn areas_of_a_sphere_add_up_to_its_surface() {
        let sphere = icosphere(4);
        let weld = weld(sphere.positions(), 0.0);
        let areas = vertex_areas(sphere.positions(), sphere.triangles(), &weld);
        let sum: f32 = areas.iter().sum();
        assert!(
            (sum / (4.0 * std::f32::consts::PI) - 1.0).abs() < 0.01,
            "{sum}"
        );
    }

    #[test]
    fn each_round_calms_noise_further() {
        let mesh = torus(32, 16, 1.0, 0.4);
        let noise: Vec<f32> = (0..mesh.positions().len())
            .map(|i| (i * 7919 % 13) as f32)
            .collect();
        let spreads = [0, 1, 3].map(|rounds| spread(&smoothed(&mesh, &noise, rounds)));
        assert!(
            spreads[0] > 2.0 * spreads[1] && spreads[1] > 1.5 * spreads[2],
            "{spreads:?}"
        );
    }

    proptest! {
        #[test]
        fn averages_stay_within_the_values(seed: u64, rounds in 0u32..5, scale in -10.0f32..10.0) {
            let mesh = random_soup(30, seed);
            let count = weld(mesh.positions(), 0.0).count();
            let values: Vec<f32> = (0..count).map(|i| scale * (i % 7) as f32).collect();
            let low = values.iter().copied().fold(f32::MAX, f32::min);
            let high = values.iter().copied().fold(f32::MIN, f32::max);
            let slack = 1e-5 * scale.abs() * 7.0;
            for value in smoothed(&mesh, &values, rounds) {
                prop_assert!((low - slack..=high + slack).contains(&value));
            }
        }

        #[test]
        fn a_constant_stays_the_same(value in -1e3f32..1e3, rounds in 0u32..5) {
            let mesh = icosphere(2);
            for smoothed in smoothed(&mesh, &vec![value; mesh.positions().len()], rounds) {
                prop_assert!((smoothed - value).abs() <= value.abs() * 1e-6);
            }
        }
    }
}
