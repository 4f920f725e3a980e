//! Lines that files have as geometry, on both engines.

use npr_core::camera::Camera;
use npr_core::line_kind::KindSet;
use npr_drawing::svg::{SvgOptions, write_svg};
use npr_gpu::curves::{Hiders, ResidentPixels};
use npr_gpu::processor::Processor;
use npr_render::{
    Kind, LineModel, LineModelOptions, LineOptions, LineRenderer, LineSource, Model, Renderer,
    RendererOptions,
};
use npr_scene::testing::lines_glb;
use npr_scene::{Limits, MemoryResources, Scene, load_bytes};
use npr_stylesheet::Style;
use npr_tests::{device, lines};
use npr_vector::mesh_lines::draw::eye_of;
use npr_vector::pixel_strokes::stroke::Loops;
use npr_vector::pixel_strokes::{PixelScene, PublishedPath, scene_depths, trace};
use npr_vector::project::Projector;

const SIZE: [u32; 2] = [320, 200];

/// A spring of 300 segments, alone or around a ball that hides its back.
fn spring(with_ball: bool) -> Scene {
    let ball = npr_mesh::testing::icosphere(3);
    let mut positions = if with_ball {
        ball.positions().to_vec()
    } else {
        Vec::new()
    };
    let first = positions.len() as u32;
    positions.extend((0..=300).map(|i| {
        let angle = 0.15 * f64::from(i);
        let [x, z] = [
            npr_core::math::cos_f64(angle),
            npr_core::math::sin_f64(angle),
        ];
        [1.2 * x as f32, 0.008 * i as f32 - 1.2, 1.2 * z as f32]
    }));
    let strip: Vec<u32> = (first..=first + 300).collect();
    let triangles = if with_ball { ball.triangles() } else { &[] };
    let file = lines_glb(&positions, triangles, &[(3, &strip)]);
    let resources = MemoryResources::default();
    load_bytes("spring", &file, None, &resources, &Limits::default()).unwrap()
}

fn model_of(scene: &Scene) -> LineModel {
    LineModel::new(scene, &LineModelOptions::default()).unwrap()
}

fn camera(model: &LineModel) -> Camera {
    model.framing(SIZE[0] as f32 / SIZE[1] as f32, 0.7)
}

#[test]
fn drawings_of_both_engines_are_alike() {
    let Some(device) = device() else { return };
    for scene in [spring(false), spring(true)] {
        let model = model_of(&scene);
        let mut renderer = LineRenderer::new(device, &model);
        for method in [LineSource::Edges, LineSource::Surface, LineSource::Image] {
            let options = LineOptions {
                method,
                ..LineOptions::new(SIZE)
            };
            let (camera, style) = (camera(&model), Style::default());
            let plain = model.draw(&camera, &style, &options).unwrap();
            let of_spring = plain
                .strokes
                .iter()
                .filter(|stroke| stroke.kind == Kind::Marked);
            assert!(of_spring.map(|stroke| stroke.length()).sum::<f64>() > 500.0);
            let found = renderer.draw(&camera, &style, &options).unwrap();
            let [plain, found] = [plain, found].map(|d| write_svg(&d, &SvgOptions::default()));
            assert!(plain == found, "{method:?}");
        }
    }
}

/// Segments, and whatever follows from the device's own depths, bit for bit; owners but for depths on the tolerance.
#[test]
fn the_published_path_takes_polylines_as_the_processor_does() {
    let Some(device) = device() else { return };
    for scene in [spring(false), spring(true)] {
        let model = model_of(&scene);
        let (shape, bounds, camera) = (model.shape(), model.bounds(), camera(&model));
        let view = camera.view(SIZE, bounds);
        let scene = PixelScene {
            shape,
            view: &view,
            eye: &eye_of(shape, &Projector::new(&camera, SIZE, bounds)),
            kinds: KindSet::BITS,
            creases: 0.766.into(),
            is_drawn: &[],
        };
        let path = PublishedPath::default();
        let mut resident = ResidentPixels::new(device, shape);
        let (traced, loops) = resident.draw(&scene, &path, Hiders::Surfaces).unwrap();
        let expected = trace(&scene, &path, &scene_depths(shape, &view)).unwrap();
        assert!(traced.segments == expected.segments);
        let of_polylines = traced
            .segments
            .iter()
            .filter(|segment| shape.polyline_of(segment.edge).is_some());
        assert_eq!(of_polylines.count(), 300);
        let [differ, inked] = super::pixel_strokes::off_pixels(&traced, &expected);
        assert!(inked > 1000 && differ * 500 <= inked, "{differ} of {inked}");
        assert!(loops.spots == Loops::new(&traced, &path).spots);
        // Surfaces without lines take those of their polylines with them.
        let none = PixelScene {
            is_drawn: &[false],
            ..scene
        };
        let (traced, _) = resident.draw(&none, &path, Hiders::Surfaces).unwrap();
        assert_eq!(traced.segments, []);
    }
}

#[test]
fn frames_of_both_engines_have_them() {
    let device = device();
    for (scene, method) in [
        (spring(false), "strokes"),
        (spring(true), "strokes"),
        (spring(true), "potrace"),
    ] {
        let (model, line_model) = (Model::new(&scene).unwrap(), model_of(&scene));
        let style = lines(method);
        let drawn = |engine| {
            let of_model = (&model, LineRenderer::new(engine, &line_model));
            let options = RendererOptions::new(SIZE);
            let mut renderer = Renderer::with_lines(engine, of_model, &style, &options).unwrap();
            renderer.draw(&camera(&line_model)).unwrap()
        };
        let plain = drawn(&Processor);
        let dark = |rgba: &[u8]| rgba.chunks(4).filter(|pixel| pixel[0] < 128).count();
        assert!(dark(&plain.rgba) > 500, "{} pixels", dark(&plain.rgba));
        assert!(plain.notices.is_empty(), "{:?}", plain.notices);
        if let Some(device) = device {
            let found = drawn(device);
            let pairs = plain.rgba.iter().zip(&found.rgba);
            let differ = pairs.filter(|(a, b)| a.abs_diff(**b) > 2).count();
            assert!(differ * 200 <= plain.rgba.len(), "{method}: {differ}");
        }
    }
}
