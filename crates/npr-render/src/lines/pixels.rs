//! Lines traced from a picture of them, as published [Jiang et al. 2022].

use super::finder::Finder;
use super::options::LineOptions;
use super::paint::Paint;
use super::prepared::PreparedOnDemand;
use super::view::LineView;
use crate::error::RenderError;
use npr_core::budget::Budget;
use npr_core::window::View;
use npr_vector::mesh_lines::draw::{LineSettings, StrokeLook, eye_of};
use npr_vector::mesh_lines::puff::{Puffs, SmokeLines};
use npr_vector::pixel_strokes::segment::PixelView;
use npr_vector::pixel_strokes::stroke::Loops;
use npr_vector::pixel_strokes::{BYTES_PER_PIXEL, PixelScene, PublishedPath, Traced};
use npr_vector::stroke::Stroke;

/// The strokes of a view by [`LineSource::Potrace`](super::LineSource), of what was traced; dense smoke hides them, and
/// its own outline comes after.
pub(super) fn strokes(
    view: &LineView<'_>,
    prepared: &PreparedOnDemand<'_>,
    (traced, loops): &(Traced, Loops),
    (settings, look): (&LineSettings, &StrokeLook<'_>),
) -> Result<Vec<Stroke>, RenderError> {
    let (shape, projector) = (view.shape, view.projector);
    let mut strokes = traced.strokes(shape, projector, loops, settings.split, look);
    if let Some(smoke) = view.smoke {
        let all = view.of_mesh(prepared.get()?, settings, look, None)?;
        let of_smoke = all
            .strokes
            .into_iter()
            .filter(|stroke| stroke.surface == smoke.surface);
        strokes.extend(of_smoke);
    }
    Ok(strokes)
}

/// Draws the lines of a view into a picture, ranks the sides of its pixels and cuts their loops; a device leaves the
/// processor the time for `meanwhile`.
pub(super) fn traced(
    view: &LineView<'_>,
    options: &LineOptions,
    paint: &Paint,
    find: &mut dyn Finder,
    meanwhile: &dyn Fn(),
) -> Result<(Traced, Loops), RenderError> {
    // Check that the picture fits into memory.
    let [width, height] = options.size.map(|side| side as usize);
    let mut budget = Budget::new(view.memory_limit);
    budget.take(
        "a picture of lines",
        width * height,
        BYTES_PER_PIXEL as usize,
    )?;

    // Find lines in it, hidden by surfaces and by dense smoke.
    let of_frame = view.camera.view(options.size, view.bounds);
    let occluder_depths = view
        .smoke
        .and_then(|smoke| occluder_depths_of(&of_frame, smoke));
    let scene = PixelScene {
        shape: view.shape,
        view: &of_frame,
        eye: &eye_of(view.shape, view.projector),
        kinds: options.kinds.bits(),
        creases: options.creases_of_pixels(),
        is_drawn: &paint.lined_surfaces(),
    };
    find.pixels(
        &scene,
        &path_of(options),
        occluder_depths.as_deref(),
        meanwhile,
    )
}

/// The constants that a drawing asks for; without smoothing, points keep the places that their pixels give.
fn path_of(options: &LineOptions) -> PublishedPath {
    PublishedPath {
        smooth_places: options.potrace.smooth_places && options.smooth,
        ..options.potrace
    }
}

/// Reversed depths of dense smoke, 0 where there is none; nothing where no smoke hides lines.
pub(super) fn occluder_depths_of(view: &View, smoke: &SmokeLines<'_>) -> Option<Vec<f32>> {
    let puffs: &Puffs = smoke.puffs;
    if !smoke.is_dense || puffs.is_empty() {
        return None;
    }
    let of_pixels = PixelView::new(view);
    let [width, height] = of_pixels.size;
    let depth_at = |pixel: u32| {
        let place = [pixel % width, pixel / width].map(|at| f64::from(at) + 0.5);
        let depth = puffs.depth_at(place);
        depth.map_or(0.0, |depth| of_pixels.z_of(depth as f32).clamp(0.0, 1.0))
    };
    Some((0..width * height).map(depth_at).collect())
}
