//! The surface under every pixel: the twin of `line.resolve_gbuffer`.

use npr_core::geometry::{GPixel, Part, PosedVertex, Triangle};
use npr_core::math;
use npr_core::raster::ID_MASK;
use npr_core::surface::{blend, blend3, faces_eye, unit_or_z, weights_at};
use npr_core::window::{View, Window};
use rayon::prelude::*;

/// What the surface is found on.
#[derive(Debug, Clone, Copy)]
pub struct Surfaces<'a> {
    /// Camera and frame.
    pub view: &'a View,
    /// The pixel grid.
    pub window: &'a Window,
    /// Posed vertices.
    pub posed: &'a [PosedVertex],
    /// Triangles.
    pub triangles: &'a [Triangle],
    /// Parts.
    pub parts: &'a [Part],
}

/// Depth, normal, object and material at every pixel of the grid, from the triangle numbers in `ids`
/// [Saito & Takahashi 1990].
///
/// O(pixels), parallel over rows.
pub fn resolve(on: &Surfaces<'_>, ids: &[u32], gbuffer: &mut [GPixel]) {
    let width = on.window.size[0] as usize;
    gbuffer.par_chunks_mut(width).zip(ids.par_chunks(width)).enumerate().for_each(|(y, (row, ids))| {
        for (x, (pixel, id)) in row.iter_mut().zip(ids).enumerate() {
            *pixel = match (id & ID_MASK).checked_sub(1) {
                Some(triangle) => on.pixel_of_triangle(triangle, on.window.frame_at(x as u32, y as u32)),
                None => GPixel::EMPTY,
            };
        }
    });
}

impl Surfaces<'_> {
    /// The pixel of a triangle at a point of the frame.
    fn pixel_of_triangle(&self, triangle: u32, frame_px: [f32; 2]) -> GPixel {
        let (view, step) = (self.view, self.window.frame_step);
        let triangle = &self.triangles[triangle as usize];
        let corners = triangle.corners.map(|v| &self.posed[v as usize]);
        let clip = corners.map(|v| v.clip);
        let depths = corners.map(|v| v.depth);
        let weights = weights_at(clip, view.ndc_at(frame_px));
        let right = weights_at(clip, view.ndc_at([frame_px[0] + step[0], frame_px[1]]));
        let down = weights_at(clip, view.ndc_at([frame_px[0], frame_px[1] + step[1]]));
        let depth = blend(weights, depths);
        let here = view.plane_coordinate(depth);
        let normal = unit_or_z(blend3(weights, corners.map(|v| v.normal)));
        let part = &self.parts[triangle.part as usize];
        GPixel {
            plane_step: [
                view.plane_coordinate(blend(right, depths)) - here,
                view.plane_coordinate(blend(down, depths)) - here,
            ],
            depth,
            half_width: blend(weights, corners.map(|v| v.half_width)),
            normal: math::pack_unit(if faces_eye(clip) { normal } else { normal.map(|v| -v) }),
            object: part.object,
            material: part.material,
            part: triangle.part,
        }
    }
}
