//! Lines from a picture of them, as published.

use super::paint::Paint;
use super::{LineModel, LineOptions, LineView};
use crate::error::RenderError;
use npr_core::budget::Budget;
use npr_core::window::View;
use npr_vector::draw::{LineSettings, Prepared, StrokeLook, eye_of, strokes_with};
use npr_vector::pixel_contour::segment::PixelView;
use npr_vector::pixel_contour::{
    BYTES_PER_PIXEL, PixelScene, PublishedPath, Traced, scene_depths, trace,
};
use npr_vector::puff::{Puffs, SmokeLines};
use npr_vector::stroke::Stroke;

impl LineModel {
    /// The strokes of a view by [`LineMethod::Potrace`](super::LineMethod); dense smoke hides them, and its own outline comes after.
    pub(super) fn pixel_strokes(
        &self,
        prepared: &Prepared,
        view: &LineView<'_>,
        options: &LineOptions,
        (settings, paint): (&LineSettings, &Paint),
        look: &StrokeLook<'_>,
    ) -> Result<Vec<Stroke>, RenderError> {
        let path = path_of(options);
        let traced = self.traced(view, options, &path, paint)?;
        let (shape, projector) = (&self.shape, view.projector);
        let mut strokes = traced.strokes(shape, projector, &path, options.split, look);
        if let Some(smoke) = view.smoke {
            let contours = view.contours;
            let all = strokes_with(
                shape,
                prepared,
                projector,
                settings,
                contours,
                look,
                Some(smoke),
            );
            let of_smoke = all
                .into_iter()
                .filter(|stroke| stroke.surface == smoke.surface);
            strokes.extend(of_smoke);
        }
        Ok(strokes)
    }

    /// Draws the lines of a view into a picture and ranks the sides of its pixels.
    fn traced(
        &self,
        view: &LineView<'_>,
        options: &LineOptions,
        path: &PublishedPath,
        paint: &Paint,
    ) -> Result<Traced, RenderError> {
        let [width, height] = options.size.map(|side| side as usize);
        let mut budget = Budget::new(self.memory_limit);
        budget.take(
            "a picture of lines",
            width * height,
            BYTES_PER_PIXEL as usize,
        )?;
        let of_frame = view.camera.view(options.size, view.bounds);
        let mut depths = scene_depths(&self.shape, &of_frame);
        if let Some(smoke) = view.smoke {
            lay_smoke(&mut depths, &of_frame, smoke);
        }
        let scene = PixelScene {
            shape: &self.shape,
            view: &of_frame,
            eye: &eye_of(&self.shape, view.projector),
            kinds: options.kinds.bits(),
            crease_cos: npr_core::math::cos(options.crease),
            is_drawn: &paint.lined_surfaces(),
        };
        Ok(trace(&scene, path, &depths)?)
    }
}

/// The constants that a drawing asks for; places are as the pixels have them where strokes are not smoothed.
fn path_of(options: &LineOptions) -> PublishedPath {
    PublishedPath {
        smooth_places: options.potrace.smooth_places && options.smooth,
        ..options.potrace
    }
}

/// Brings depths nearer where dense smoke stands before the scene.
fn lay_smoke(depths: &mut [f32], view: &View, smoke: &SmokeLines<'_>) {
    let puffs: &Puffs = smoke.puffs;
    if !smoke.is_dense || puffs.is_empty() {
        return;
    }
    let of_pixels = PixelView::new(view);
    let width = of_pixels.size[0] as usize;
    let rows = depths.chunks_mut(width.max(1)).enumerate();
    for (y, row) in rows {
        for (x, z) in row.iter_mut().enumerate() {
            let place = [x as f64 + 0.5, y as f64 + 0.5];
            if let Some(depth) = puffs.depth_at(place) {
                *z = z.max(of_pixels.z_of(depth as f32).clamp(0.0, 1.0));
            }
        }
    }
}
