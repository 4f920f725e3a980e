//! The same line drawings from both engines, byte for byte.

use npr_core::camera::Camera;
use npr_drawing::svg::{SvgOptions, write_svg};
use npr_gpu::engine::Engine;
use npr_gpu::processor::Processor;
use npr_render::{
    LineModel, LineModelOptions, LineOptions, LineRenderer, LineSource, Model, Picture,
    RendererOptions,
};
use npr_scene::{LoadOptions, load};
use npr_stylesheet::Style;
use npr_tests::{device, models, samples};
use std::path::Path;

const SIZE: [u32; 2] = [480, 270];

/// Models beside the checkout that are drawn too: one with holes, one of many parts, one with a skeleton.
const MODELS: [&str; 3] = ["stanford_bunny.glb", "flight_helmet.glb", "fox.glb"];

pub fn model_of(path: &Path) -> LineModel {
    let scene = load(path, &LoadOptions::default()).unwrap();
    LineModel::new(&scene, &LineModelOptions::default()).unwrap()
}

/// The framing camera, one beside it, and one in parallel view.
fn cameras(model: &LineModel) -> [Camera; 3] {
    let front = model.framing(SIZE[0] as f32 / SIZE[1] as f32, 0.7);
    let mut beside = front;
    beside.eye[0] += 0.3 * model.radius();
    let parallel = Camera {
        projection: npr_core::camera::Projection::Parallel {
            height: 2.0 * model.radius(),
        },
        ..front
    };
    [front, beside, parallel]
}

fn check(path: &Path) {
    let Some(device) = device() else { return };
    let model = model_of(path);
    // One stage for all views: the shape stays on the device.
    let mut renderer = LineRenderer::new(device, &model);
    for camera in cameras(&model) {
        for method in [LineSource::Edges, LineSource::Surface] {
            let options = LineOptions {
                method,
                ..LineOptions::new(SIZE)
            };
            let style = Style::default();
            let plain = model.draw(&camera, &style, &options).unwrap();
            let found = renderer.draw(&camera, &style, &options).unwrap();
            let [plain, found] = [plain, found].map(|d| write_svg(&d, &SvgOptions::default()));
            assert!(plain == found, "{}, {method:?}, {camera:?}", path.display());
        }
    }
}

#[test]
fn samples_are_drawn_alike() {
    samples().iter().for_each(|path| check(path));
}

#[test]
fn models_are_drawn_alike() {
    let named = |path: &&std::path::PathBuf| MODELS.iter().any(|name| path.ends_with(name));
    models().iter().filter(named).for_each(|path| check(path));
}

/// A picture that is black on the left and white on the right.
fn two_colors() -> Picture {
    let texel = |i: u32| if i % SIZE[0] < SIZE[0] / 2 { 0 } else { 255 };
    Picture {
        size: SIZE,
        rgba: (0..SIZE[0] * SIZE[1])
            .flat_map(|i| [texel(i), texel(i), texel(i), 255])
            .collect(),
    }
}

/// Colours that mind a picture differ as far as the pictures of two engines do, and nothing else differs.
#[test]
fn colors_that_mind_the_background_agree() {
    let Some(device) = device() else { return };
    let text = "background = 'two.png'\nline.color = '#000'\nline.background = { method = 'contrast', scope = 'all' }";
    let style = Style::from_toml(text, &|_| Err(String::new())).unwrap();
    let behind = RendererOptions {
        background_image: Some(two_colors()),
        ..RendererOptions::new(SIZE)
    };
    let mut counted = [0, 0, 0];
    for path in samples() {
        let scene = load(&path, &LoadOptions::default()).unwrap();
        let lines = LineModel::new(&scene, &LineModelOptions::default()).unwrap();
        let model = Model::new(&scene).unwrap();
        let camera = lines.framing(SIZE[0] as f32 / SIZE[1] as f32, 0.7);
        let engines: [&dyn Engine; 2] = [&Processor, device];
        let [plain, found] = engines.map(|engine| {
            let renderer = LineRenderer::new(engine, &lines);
            let mut renderer = renderer.with_backdrop(&model, &behind);
            let options = LineOptions::new(SIZE);
            renderer.draw(&camera, &style, &options).unwrap()
        });
        assert_eq!(plain.strokes.len(), found.strokes.len());
        for (a, b) in plain.strokes.iter().zip(&found.strokes) {
            assert_eq!(a.points.len(), b.points.len());
            let [own_a, own_b] = [(&plain, a), (&found, b)]
                .map(|(drawing, stroke)| drawing.surfaces[stroke.surface as usize].line_color);
            for (a, b) in a.points.iter().zip(&b.points) {
                assert_eq!(a.position, b.position);
                let (a, b) = (a.color.unwrap_or(own_a), b.color.unwrap_or(own_b));
                let off = (0..4).map(|i| a[i].abs_diff(b[i])).max().unwrap_or(0);
                counted[0] += 1;
                counted[1] += usize::from(off > 2);
                counted[2] += usize::from(a != own_a);
            }
        }
    }
    let [all, apart, lifted] = counted;
    assert!(lifted * 5 > all, "{lifted} of {all} points are lifted");
    assert!(apart * 200 <= all, "{apart} of {all} points differ");
}
