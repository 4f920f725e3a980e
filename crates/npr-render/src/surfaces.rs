//! What a camera sees of a model's surfaces, on the host: for what is drawn over a finished frame.

use crate::model::Model;
use glam::Mat4;
use npr_core::cutout::Cutout;
use npr_core::geometry::Part;
use npr_core::raster::{Fill, Sides, fill_triangles, triangle_of};
use npr_core::surface::weights_at;
use npr_core::window::{View, Window};

/// What every pixel of a grid over the whole frame shows, row by row from the top.
pub(crate) struct Surfaces {
    /// Triangle numbers as [`triangle_of`] reads them; 0 where there is no surface.
    pub ids: Vec<u32>,
    /// Reversed depths; 0 where there is no surface.
    pub depths: Vec<f32>,
}

impl Surfaces {
    /// The surfaces in a view.
    ///
    /// `parts` say which sides are seen and which parts are beams, that hide nothing; cut-out parts have holes.
    /// O(vertices + triangles + pixels).
    pub fn new(model: &Model, parts: &[Part], view: &View, size: [u32; 2]) -> Self {
        // Project the vertices.
        let clip_from_world = Mat4::from_cols_array_2d(&view.clip_from_world);
        let points = model.vertices.iter().zip(&model.influences);
        let clip: Vec<[f32; 4]> = points
            .map(|(vertex, influence)| {
                let point = model.posed_point(vertex, influence);
                (clip_from_world * point.extend(1.0)).to_array()
            })
            .collect();

        // Find the holes of cut-out parts.
        let cutout = Cutout {
            posed: &[],
            vertices: &model.vertices,
            triangles: &model.triangles,
            parts,
            texels: model.textures.words(),
        };
        let is_hole = |triangle: u32, ndc| {
            let corners = model.triangles[triangle as usize].corners;
            cutout.is_hole_at(triangle, weights_at(corners.map(|v| clip[v as usize]), ndc))
        };

        // Draw the triangles without them.
        let window = Window::over(view.frame_px, [0.0; 2], view.frame_px, size);
        let fill = Fill {
            window: &window,
            triangles: &model.triangles,
            parts,
            sides: Sides::AsParts,
            id_bits: 0,
            clip_of: |v| clip[v as usize],
            keep: |id, x, y| !is_hole(triangle_of(id), view.ndc_at(window.frame_at(x, y))),
        };
        let count = size[0] as usize * size[1] as usize;
        let (mut ids, mut depths) = (vec![0; count], vec![0; count]);
        fill_triangles(&fill, &mut ids, &mut depths);
        let depths = depths.into_iter().map(f32::from_bits).collect();
        Self { ids, depths }
    }
}
