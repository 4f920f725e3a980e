//! Draws the ink of a frame, and what it is to show.
//!
//! Two frames are drawn of each view. Of hatching: its ink alone on white paper, without lines, and the light that it
//! is to show. Of brushes: strokes that hold to those of the frame before, as films have them, with the brush and with
//! a plain pen, on white paper without hatching. All ink is black, so it has one measure in all styles. Light stays
//! with the scene, as otherwise it moves with the camera, and so does all ink.

use std::error::Error;

use npr_core::camera::Camera;
use npr_gpu::processor::Processor;
use npr_render::{
    Frame, LayerPixel, LineModel, LineRenderer, Model, Renderer, RendererOptions, StagePixel,
    SurfaceStage,
};
use npr_scene::Scene;
use npr_stylesheet::{Style, StyleError};

use super::ink::{INKED, Inked, Places};
use crate::lines::viewpoint::Viewpoint;
use crate::tones::brightness;

/// How far from edges of objects ink of hatching is judged, in pixels.
pub const EDGE_PX: usize = 4;

/// Bend of depth from pixel to pixel, as a share of the depth, from which a pixel lies at the edge of an object; also
/// the difference up to which two frames show the same place.
const EDGE_DEPTH: f32 = 0.003;

/// The difference of depth up to which two frames show the same place of a stroke, as a share of the depth.
const STROKE_DEPTH: f64 = 0.01;

/// Differences of light up to which it is the same: three steps of a byte.
const SAME_LIGHT: f32 = 3.1 / 255.0;

/// Differences of a plain pen's ink up to which it is the same.
const SAME_PEN: f32 = 0.1;

/// Brightness of what lies below a stroke under which its ink is not known.
const DARK: f32 = 0.5;

/// What puts ink on the paper.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Medium {
    /// Hatching and solid ink on surfaces.
    Hatching,
    /// The brush of strokes.
    Brush,
}

/// A model whose ink is drawn frame by frame.
pub struct InkFilm<'a> {
    medium: Medium,
    size: [u32; 2],
    /// What draws the ink, and what draws what it is due to show.
    renderers: [Renderer<'a>; 2],
}

impl<'a> InkFilm<'a> {
    /// Prepares a model, and its lines, for frames of `size` pixels in a style.
    ///
    /// # Errors
    ///
    /// Whatever planning the frames says.
    pub fn new(
        (model, lines): (&'a Model, &'a LineModel),
        style: &Style,
        medium: Medium,
        size: [u32; 2],
    ) -> Result<Self, Box<dyn Error>> {
        let renderer = |style: &Style, surfaces: SurfaceStage, is_layered: bool| {
            let options = RendererOptions {
                layers: is_layered,
                stages: is_layered,
                surfaces,
                ..RendererOptions::new(size)
            };
            match medium {
                Medium::Hatching => Renderer::new(&Processor, model, style, &options),
                Medium::Brush => {
                    let lines = LineRenderer::new(&Processor, lines);
                    let lined = Renderer::with_lines(&Processor, (model, lines), style, &options);
                    lined.map(|mut renderer| {
                        renderer.hold_strokes();
                        renderer
                    })
                }
            }
        };
        let [drawn, due] = styles(style, medium)?;
        let stage = match medium {
            Medium::Hatching => SurfaceStage::Light,
            Medium::Brush => SurfaceStage::Ink,
        };
        Ok(Self {
            medium,
            size,
            renderers: [
                renderer(&drawn, SurfaceStage::Ink, medium == Medium::Hatching)?,
                renderer(&due, stage, medium == Medium::Brush)?,
            ],
        })
    }

    /// Draws the scene in another pose from now on.
    ///
    /// # Errors
    ///
    /// Whatever posing says.
    pub fn set_pose(&mut self, scene: &Scene) -> Result<(), Box<dyn Error>> {
        for renderer in &mut self.renderers {
            renderer.set_pose(scene)?;
        }
        Ok(())
    }

    /// Draws the next frame.
    ///
    /// # Errors
    ///
    /// Whatever drawing says.
    pub fn draw(&mut self, camera: &Camera) -> Result<Inked, Box<dyn Error>> {
        let view = Viewpoint::new(camera, self.size);
        let [drawn, due] = &mut self.renderers;
        let [drawn, due] = [drawn.draw(camera)?, due.draw(camera)?];
        let (ink, places) = match self.medium {
            Medium::Hatching => (hatched(&drawn), lit(&drawn, &due)),
            Medium::Brush => (brushed(&drawn, &due), stroked(&due)),
        };
        Ok(Inked::new(self.size, view, ink, places))
    }
}

