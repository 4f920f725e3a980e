//! Hatching of figures, on both engines: it follows limbs, and leaves faces lighter.

use npr_core::camera::Camera;
use npr_gpu::processor::Processor;
use npr_render::{Frame, Model, Renderer, RendererOptions};
use npr_scene::Scene;
use npr_scene::testing::limb;
use npr_tests::comic::{SIZE, direction, front, pixel, style};
use npr_tests::{Agreement, device};

/// Even, half dark, and round: nothing but the pen counts.
const HALF_DARK: [&str; 4] = [
    "line.crease_angle_deg=60",
    "ink.tone=ink+hatch",
    "light.direction=[0,0.9,0.1]",
    "ink.dark_at=0.35",
];

/// The limb that is made for tests, with bones of these names.
fn figure(names: [&str; 2]) -> Scene {
    let mut scene = limb(true);
    for (node, name) in scene.nodes[1..].iter_mut().zip(names) {
        name.clone_into(&mut node.name);
    }
    scene
}

/// A picture of a scene in a style with settings, from the front; a device draws the same.
fn drawn(scene: &Scene, settings: &[&str]) -> Frame {
    // Draw it on every engine.
    let model = Model::new(scene).unwrap();
    let style = style(&[&HALF_DARK, settings].concat());
    let camera = Camera {
        eye: [0.0, 1.0, 8.0],
        target: [0.0, 1.0, 0.0],
        ..front()
    };
    let draw = |engine| {
        let options = RendererOptions::new(SIZE);
        let mut renderer = Renderer::new(engine, &model, &style, &options).unwrap();
        renderer.draw(&camera).unwrap()
    };
    let ours = draw(&Processor);

    // Compare them.
    if let Some(device) = device() {
        let agreement = Agreement::between(&ours, &draw(device), 2);
        assert!(agreement.within >= 0.998, "{settings:?}: {agreement}");
    }
    ours
}

/// The share of the rows `y` of a picture's middle that is black.
fn ink_share(frame: &Frame, y: std::ops::Range<u32>) -> f32 {
    let places = || y.clone().flat_map(|y| (135..185).map(move |x| (x, y)));
    let black = places().filter(|(x, y)| pixel(frame, *x, *y)[0] < 128);
    black.count() as f32 / places().count() as f32
}

#[test]
fn strokes_run_along_limbs_unless_they_are_asked_to_run_around() {
    let scene = figure(["hip", "knee"]);
    let upright = |settings: &[&str]| direction(&drawn(&scene, settings), 136..184, 60..180)[0];
    let along = upright(&[]);
    assert!(along > 0.5, "along the bone by default: {along}");
    let around = upright(&["ink.follow=around"]);
    assert!(around < -0.5, "{around}");
}

#[test]
fn faces_get_less_hatching_by_default() {
    // The upper half hangs on the head.
    let scene = figure(["hips", "head"]);
    let shares = |settings: &[&str]| {
        let frame = drawn(
            &scene,
            &[&["light.direction=[0,0.9,0.1]"], settings].concat(),
        );
        [30..90, 175..210].map(|rows| ink_share(&frame, rows))
    };
    let [face, body] = shares(&["ink.faces=1"]);
    assert!(face > 0.2 && body > 0.2, "{face} {body}");
    let [less, same] = shares(&[]);
    assert!(
        less < 0.6 * face && same == body,
        "{less} of {face}, {same} of {body}"
    );
    let [some, _] = shares(&["ink.faces=0.8"]);
    assert!(0.0 < some && some < face, "{some} of {face}");
    let [none, same] = shares(&["ink.faces=0"]);
    assert!(none == 0.0 && same == body, "{none}, {same} of {body}");
    // Bones of other names move no face.
    let other = figure(["hips", "neck"]);
    let [without, with] = ["ink.faces=0", "ink.faces=1"].map(|setting| drawn(&other, &[setting]));
    assert!(without.rgba == with.rgba);
}
