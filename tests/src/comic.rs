//! Small scenes in black ink: how they are drawn, and how their strokes run.

use crate::{draw_from, placed};
use npr_core::camera::{Camera, Projection};
use npr_mesh::Mesh;
use npr_mesh::testing::plane;
use npr_render::Frame;
use npr_scene::Scene;
use npr_stylesheet::Style;

/// Width and height of the pictures.
pub const SIZE: [u32; 2] = [320, 240];

/// White surfaces on blue, inked black and lit from the right; without lines.
const BASE: &[&str] = &[
    "background=#0000ff",
    "line.method=none",
    "shade.mode=paper",
    "light.direction=[1,0,0]",
    "light.space=camera",
    "ink.hatch.spacing=12px",
];

/// A style of white paper on blue, with settings over it.
pub fn style(settings: &[&str]) -> Style {
    let mut style = Style::default();
    style.shade.ramp.truncate(1);
    style.shade.ramp[0].light = 1.0;
    style.shade.ramp[0].tint = None;
    for setting in BASE.iter().chain(settings) {
        style.set(setting).unwrap();
    }
    style
}

/// From the front, a picture as high as two units and a half.
pub fn front() -> Camera {
    Camera {
        eye: [0.0, 0.0, 8.0],
        target: [0.0; 3],
        up: [0.0, 1.0, 0.0],
        projection: Projection::Parallel { height: 2.5 },
    }
}

/// Draws a scene from the front in a style with settings.
pub fn draw(scene: &Scene, settings: &[&str]) -> Frame {
    draw_from(scene, &style(settings), &front(), SIZE).frame
}

/// A wall of twice `size` a side across the view, at depth `z`.
pub fn wall(size: f32, z: f32) -> Mesh {
    placed(
        &plane(8, 8),
        [2.0 * size, 2.0 * size, 1.0],
        [-size, -size, z],
    )
}

/// The colour of a pixel.
pub fn pixel(frame: &Frame, x: u32, y: u32) -> [u8; 3] {
    let at = ((y * frame.size[0] + x) * 4) as usize;
    [frame.rgba[at], frame.rgba[at + 1], frame.rgba[at + 2]]
}

/// Directions of strokes in a square of the picture: mean of the doubled angle of gradients, as a vector, 0..1 long.
pub fn direction(frame: &Frame, x: std::ops::Range<u32>, y: std::ops::Range<u32>) -> [f32; 2] {
    let value = |x: u32, y: u32| f32::from(pixel(frame, x, y)[0]) / 255.0;
    let (mut sum, mut weight) = ([0.0f32; 2], 0.0f32);
    for (x, y) in x.flat_map(|x| y.clone().map(move |y| (x, y))) {
        let dx = value(x + 1, y) - value(x - 1, y);
        let dy = value(x, y + 1) - value(x, y - 1);
        sum = [sum[0] + dx * dx - dy * dy, sum[1] + 2.0 * dx * dy];
        weight += dx * dx + dy * dy;
    }
    sum.map(|v| v / weight.max(1e-6))
}
