//! Engines, scenes and pictures.

use npr_core::camera::{Camera, Projection};
use npr_gpu::engine::Engine;
use npr_gpu::processor::Processor;
use npr_mesh::testing::icosphere;
use npr_render::{Frame, Model, Picture, RendererOptions};
use npr_scene::Scene;
use npr_stylesheet::Style;
use npr_tests::{Object, device, draw_with, placed, scene_of};

/// Height of what cameras see, in world units.
pub const HEIGHT: f32 = 3.0;

/// The processor, and the device where there is one.
pub fn engines() -> Vec<(&'static str, &'static dyn Engine)> {
    let processor: &dyn Engine = &Processor;
    let device = device().map(|device| ("device", device as &dyn Engine));
    [("processor", processor)]
        .into_iter()
        .chain(device)
        .collect()
}

/// A style with settings over it, and rules.
pub fn styled(style: Style, settings: &[&str], rules: &str) -> Style {
    let mut style = style;
    for setting in settings {
        style.set(setting).expect(setting);
    }
    let text = format!("{}\n{rules}", style.to_toml().unwrap());
    Style::from_toml(&text, &|_| Err(String::new())).unwrap()
}

/// From the front, without perspective.
pub fn front() -> Camera {
    Camera {
        eye: [0.0, 0.0, 8.0],
        target: [0.0; 3],
        up: [0.0, 1.0, 0.0],
        projection: Projection::Parallel { height: HEIGHT },
    }
}

/// A scene before a picture of the frame's size, or what the style has behind it.
pub fn draw(
    engine: &dyn Engine,
    scene: &Scene,
    style: &Style,
    size: [u32; 2],
    behind: Option<&Picture>,
) -> Frame {
    let model = Model::new(scene).unwrap();
    let options = RendererOptions {
        background_image: behind.cloned(),
        ..RendererOptions::new(size)
    };
    let frame = draw_with(engine, &model, style, &front(), &options);
    keep(&frame);
    frame
}

/// Writes pictures into the folder that `NPR_BACKGROUND_PICTURES` names, to look at.
fn keep(frame: &Frame) {
    use std::sync::atomic::{AtomicU32, Ordering};
    static COUNT: AtomicU32 = AtomicU32::new(0);
    if let Ok(folder) = std::env::var("NPR_BACKGROUND_PICTURES") {
        let number = COUNT.fetch_add(1, Ordering::Relaxed);
        let name = std::thread::current()
            .name()
            .unwrap_or("")
            .replace("::", "_");
        let path = std::path::Path::new(&folder).join(format!("{name}_{number:03}.png"));
        npr_tests::write_png(&path, frame).unwrap();
    }
}

/// A picture whose pixels are told by column and row.
pub fn picture(size: [u32; 2], texel: impl Fn(u32, u32) -> [u8; 3]) -> Picture {
    let pixel = |i: u32| {
        let [r, g, b] = texel(i % size[0], i / size[0]);
        [r, g, b, 255]
    };
    Picture {
        size,
        rgba: (0..size[0] * size[1]).flat_map(pixel).collect(),
    }
}

/// Two balls, `Left` and `Right`, far from each other's lines.
pub fn two_balls() -> Scene {
    let ball = |x: f32| placed(&icosphere(4), [0.75; 3], [x, 0.0, 0.0]);
    scene_of(&[
        Object::new("Left", ball(-1.0)).colored([0.03, 0.04, 0.2]),
        Object::new("Right", ball(1.0)).colored([0.2, 0.03, 0.02]),
    ])
}

/// The bytes of a pixel.
pub fn pixel(frame: &Frame, x: u32, y: u32) -> [u8; 4] {
    let at = ((y * frame.size[0] + x) * 4) as usize;
    std::array::from_fn(|i| frame.rgba[at + i])
}

/// The pixels around one, itself included.
pub fn around(size: [u32; 2], x: u32, y: u32) -> impl Iterator<Item = (u32, u32)> {
    let end = |at: u32, most: u32| (at + 2).min(most);
    (y.saturating_sub(1)..end(y, size[1]))
        .flat_map(move |y| (x.saturating_sub(1)..end(x, size[0])).map(move |x| (x, y)))
}

/// Every pixel of a size.
pub fn places(size: [u32; 2]) -> impl Iterator<Item = (u32, u32)> {
    (0..size[1]).flat_map(move |y| (0..size[0]).map(move |x| (x, y)))
}
