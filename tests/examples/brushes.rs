//! Draws a ring and a ball with every tip of a brush, beside each other: the figure of the README.
//!
//! `cargo run -p npr-tests --example brushes -- docs/figures`

#![allow(clippy::unwrap_used, reason = "a figure that cannot be drawn is none")]

use npr_core::camera::Camera;
use npr_gpu::processor::Processor;
use npr_mesh::testing::{icosphere, torus};
use npr_render::{RendererOptions, Subject};
use npr_stylesheet::Style;
use npr_tests::{Object, beside, placed, scene_of, write_png};
use std::path::PathBuf;

/// The tips, in the order of the figure.
const TIPS: [&str; 10] = [
    "pen",
    "g-pen",
    "brush",
    "dry-brush",
    "marker",
    "pencil",
    "charcoal",
    "chalk",
    "airbrush",
    "sketch",
];

/// Size of a picture in the figure, in pixels.
const SIZE: [u32; 2] = [288, 216];

fn main() {
    let folder: PathBuf = std::env::args_os().nth(1).unwrap_or_default().into();
    let ring = placed(&torus(160, 80, 1.0, 0.42), [1.0; 3], [0.0; 3]);
    let ball = placed(&icosphere(5), [0.5; 3], [1.05, 0.35, 1.2]);
    let scene = scene_of(&[Object::new("Ring", ring), Object::new("Ball", ball)]);
    let camera = Camera {
        eye: [0.9, 2.9, 3.5],
        target: [0.2, 0.0, 0.2],
        ..Camera::framing([-1.0; 3], [1.0; 3])
    };
    let frames = TIPS.map(|tip| {
        // Thick lines that swell and run out, on a light ground.
        let mut style = Style::preset("g-pen").unwrap();
        for setting in [
            "line.width.base=10px",
            "line.width.taper.ends=all",
            "line.width.taper.start=30px",
            "line.width.taper.end=90px",
            "line.color=#1b2440",
            "background=#fbf8f0",
            "shade.paper=#fbf8f0",
            &format!("line.brush.tip={tip}"),
        ] {
            style.set(setting).unwrap();
        }
        let subject = Subject::new(&scene, &style).unwrap();
        let options = RendererOptions::new(SIZE);
        let mut renderer = subject.renderer(&Processor, &style, &options).unwrap();
        renderer.draw(&camera).unwrap()
    });
    write_png(&folder.join("brushes.png"), &beside(&frames, 5)).unwrap();
}
