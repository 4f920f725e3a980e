//! The published stroke path on a device, from its own depths to strips, beside the processor.

use super::lines::model_of;
use npr_core::camera::{Camera, Projection};
use npr_core::line_kind::KindSet;
use npr_core::window::View;
use npr_gpu::curves::{Hiders, ResidentPixels};
use npr_gpu::engine::Engine;
use npr_mesh::half_edge::HalfEdgeMesh;
use npr_render::{
    LineModel, LineModelOptions, LineOptions, LineRenderer, LineSource, Model, Renderer,
    RendererOptions,
};
use npr_scene::{LoadOptions, load};
use npr_stylesheet::Style;
use npr_tests::{device, models, samples};
use npr_vector::mesh_lines::contour::Eye;
use npr_vector::mesh_lines::draw::eye_of;
use npr_vector::pixel_strokes::side::{Ink, Side};
use npr_vector::pixel_strokes::stroke::Loops;
use npr_vector::pixel_strokes::{
    PixelScene, PublishedPath, Traced, ranked_sides, scene_depths, standings_of, trace,
};
use npr_vector::project::Projector;
use npr_vector::stroke::Drawing;
use std::path::{Path, PathBuf};

const SIZE: [u32; 2] = [480, 270];

/// Models beside the checkout: one with holes, one with a skeleton.
const MODELS: [&str; 2] = ["stanford_bunny.glb", "fox.glb"];

/// The samples of this project, and some models of the shared folder.
fn paths() -> Vec<PathBuf> {
    let named = |path: &PathBuf| MODELS.iter().any(|name| path.ends_with(name));
    samples()
        .into_iter()
        .chain(models().into_iter().filter(named))
        .collect()
}

/// The framing camera and one in parallel view from beside it.
fn cameras(model: &LineModel) -> [Camera; 2] {
    let front = model.framing(SIZE[0] as f32 / SIZE[1] as f32, 0.7);
    let mut parallel = front;
    parallel.eye[0] += 0.3 * model.radius();
    parallel.projection = Projection::Parallel {
        height: 2.0 * model.radius(),
    };
    [front, parallel]
}

/// A view of a model.
struct Seen<'a> {
    shape: &'a HalfEdgeMesh,
    view: View,
    eye: Eye,
}

impl<'a> Seen<'a> {
    fn new(model: &'a LineModel, camera: &Camera) -> Self {
        let (shape, bounds) = (model.shape(), model.bounds());
        Self {
            shape,
            view: camera.view(SIZE, bounds),
            eye: eye_of(shape, &Projector::new(camera, SIZE, bounds)),
        }
    }

    fn scene(&self) -> PixelScene<'_> {
        PixelScene {
            shape: self.shape,
            view: &self.view,
            eye: &self.eye,
            kinds: KindSet::BITS,
            creases: 0.766.into(),
            is_drawn: &[],
        }
    }
}

