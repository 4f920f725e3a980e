//! Hulls pushed out by the line width: the twin of `mesh.extrude_hull`.

use crate::pose::{Matrix, apply_normal, blended_matrix};
use npr_core::geometry::{Influence, PosedVertex, Vertex};
use npr_core::math;
use npr_core::surface::apply_point;
use npr_core::window::View;
use rayon::prelude::*;

/// Clip positions of vertices pushed outwards by the whole line width along their welded normals.
///
/// Welded normals are averaged over all vertices at a position, so the hull has no cracks at hard edges.
/// `influences` index into `palette`, the matrices from rest space to the world. O(vertices), parallel.
pub fn extrude(
    view: &View,
    influences: &[Influence],
    palette: &[Matrix],
    vertices: &[Vertex],
    posed: &[PosedVertex],
    hull: &mut [[f32; 4]],
) {
    let inputs = vertices.par_iter().zip(posed).zip(influences);
    hull.par_iter_mut().zip(inputs).with_min_len(1024).for_each(
        |(out, ((vertex, posed), influence))| {
            let m = blended_matrix(palette, influence);
            let normal = apply_normal(&m, math::unpack_unit(vertex.weld_normal));
            let width = 2.0 * posed.half_width * view.pixel_at(posed.depth.max(view.near));
            let pushed = std::array::from_fn(|i| posed.world[i] + normal[i] * width);
            *out = apply_point(&view.clip_from_world, pushed);
        },
    );
}
