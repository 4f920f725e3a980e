//! What a device compiles and submits for a frame: no more than the frame needs, and once.

use npr_gpu::device::{Device, Traffic, testing};
use npr_gpu::engine::{Engine, EngineError, Session};
use npr_gpu::graph::Graph;
use npr_render::{Model, RendererOptions};
use npr_stylesheet::{Style, presets};
use npr_tests::{asset, device, draw_with, models_camera};

const SIZE: [u32; 2] = [160, 90];

/// A device whose passes can do everything, whatever a frame needs.
struct Whole<'a>(&'a Device);

impl Engine for Whole<'_> {
    fn describe(&self) -> String {
        self.0.describe()
    }

    fn prepare(&self, graph: Graph) -> Result<Box<dyn Session>, EngineError> {
        self.0.prepare(graph.with_all_features())
    }
}

fn styles() -> Vec<(String, Style)> {
    // Every preset, and what none of them asks for.
    let presets = presets().iter().map(|preset| {
        let style = Style::preset(preset.name).unwrap();
        (preset.name.to_owned(), style)
    });
    let settings = [
        "line.method=angle",
        "line.method=rim",
        "line.background.method=contrast",
        "light.shadow=true",
        "antialias.samples=1",
        "background=transparent",
    ];
    let set = settings.map(|setting| {
        let mut style = Style::preset("toon").unwrap();
        style.set(setting).unwrap();
        (setting.to_owned(), style)
    });
    presets.chain(set).collect()
}

/// The kernels for a frame draw what those for every frame draw, byte for byte.
#[test]
fn pictures_need_no_more_than_the_features_of_their_style() {
    let Some(device) = device() else { return };
    let model = Model::new(&asset("still_life.glb")).unwrap();
    let camera = models_camera(&model, SIZE);
    let options = RendererOptions::new(SIZE);
    for (name, style) in styles() {
        let draw = |engine: &dyn Engine| draw_with(engine, &model, &style, &camera, &options);
        let (own, whole) = (draw(device), draw(&Whole(device)));
        assert!(own.rgba == whole.rgba, "{name}");
    }
}

/// The work of one frame in a style, once everything is compiled.
fn traffic_of(setting: &str) -> Option<Traffic> {
    // A device of its own: others would count along.
    let device = testing::open()?;
    let model = Model::new(&asset("still_life.glb")).unwrap();
    let camera = models_camera(&model, SIZE);
    let mut style = Style::preset("toon").unwrap();
    style.set(setting).unwrap();
    let options = RendererOptions::new(SIZE);
    let mut renderer = npr_render::Renderer::new(&device, &model, &style, &options).unwrap();
    let before = device.traffic();
    renderer.draw(&camera).unwrap();
    let after = device.traffic();
    Some(Traffic {
        submits: after.submits - before.submits,
        waits: after.waits - before.waits,
    })
}

#[test]
fn a_frame_is_one_submission_and_one_wait() {
    for (setting, most) in [
        ("line.method=shape", 1),
        ("line.background.method=contrast", 1),
        ("line.method=strokes", 2),
    ] {
        let Some(traffic) = traffic_of(setting) else {
            return;
        };
        let Traffic { submits, waits } = traffic;
        assert!(submits <= most && waits <= most, "{setting}: {traffic:?}");
    }
}