/// Calls `test` with every model, every view of it, and what the device finds there from its own depths.
fn on_device(test: impl Fn(&Path, &PixelScene<'_>, &Traced, &Loops)) {
    let Some(device) = device() else { return };
    for path in paths() {
        let model = model_of(&path);
        // One shape for all views: it stays on the device.
        let mut resident = ResidentPixels::new(device, model.shape());
        for camera in cameras(&model) {
            let seen = Seen::new(&model, &camera);
            let scene = seen.scene();
            let constants = PublishedPath::default();
            let (traced, loops) = resident.draw(&scene, &constants, Hiders::Surfaces).unwrap();
            assert!(traced.sides.len() > 100, "{}", path.display());
            test(&path, &scene, &traced, &loops);
        }
    }
}

/// The segment of every pixel plus one, by its sides. Ink without sides is surrounded by ink; it is marked with 1.
fn ink_of(traced: &Traced) -> Vec<u32> {
    // Mark the pixels with sides.
    let mut ink = vec![0; (traced.size[0] * traced.size[1]) as usize];
    let mut masks = vec![0; ink.len()];
    for side in &traced.sides {
        let pixel = (side.code / 4) as usize;
        ink[pixel] = side.segment + 1;
        masks[pixel] |= 1 << (side.code % 4);
    }

    // Go on to the ink beyond every side that they lack.
    let beside = [-i64::from(traced.size[0]), 1, i64::from(traced.size[0]), -1];
    let mut open: Vec<usize> = (0..ink.len()).filter(|pixel| ink[*pixel] != 0).collect();
    while let Some(pixel) = open.pop() {
        for way in (0..4).filter(|way| masks[pixel] >> way & 1 == 0) {
            let next = (pixel as i64 + beside[way]) as usize;
            if ink[next] == 0 {
                ink[next] = 1;
                open.push(next);
            }
        }
    }
    ink
}

/// How many pixels show different segments, and how many of those expected have ink.
pub fn off_pixels(found: &Traced, expected: &Traced) -> [usize; 2] {
    let [found, expected] = [found, expected].map(ink_of);
    let differ = found.iter().zip(&expected).filter(|(a, b)| a != b);
    let inked = expected.iter().filter(|owner| **owner != 0);
    [differ.count(), inked.count()]
}

#[test]
fn linking_and_ranking_are_the_processors_bit_for_bit() {
    on_device(|path, _, traced, _| {
        let pixels = ink_of(traced);
        let ink = Ink {
            size: traced.size,
            pixels: &pixels,
        };
        let (sides, ranked) = ranked_sides(&ink.into(), &ink.bits(), None).unwrap();
        let codes = |sides: &[Side]| sides.iter().map(|side| side.code).collect::<Vec<_>>();
        assert!(codes(&traced.sides) == codes(&sides), "{}", path.display());
        assert!(traced.order == ranked.order, "{}", path.display());
        let standings = standings_of(&ranked);
        assert!(traced.standings == standings, "{}", path.display());
    });
}

#[test]
fn pictures_from_the_devices_depths_are_nearly_those_of_the_processor() {
    on_device(|path, scene, traced, _| {
        let depths = scene_depths(scene.shape, scene.view);
        let expected = trace(scene, &PublishedPath::default(), &depths).unwrap();
        assert!(traced.segments == expected.segments, "{}", path.display());
        let [differ, inked] = off_pixels(traced, &expected);
        assert!(
            differ * 1000 <= inked,
            "{}: {differ} of {inked}",
            path.display()
        );
    });
}

#[test]
fn strips_are_the_processors_but_for_rounding() {
    on_device(|path, _, traced, loops| {
        let expected = Loops::new(traced, &PublishedPath::default());
        assert!(loops.spots == expected.spots, "{}", path.display());
        let pairs = loops.kept.iter().zip(&expected.kept);
        let differ = pairs.filter(|(found, expected)| found != expected).count();
        assert!(
            differ * 500 <= loops.kept.len(),
            "{}: {differ} of {}",
            path.display(),
            loops.kept.len()
        );
        for (found, expected) in loops.places.iter().zip(&expected.places) {
            let off = (found.x - expected.x)
                .abs()
                .max((found.y - expected.y).abs());
            assert!(off < 1e-3, "{}: {found:?} {expected:?}", path.display());
        }
    });
}

/// Length of all strokes, in pixels.
fn length_of(drawing: &Drawing) -> f64 {
    let of_points = |points: &[[f64; 2]]| -> f64 {
        let steps = points.windows(2);
        steps
            .map(|pair| (pair[1][0] - pair[0][0]).hypot(pair[1][1] - pair[0][1]))
            .sum()
    };
    let strokes = drawing.strokes.iter();
    strokes
        .map(|stroke| {
            let points: Vec<_> = stroke.points.iter().map(|point| point.position).collect();
            of_points(&points)
        })
        .sum()
}

#[test]
fn drawings_of_both_engines_have_the_same_lines() {
    let Some(device) = device() else { return };
    for path in paths() {
        let model = model_of(&path);
        let mut renderer = LineRenderer::new(device, &model);
        for camera in cameras(&model) {
            let options = LineOptions {
                method: LineSource::Potrace,
                ..LineOptions::new(SIZE)
            };
            let style = Style::default();
            let plain = model.draw(&camera, &style, &options).unwrap();
            let found = renderer.draw(&camera, &style, &options).unwrap();
            let names: Vec<_> = renderer.times().iter().map(|time| time.name).collect();
            let has_clock = names.len() > 1;
            assert!(!has_clock || names.contains(&"vector.draw_surfaces"));
            let [expected, length] = [&plain, &found].map(length_of);
            assert!(
                (length / expected - 1.0).abs() < 0.005,
                "{}: {length} {expected}",
                path.display()
            );
        }
    }
}

#[test]
fn frames_draw_these_lines_on_the_device_too() {
    let Some(device) = device() else { return };
    let scene = load(&samples()[0], &LoadOptions::default()).unwrap();
    let style = npr_tests::lines("potrace");
    let model = Model::new(&scene).unwrap();
    let lines = LineModel::for_style(&scene, &style, &LineModelOptions::default(), None).unwrap();
    let camera = cameras(&lines)[0];
    let drawn = |engine: &dyn Engine| {
        let of_model = (&model, LineRenderer::new(engine, &lines));
        let options = RendererOptions::new(SIZE);
        let mut renderer = Renderer::with_lines(engine, of_model, &style, &options).unwrap();
        renderer.draw(&camera).unwrap()
    };
    let [plain, found] = [drawn(&npr_gpu::processor::Processor), drawn(device)];
    let pixels = plain.rgba.chunks(4).zip(found.rgba.chunks(4));
    let is_off = |(a, b): &(&[u8], &[u8])| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > 2);
    let off = pixels.filter(is_off).count();
    assert!(off < 100, "{off} pixels differ");
    let is_ink = |pixel: &[u8]| pixel[0] < 128;
    assert!(plain.rgba.chunks(4).filter(|pixel| is_ink(pixel)).count() > 500);
}
