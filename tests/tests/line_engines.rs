//! The same line drawings from both engines, byte for byte.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

use npr_core::camera::Camera;
use npr_render::{LineMethod, LineModel, LineModelOptions, LineOptions, LineStage};
use npr_scene::{LoadOptions, load};
use npr_style::Style;
use npr_tests::{device, models, samples};
use npr_vector::svg::{SvgOptions, write_svg};
use std::path::Path;

const SIZE: [u32; 2] = [480, 270];

/// Models beside the checkout that are drawn too: one with holes, one of many parts, one with a skeleton.
const MODELS: [&str; 3] = ["stanford_bunny.glb", "flight_helmet.glb", "fox.glb"];

fn model_of(path: &Path) -> LineModel {
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
    let mut stage = LineStage::new(device, &model).unwrap();
    for camera in cameras(&model) {
        for method in [LineMethod::Edges, LineMethod::Surface] {
            let options = LineOptions {
                method,
                ..LineOptions::new(SIZE)
            };
            let style = Style::default();
            let plain = model.draw(&camera, &style, &options).unwrap();
            let found = stage.draw(&camera, &style, &options).unwrap();
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