/// A style as it is drawn to show its ink, and as it is drawn to show what that is due to.
fn styles(style: &Style, medium: Medium) -> Result<[Style; 2], StyleError> {
    // Draw black on white under a light that stays with the scene.
    let mut drawn = style.clone();
    for setting in [
        "light.space=world",
        "background=#ffffff",
        "ink.color=#000000",
        "line.color=#000000",
        "line.opacity=1",
    ] {
        drawn.set(setting)?;
    }

    // Leave out what is not asked for.
    let settings: &[&str] = match medium {
        Medium::Hatching => &["line.method=none"],
        Medium::Brush => &["line.method=strokes", "ink.tone=none"],
    };
    for setting in settings {
        drawn.set(setting)?;
    }
    let mut due = drawn.clone();
    if medium == Medium::Brush {
        due.set("line.brush.tip=pen")?;
        due.set("line.brush.image=")?;
    }
    Ok([drawn, due])
}

/// The ink of surfaces, drawn alone on white.
fn hatched(frame: &Frame) -> Vec<f32> {
    let ink = |stage: &StagePixel| 1.0 - brightness(&stage.surface);
    frame.stages.iter().map(ink).collect()
}

/// The ink of lines, over surfaces that may have ink of their own; these are known of another frame.
fn brushed(frame: &Frame, bare: &Frame) -> Vec<f32> {
    let pixels = frame.rgba.chunks_exact(4).zip(&bare.stages);
    pixels
        .map(|(pixel, stage)| {
            let bare = brightness(&stage.surface);
            match bare > DARK {
                true => ((bare - brightness(pixel)) / bare).clamp(0.0, 1.0),
                false => 0.0,
            }
        })
        .collect()
}

/// The surface that a frame of hatching shows, away from edges of objects, and the light on it.
fn lit(frame: &Frame, light: &Frame) -> Places {
    // Find the edges of objects.
    let [width, height] = frame.size.map(|side| side as usize);
    let at_edge = |pixel: usize| {
        let [x, y] = [pixel % width, pixel / width];
        if x == 0 || y == 0 || x + 1 == width || y + 1 == height {
            return true;
        }
        let here = &frame.layers[pixel];
        let is_bent = |step: usize| {
            let [before, after] = [&frame.layers[pixel - step], &frame.layers[pixel + step]];
            let bend = (before.depth + after.depth - 2.0 * here.depth).abs();
            bend > EDGE_DEPTH * here.depth
                || [before, after]
                    .iter()
                    .any(|next| next.object != here.object)
        };
        here.object == 0 || is_bent(1) || is_bent(width)
    };
    let edges: Vec<bool> = (0..frame.layers.len()).map(at_edge).collect();

    // Judge what lies away from them.
    let edges = widened([width, height], &edges, EDGE_PX);
    let depth = |layer: &LayerPixel| match layer.object {
        0 => f64::NAN,
        _ => f64::from(layer.depth),
    };
    Places {
        depths: frame.layers.iter().map(depth).collect(),
        is_judged: edges.iter().map(|edge| !edge).collect(),
        due: light.rgba.chunks_exact(4).map(brightness).collect(),
        same_depth: f64::from(EDGE_DEPTH),
        same_due: SAME_LIGHT,
    }
}

/// The lines that strokes of a plain pen lie on, and the pen's ink.
fn stroked(pen: &Frame) -> Places {
    // Know lines a pixel beyond their strokes, to read between pixels.
    let width = pen.size[0] as usize;
    let depth_at = |pixel: usize| {
        let layer = pen.layers.get(pixel)?;
        (layer.stroke != 0).then_some(f64::from(layer.stroke_depth))
    };
    let depth = |pixel: usize| {
        let around = [
            pixel,
            pixel.wrapping_sub(1),
            pixel + 1,
            pixel.wrapping_sub(width),
            pixel + width,
        ];
        around.into_iter().find_map(depth_at).unwrap_or(f64::NAN)
    };

    // Judge what the pen covers.
    let due = brushed(pen, pen);
    let is_judged = |(layer, ink): (&LayerPixel, &f32)| layer.stroke != 0 && *ink >= INKED;
    Places {
        depths: (0..pen.layers.len()).map(depth).collect(),
        is_judged: pen.layers.iter().zip(&due).map(is_judged).collect(),
        due,
        same_depth: STROKE_DEPTH,
        same_due: SAME_PEN,
    }
}

