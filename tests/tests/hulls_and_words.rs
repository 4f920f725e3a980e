//! Hulls of cut-out parts, and words that the scene hides, on both engines.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

use npr_gpu::engine::Engine;
use npr_gpu::processor::Processor;
use npr_mesh::testing::plane;
use npr_render::{Font, Frame, Model, StageOptions};
use npr_scene::{AlphaMode, Scene};
use npr_style::{Lettering, Style};
use npr_tests::comic::{SIZE, front, pixel, wall};
use npr_tests::{Object, device, draw_with, placed, scene_of};
use npr_vector::lettering::testing::block_font;

/// Draws a scene on the processor and on a device, where there is one.
fn on_engines(scene: &Scene, style: &Style, options: &StageOptions) -> Vec<Frame> {
    let model = Model::new(scene).unwrap();
    let engines = [
        Some(&Processor as &dyn Engine),
        device().map(|device| device as &dyn Engine),
    ];
    let engines = engines.into_iter().flatten();
    engines
        .map(|engine| draw_with(engine, &model, style, &front(), options))
        .collect()
}

/// A sheet that turns its back to the camera, opaque on its left and clear on its right.
fn half_clear(alpha: AlphaMode) -> Scene {
    let mesh = placed(&plane(8, 8), [-1.6, 1.6, 1.0], [0.8, -0.8, 0.0]);
    let mut sheet = Object::new("Sheet", mesh);
    let opaque = |p: &[f32; 3]| if p[0] < 0.05 { 1.0 } else { 0.0 };
    let alphas: Vec<f32> = sheet.mesh.positions().iter().map(opaque).collect();
    sheet.colors = Some(alphas.iter().map(|a| [1.0, 1.0, 1.0, *a]).collect());
    sheet.material.alpha = alpha;
    scene_of(&[sheet])
}

#[test]
fn a_hull_is_cut_out_as_its_part_is() {
    let mut style = npr_tests::lines("hull");
    style.set("background=#0000ff").unwrap();
    let black = |frame: &Frame, x: std::ops::Range<u32>| {
        let places = x.flat_map(|x| (60..180).map(move |y| (x, y)));
        places
            .filter(|(x, y)| pixel(frame, *x, *y) == [0; 3])
            .count()
    };
    let options = StageOptions::new(SIZE);
    // The sheet reaches 77 pixels to either side of the middle; alpha falls over the tenth beside it.
    for frame in on_engines(&half_clear(AlphaMode::Mask(0.5)), &style, &options) {
        assert_eq!(black(&frame, 100..150), 50 * 120, "where it is opaque");
        assert_eq!(black(&frame, 185..230), 0, "where it is clear");
    }
    for frame in on_engines(&half_clear(AlphaMode::Opaque), &style, &options) {
        assert_eq!(
            black(&frame, 185..230),
            45 * 120,
            "an opaque part has no holes"
        );
    }
}

#[test]
fn words_stand_behind_what_hides_them() {
    let board = placed(&wall(1.0, 0.0), [0.5, 1.0, 1.0], [0.5, 0.0, 1.0]);
    let scene = scene_of(&[Object::new("Board", board)]);
    let words = |hidden| Lettering {
        at: [0.5, 0.5],
        anchor: Some([0.0; 3]),
        hidden,
        ..Lettering::new("HHH", "a.ttf")
    };
    let options = StageOptions {
        fonts: [("a.ttf".to_owned(), Font::new(block_font()).unwrap())].into(),
        ..StageOptions::new(SIZE)
    };
    let drawn = |hidden| {
        let mut style = npr_tests::comic::style(&[]);
        style.lettering = vec![words(hidden)];
        on_engines(&scene, &style, &options)
    };
    // Yellow letters left of the middle, and right of it, where the board stands.
    let letters = |frame: &Frame| {
        let places = (0..SIZE[0]).flat_map(|x| (0..SIZE[1]).map(move |y| (x, y)));
        let yellow = places.filter(|(x, y)| pixel(frame, *x, *y) == [0xff, 0xd4, 0x1f]);
        let sides = yellow.fold([0, 0], |[left, right], (x, _)| match x < SIZE[0] / 2 {
            true => [left + 1, right],
            false => [left, right + 1],
        });
        sides
    };
    for (over, behind) in drawn(false).iter().zip(drawn(true)) {
        let ([left, right], hidden) = (letters(over), letters(&behind));
        assert!(left > 200 && right > 200, "{left} {right}");
        assert_eq!(hidden, [left, 0]);
    }
}
