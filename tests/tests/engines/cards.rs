//! Grass drawn by a line for each blade, in frames of both engines and by both kinds of sight.

use npr_core::camera::{Camera, Projection};
use npr_gpu::engine::Engine;
use npr_gpu::processor::Processor;
use npr_render::{Frame, RendererOptions, Subject};
use npr_scene::{Limits, MemoryResources, Scene, load_bytes};
use npr_stylesheet::Style;
use npr_tests::{device, lines};

const SIZE: [u32; 2] = [360, 240];

/// Nine blades side by side before a wall, in obj text; each 0.09 wide, bent and twisted.
fn grass() -> Scene {
    let wall = "o wall\nusemtl wall\nv -9 -9 -2\nv 9 -9 -2\nv 9 9 -2\nv -9 9 -2\nf 1 2 3 4\n";
    let mut text = format!("{wall}o grass\nusemtl grass\n");
    let mut first = 5;
    for number in 0..9 {
        let root = 0.24 * f64::from(number) - 0.96;
        for row in 0..8 {
            let t = f64::from(row) / 7.0;
            let turn = 0.3 * f64::from(number) * t;
            let [c, s] = [npr_core::math::cos_f64(turn), npr_core::math::sin_f64(turn)];
            let half = 0.045 * (1.0 - 0.7 * t);
            for side in [-half, half] {
                let place = [root + side * c, 1.4 * t - 0.7, side * s + 0.3 * t * t];
                text += &format!("v {} {} {}\n", place[0], place[1], place[2]);
            }
        }
        for row in 0..7 {
            let [a, b, c, d] = [0, 1, 3, 2].map(|corner| first + 2 * row + corner);
            text += &format!("f {a} {b} {c} {d}\n");
        }
        first += 16;
    }
    let resources = MemoryResources::default();
    let mut scene = load_bytes(
        "grass.obj",
        text.as_bytes(),
        None,
        &resources,
        &Limits::default(),
    )
    .unwrap();
    scene
        .materials
        .iter_mut()
        .for_each(|material| material.double_sided = true);
    scene
}

fn style(method: &str, cards: &str, sights: &str) -> Style {
    let mut style = lines(method);
    let rule =
        format!("rule=[{{ match = {{ material = 'grass' }}, line = {{ cards = '{cards}' }} }}]");
    let sights = format!("line.visibility={sights}");
    for setting in [&rule, &sights, "line.width.base=2px", "line.width.room=0"] {
        style.set(setting).unwrap();
    }
    style
}

fn draw(engine: &dyn Engine, style: &Style) -> Frame {
    let subject = Subject::new(&grass(), style).unwrap();
    let camera = Camera {
        eye: [0.0, 0.0, 5.0],
        target: [0.0; 3],
        up: [0.0, 1.0, 0.0],
        projection: Projection::Perspective { fov_y: 0.5 },
    };
    let mut renderer = subject
        .renderer(engine, style, &RendererOptions::new(SIZE))
        .unwrap();
    renderer.draw(&camera).unwrap()
}

/// Dark runs along a row of pixels, and their pixels.
fn runs(frame: &Frame, row: u32) -> [usize; 2] {
    let at = |x: u32| frame.rgba[4 * (row * SIZE[0] + x) as usize] < 128;
    let dark: Vec<bool> = (0..SIZE[0]).map(at).collect();
    let runs = dark.chunk_by(|a, b| a == b).filter(|run| run[0]);
    [runs.count(), dark.iter().filter(|dark| **dark).count()]
}

#[test]
fn every_blade_of_a_frame_is_one_line() {
    let device = device();
    for (method, sights) in [
        ("strokes", "exact"),
        ("strokes", "sampled"),
        ("potrace", "exact"),
    ] {
        let centre = style(method, "centre", sights);
        let plain = draw(&Processor, &centre);
        // As wide as the blades below, thin as the pen above.
        for (row, at_least) in [(180, 45), (150, 36), (110, 18), (70, 16)] {
            let [count, dark] = runs(&plain, row);
            assert_eq!(count, 9, "{method} {sights}: row {row}");
            assert!(
                dark >= at_least && dark < 90,
                "{method} {sights}: {dark} in row {row}"
            );
        }
        // Their outlines are two lines each.
        let outline = draw(&Processor, &style(method, "outline", sights));
        if method == "strokes" {
            assert!(runs(&outline, 180)[0] > 12, "{:?}", runs(&outline, 180));
        }
        if let Some(device) = device {
            let found = draw(device, &centre);
            let pairs = plain.rgba.iter().zip(&found.rgba);
            let differ = pairs.filter(|(a, b)| a.abs_diff(**b) > 2).count();
            assert!(
                differ * 200 <= plain.rgba.len(),
                "{method} {sights}: {differ}"
            );
        }
    }
}

/// Lines that are found on images know of no cards.
#[test]
fn other_methods_draw_grass_as_ever_and_say_so() {
    let [centre, outline] = ["centre", "outline"].map(|cards| style("shape", cards, "exact"));
    assert!(draw(&Processor, &centre).rgba == draw(&Processor, &outline).rgba);
}