/// Marks, and all pixels up to `reach` beside them along both axes.
fn widened([width, height]: [usize; 2], marks: &[bool], reach: usize) -> Vec<bool> {
    let widened_along = |marks: &[bool], step: usize, side: usize| -> Vec<bool> {
        let is_near = |pixel: usize| {
            let at = pixel / step % side;
            let from = pixel - at.min(reach) * step;
            let to = pixel + (side - 1 - at).min(reach) * step;
            (from..=to).step_by(step).any(|near| marks[near])
        };
        (0..marks.len()).map(is_near).collect()
    };
    let rows = widened_along(marks, 1, width);
    widened_along(&rows, width, height)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lines::soup::Soup;
    use crate::lines::subjects::scene_of;
    use crate::motion::film::Film;
    use crate::motion::ink::InkTally;
    use crate::motion::step::Step;
    use npr_mesh::testing::icosphere;
    use npr_render::LineModelOptions;

    const SIZE: [u32; 2] = [480, 270];

    /// Four frames of a ball, in a preset with a setting.
    fn ball(film: Film, preset: &str, settings: &[&str], medium: Medium) -> InkTally {
        // Prepare the ball.
        let mesh = icosphere(4);
        let scene = scene_of((mesh.positions().to_vec(), mesh.triangles().to_vec()));
        let (middle, radius) = Soup::of_scene(&scene).ball();
        let mut style = Style::preset(preset).expect("the preset is there");
        for setting in ["ink.hatch.spacing=8px", "line.width.base=5px"]
            .iter()
            .chain(settings)
        {
            style.set(setting).expect("the setting is one");
        }
        let model = Model::new(&scene).expect("the ball is a model");
        let lines = LineModel::new(&scene, &LineModelOptions::default());
        let lines = lines.expect("the ball has lines");

        // Compare its frames.
        let film_of = InkFilm::new((&model, &lines), &style, medium, SIZE);
        let mut ink = film_of.expect("the frame is small");
        let mut tally = InkTally::default();
        let mut last: Option<(Inked, Viewpoint)> = None;
        for frame in 0..4 {
            let camera = film.camera(frame, (middle.as_vec3(), radius as f32), SIZE[1]);
            let inked = ink.draw(&camera).expect("it can be drawn");
            let view = Viewpoint::new(&camera, SIZE);
            if let Some((before, from)) = &last {
                let there = Step {
                    from: *from,
                    to: view,
                    skin: None,
                };
                let back = Step {
                    from: view,
                    to: *from,
                    skin: None,
                };
                tally.add([before, &inked], [&there, &back]);
            }
            last = Some((inked, view));
        }
        assert!(tally.inked[0] > 300, "{:?}", tally.inked);
        tally
    }

    #[test]
    fn nothing_changes_where_nothing_moves() {
        for (preset, medium) in [
            ("crosshatch", Medium::Hatching),
            ("pencil", Medium::Hatching),
            ("brush", Medium::Brush),
            ("charcoal", Medium::Brush),
        ] {
            let tally = ball(Film::Still, preset, &[], medium);
            assert!(tally.is_still(), "{preset}");
            assert!(
                tally.compared_share() > 0.9,
                "{preset}: {}",
                tally.compared_share()
            );
        }
    }

    #[test]
    fn strokes_on_the_surface_stay_there_and_those_on_the_screen_do_not() {
        let share = |mapping: &str| {
            let settings = [mapping, "ink.hatch.pattern=parallel", "ink.hatch.wobble=0"];
            ball(Film::Turn, "crosshatch", &settings, Medium::Hatching).differing_share()
        };
        let [on_surface, on_screen] = ["ink.mapping=surface", "ink.mapping=screen"].map(share);
        assert!(on_surface < 0.02, "{on_surface}");
        assert!(on_screen > 10.0 * on_surface.max(0.01), "{on_screen}");
    }

    #[test]
    fn marks_widen_along_both_axes() {
        let mut marks = vec![false; 7 * 6];
        marks[2 * 7 + 3] = true;
        let wide = widened([7, 6], &marks, 2);
        let inside = |pixel: usize| (1..=5).contains(&(pixel % 7)) && pixel / 7 <= 4;
        assert!((0..42).all(|pixel| wide[pixel] == inside(pixel)));
    }
}
