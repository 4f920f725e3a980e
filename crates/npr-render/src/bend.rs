//! How a surface bends at its vertices, calmed for drawing.

use npr_core::math;
use npr_mesh::{Edge, Weld};

/// Rounds of averaging that calm curvature on scanned meshes.
const CURVATURE_ROUNDS: u32 = 2;

/// How the surface bends at a welded vertex.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Bend {
    /// Principal curvatures, in 1 / units of the world; positive is convex.
    pub curvatures: [f32; 2],
    /// Direction of the first, packed by [`math::pack_unit`].
    pub direction: u32,
}

/// The bend of every welded vertex; `normals` holds one smooth normal for each.
///
/// `scale` is how much longer things are in the world than in the positions. O(n), parallel.
pub(crate) fn bends(
    positions: &[[f32; 3]],
    triangles: &[[u32; 3]],
    weld: &Weld,
    edges: &[Edge],
    normals: &[[f32; 3]],
    scale: f32,
) -> Vec<Bend> {
    let curvature = npr_mesh::curvature(positions, triangles, weld, normals);
    let areas = npr_mesh::smoothing::vertex_areas(positions, triangles, weld);
    let calm = |values: Vec<f32>| {
        npr_mesh::smooth_curvature(&values, edges, weld, &areas, CURVATURE_ROUNDS)
    };
    let max = calm(curvature.iter().map(|c| c.max / scale).collect());
    let min = calm(curvature.iter().map(|c| c.min / scale).collect());
    let bends = curvature.iter().zip(max.into_iter().zip(min));
    bends
        .map(|(c, (max, min))| Bend {
            curvatures: [max, min],
            direction: math::pack_unit(c.direction),
        })
        .collect()
}
