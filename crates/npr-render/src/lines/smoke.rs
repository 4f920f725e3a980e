//! Smoke among the lines of a scene: what it hides, and its own outline.

use super::LineOptions;
use super::tones::{ToneMap, level_lines};
use crate::error::RenderError;
use crate::features::smoke::{Measure, SmokeMoment, lens_of};
use crate::file_light::FileLight;
use crate::light::ChosenLights;
use crate::options::Picture;
use crate::placement::Bounds;
use crate::placement::around;
use crate::smoke::Smoke;
use npr_core::camera::Camera;
use npr_style::smoke::SmokeLook;
use npr_stylesheet::{SmokeLines as Outlining, Style};
use npr_vector::mesh_lines::puff::{Puffs, SilhouettePoint, SmokeLines};
use npr_vector::project::Projector;
use npr_vector::stroke::StrokeSurface;
use std::collections::BTreeMap;

/// Opacity from which smoke hides lines: less is haze.
const DENSE: f32 = 0.5;

/// Most places along a side of the picture where smoke and surfaces are compared.
const SEAM_CELLS: u32 = 1280;

/// Name of the object that smoke is in drawings.
const OBJECT: &str = "smoke";

/// Smoke as one camera sees it.
pub(super) struct SmokeView<'a> {
    pub puffs: Puffs,
    look: SmokeLook,
    style: &'a Style,
    /// Its tones, where they are filled.
    tones: Option<ToneMap>,
    /// Index of its first surface among those of the drawing.
    pub first_surface: u32,
}

impl<'a> SmokeView<'a> {
    /// `bounds` is the box of all that is drawn; `of_file` are the lights of the file, `pictures` those of the style.
    pub fn new(
        smoke: &Smoke,
        (style, options): (&'a Style, &LineOptions),
        (camera, projector, bounds): (&Camera, &Projector, Bounds),
        (of_file, pictures): (&[FileLight], &BTreeMap<String, Picture>),
        first_surface: u32,
    ) -> Result<Self, RenderError> {
        // Choose the lights of the smoke.
        let view = camera.view(options.size, bounds);
        let of_surfaces = ChosenLights::new(style, of_file, Vec::new(), pictures);
        let (chosen, _) = of_surfaces.of_smoke(style);

        // Settle the lens and the lights of this view.
        let measure = Measure {
            height_px: options.size[1] as f32,
            dpi: options.dpi,
            size: options.size,
            samples: 1,
        };
        let lens = lens_of(&view, &style.smoke);
        let lights = chosen.of_frame(style, bounds, None, camera, &view);
        let moment = SmokeMoment {
            smoke,
            style,
            camera,
            view: &view,
            bounds: smoke.extent(),
        };

        // Draw the tones of smoke that is filled.
        let is_toned = options.fill && style.smoke.ramp.len() > 1;
        let tones = is_toned.then(|| ToneMap::new(&moment, chosen, options));
        Ok(Self {
            puffs: Puffs::new(projector, options.size, &smoke.styled(&style.smoke)),
            look: measure.look(style, &lens, smoke.bounds(), &lights, 0),
            style,
            tones: tones.transpose()?,
            first_surface,
        })
    }

    /// Whole width of the outline at a place, in pixels.
    pub fn width_at(&self, point: &SilhouettePoint) -> f64 {
        let outward = point.outward.map(|v| v as f32);
        let (jump, radius_px) = (point.jump as f32, point.radius_px as f32);
        f64::from(self.look.line_width(jump, outward, radius_px))
    }

    /// The smoke as line drawings take it.
    pub fn lines<'b>(
        &'b self,
        width_at: &'b (dyn Fn(&SilhouettePoint) -> f64 + Sync),
    ) -> SmokeLines<'b> {
        let smoke = &self.style.smoke;
        SmokeLines {
            puffs: &self.puffs,
            is_dense: smoke.opacity >= DENSE,
            is_outlined: smoke.line.method != Outlining::Off,
            jump: f64::from(smoke.line.jump),
            surface: self.first_surface,
            width_at,
        }
    }

    /// The surface of the smoke that a place in the picture shows before what lies at `depth`.
    pub fn surface_before(&self, place: [f64; 2], depth: f64) -> Option<u32> {
        let smoke = self.puffs.depth_at(place)?;
        let level = self.tones.as_ref().map_or(0, |tones| tones.level_at(place));
        (smoke < depth).then_some(self.first_surface + level)
    }

    /// The lines between the tones of the smoke: they are not drawn, but divide its colours.
    pub fn tone_edges(&self) -> Vec<[[f64; 2]; 2]> {
        self.tones.as_ref().map_or_else(Vec::new, ToneMap::edges)
    }

    /// The lines along which smoke and surfaces pass through each other; they are not drawn, but divide regions.
    ///
    /// `depth_at` tells how deep the surface at a place of the picture lies. It is compared with the smoke in up to
    /// [`SEAM_CELLS`] places a side.
    pub fn seams(
        &self,
        size: [u32; 2],
        depth_at: &dyn Fn([f64; 2]) -> Option<f64>,
    ) -> Vec<[[f64; 2]; 2]> {
        let cell_px = f64::from(size[0].max(size[1]).div_ceil(SEAM_CELLS).max(1));
        let cells = size.map(|side| (f64::from(side) / cell_px).ceil() as usize);
        let gap = |x: usize, y: usize| {
            let place = [x, y].map(|i| (i as f64 + 0.5) * cell_px);
            let smoke = self.puffs.depth_at(place);
            let gap = smoke.and_then(|smoke| Some(smoke - depth_at(place)?));
            gap.map_or(f32::NAN, |gap| gap as f32)
        };
        level_lines(cells, cell_px, &gap, &[0.0])
    }

    /// The surfaces of the smoke in a drawing, one for every tone, all with one object's number and the colours of the
    /// style.
    pub fn surfaces(&self, object_number: u32) -> impl Iterator<Item = StrokeSurface> {
        let smoke = &self.style.smoke;
        let alpha = (smoke.opacity.clamp(0.0, 1.0) * 255.0 + 0.5) as u8;
        let line = smoke.line.color;
        (1..)
            .zip(&smoke.ramp)
            .map(move |(tone, stop)| StrokeSurface {
                object: OBJECT.to_owned(),
                object_number,
                material: format!("tone {tone}"),
                line_color: [line.r, line.g, line.b, line.a],
                fill_color: [stop.color.r, stop.color.g, stop.color.b, alpha],
            })
    }
}

/// The box of all that is drawn of a scene within `bounds`, which may be empty, and of smoke.
pub(super) fn joined(smoke: Option<&Smoke>, bounds: Bounds, is_empty: bool) -> Bounds {
    match smoke.map(Smoke::extent) {
        None => bounds,
        Some(smoke) if is_empty => smoke,
        Some(smoke) => around(bounds, smoke),
    }
}
