//! Vertices as a light sees them: the twin of `mesh.project_shadow`.

use crate::pose::Matrix;
use npr_core::geometry::PosedVertex;
use npr_core::surface::apply_point;
use rayon::prelude::*;

/// Clip positions of posed vertices by `light_from_world`, the view of a light that throws shadows. O(vertices),
/// parallel.
pub fn project(light_from_world: &Matrix, posed: &[PosedVertex], projected: &mut [[f32; 4]]) {
    let inputs = projected.par_iter_mut().zip(posed);
    inputs
        .with_min_len(1024)
        .for_each(|(out, vertex)| *out = apply_point(light_from_world, vertex.world));
}
