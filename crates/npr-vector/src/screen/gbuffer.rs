//! The surface under every pixel: the twin of `line.resolve_gbuffer`.

use npr_core::geometry::{GPixel, Part, PosedVertex, Triangle};
use npr_core::math;
use npr_core::raster::ID_MASK;
use npr_core::surface::{
    blend, blend3, cross, dot, face_normal, faces_eye, offset_from, weights_at,
};
use npr_core::window::{View, Window};
use rayon::prelude::*;

/// The input of [`resolve`].
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

/// Depth, normal and part at every pixel of the grid, from the triangle numbers in `ids`
/// [Saito & Takahashi 1990].
///
/// O(pixels), parallel over rows.
pub fn resolve(on: &Surfaces<'_>, ids: &[u32], gbuffer: &mut [GPixel]) {
    let width = on.window.size[0] as usize;
    gbuffer
        .par_chunks_mut(width)
        .zip(ids.par_chunks(width))
        .enumerate()
        .for_each(|(y, (row, ids))| {
            for (x, (pixel, id)) in row.iter_mut().zip(ids).enumerate() {
                *pixel = match (id & ID_MASK).checked_sub(1) {
                    Some(triangle) => {
                        on.pixel_of_triangle(triangle, on.window.frame_at(x as u32, y as u32))
                    }
                    None => GPixel::EMPTY,
                };
            }
        });
}

impl Surfaces<'_> {
    /// Change of the plane coordinate over one pixel to the right and down.
    ///
    /// Weights change linearly over the picture before they are divided by their sum; of the two sums that make the
    /// coordinate, one is constant.
    fn plane_step(&self, clip: [[f32; 4]; 3], depths: [f32; 3], ndc: [f32; 2]) -> [f32; 2] {
        // Set up the weights of the corners, and how they change from pixel to pixel.
        let [a, b, c] = clip.map(|v| offset_from(v, ndc));
        let [wa, wb, wc] = clip.map(|v| v[3]);
        let weights = [cross(b, c), cross(c, a), cross(a, b)];
        let per_x = [
            b[1] * wc - c[1] * wb,
            c[1] * wa - a[1] * wc,
            a[1] * wb - b[1] * wa,
        ];
        let per_y = [
            wb * c[0] - wc * b[0],
            wc * a[0] - wa * c[0],
            wa * b[0] - wb * a[0],
        ];

        // Divide out perspective.
        let parallel = self.view.perspective < 0.5;
        let (top, bottom) = if parallel {
            (
                [dot(per_x, depths), dot(per_y, depths)],
                weights[0] + weights[1] + weights[2],
            )
        } else {
            (
                [
                    per_x[0] + per_x[1] + per_x[2],
                    per_y[0] + per_y[1] + per_y[2],
                ],
                dot(weights, depths),
            )
        };
        if bottom == 0.0 {
            return [0.0; 2];
        }

        // Turn changes over the view into changes over a pixel.
        let (step, frame) = (self.window.frame_step, self.view.frame_px);
        [
            top[0] / bottom * (2.0 * step[0] / frame[0]),
            top[1] / bottom * (-2.0 * step[1] / frame[1]),
        ]
    }

    /// The pixel of a triangle at a point of the frame.
    fn pixel_of_triangle(&self, triangle: u32, frame_px: [f32; 2]) -> GPixel {
        // Weigh the corners under the pixel.
        let view = self.view;
        let triangle = &self.triangles[triangle as usize];
        let corners = triangle.corners.map(|v| &self.posed[v as usize]);
        let clip = corners.map(|v| v.clip);
        let depths = corners.map(|v| v.depth);
        let ndc = view.ndc_at(frame_px);
        let weights = weights_at(clip, ndc);

        // Take the normal of the face where a part shows its folds, else blend normals.
        let part = &self.parts[triangle.part as usize];
        let normal = if part.flags & Part::FOLDS != 0 {
            face_normal(corners.map(|v| v.world))
        } else {
            blend3(weights, corners.map(|v| v.normal))
        };
        GPixel {
            plane_step: self.plane_step(clip, depths, ndc),
            depth: blend(weights, depths),
            half_width: blend(weights, corners.map(|v| v.half_width)),
            normal: math::pack_unit(if faces_eye(clip) {
                normal
            } else {
                normal.map(|v| -v)
            }),
            part: triangle.part,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use npr_core::camera::{Camera, Projection};
    use npr_core::surface::apply_point;
    use proptest::prelude::*;

    fn plane_seen(projection: Projection, corners: [[f32; 3]; 3]) -> Vec<GPixel> {
        let size = [16, 16];
        let camera = Camera {
            eye: [0.0, 0.0, 5.0],
            target: [0.0; 3],
            up: [0.0, 1.0, 0.0],
            projection,
        };
        let view = camera.view(size, ([-4.0; 3], [4.0; 3]));
        let posed = corners.map(|world| PosedVertex {
            clip: apply_point(&view.clip_from_world, world),
            world,
            depth: 5.0 - world[2],
            normal: [0.0, 0.0, 1.0],
            half_width: 1.0,
        });
        let window = Window::over([16.0; 2], [0.0; 2], [16.0; 2], size);
        let triangles = [Triangle {
            corners: [0, 1, 2],
            part: 0,
        }];
        let on = Surfaces {
            view: &view,
            window: &window,
            posed: &posed,
            triangles: &triangles,
            parts: &[Part::default()],
        };
        let mut gbuffer = vec![GPixel::EMPTY; 256];
        resolve(&on, &[1; 256], &mut gbuffer);
        let coordinates = gbuffer
            .iter()
            .map(|pixel| view.plane_coordinate(pixel.depth));
        for (pixel, coordinate) in gbuffer.clone().iter().zip(coordinates) {
            assert!(pixel.depth.is_finite() && coordinate.is_finite());
        }
        gbuffer
    }

    proptest! {
        #[test]
        fn the_plane_step_predicts_the_neighbour(z in prop::array::uniform3(-2f32..2.0), parallel: bool) {
            let projection =
                if parallel { Projection::Parallel { height: 3.0 } } else { Projection::Perspective { fov_y: 0.6 } };
            let corners = [[-6.0, -6.0, z[0]], [6.0, -6.0, z[1]], [0.0, 8.0, z[2]]];
            let coordinate = |depth: f32| if parallel { depth } else { 1.0 / depth };
            let gbuffer = plane_seen(projection, corners);
            for y in 0..15 {
                for x in 0..15 {
                    let at = y * 16 + x;
                    let (here, right, down) = (&gbuffer[at], &gbuffer[at + 1], &gbuffer[at + 16]);
                    let at = coordinate(here.depth);
                    prop_assert!((coordinate(right.depth) - at - here.plane_step[0]).abs() < 1e-4 * at.abs());
                    prop_assert!((coordinate(down.depth) - at - here.plane_step[1]).abs() < 1e-4 * at.abs());
                }
            }
        }
    }
}
