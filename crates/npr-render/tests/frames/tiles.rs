//! How large a frame may be that is drawn whole.

use std::cell::RefCell;

use npr_gpu::engine::{Engine, EngineError, Session};
use npr_gpu::graph::{Graph, Kind, Resource};
use npr_render::{
    LineModel, LineModelOptions, LineRenderer, Model, Renderer, RendererOptions, Smoke, Sphere,
};
use npr_scene::testing::Sheet;
use npr_scene::{Limits, MemoryResources, load_bytes};
use npr_stylesheet::{LineVisibility, Style, presets};

/// Most bytes that every device of WebGPU binds as one buffer.
const BINDING_BYTES: usize = 128 << 20;

const FRAME_4K: [u32; 2] = [3840, 2160];

/// Longest side of an image there.
const IMAGE_SIDE: u32 = 8192;

/// An engine that only keeps what it is asked for.
#[derive(Default)]
struct Asked {
    resources: RefCell<Vec<Resource>>,
}

impl Engine for Asked {
    fn describe(&self) -> String {
        "asked".to_owned()
    }

    fn runs_twins(&self) -> bool {
        false
    }

    fn prepare(&self, graph: Graph) -> Result<Box<dyn Session>, EngineError> {
        *self.resources.borrow_mut() = graph.resources().to_vec();
        Err(EngineError::NoDevice {
            reason: "only asked".to_owned(),
        })
    }
}

/// What a frame in a style asks of a device: of a sheet so many cells wide, with smoke.
pub(crate) fn asked_for(style: &Style, size: [u32; 2], side: u32) -> Vec<Resource> {
    let sheet = Sheet::new(side).glb();
    let resources = MemoryResources::default();
    let scene = load_bytes("sheet", &sheet, None, &resources, &Limits::default()).unwrap();
    let options = RendererOptions {
        smoke: Some(Smoke {
            spheres: vec![Sphere::new([1.0; 3], 0.5)],
            space: Some(([-1.0; 3], [3.0; 3])),
        }),
        ..RendererOptions::new(size)
    };
    let engine = Asked::default();
    let model = Model::new(&scene).unwrap();
    let lines = LineModel::new(&scene, &LineModelOptions::default()).unwrap();
    let of_scene = (&model, LineRenderer::new(&engine, &lines));
    assert!(Renderer::with_lines(&engine, of_scene, style, &options).is_err());
    engine.resources.take()
}

fn pixels_of(resources: &[Resource]) -> usize {
    let frame = resources.iter().find(|resource| resource.name == "frame");
    frame.unwrap().word_count()
}

#[test]
fn every_device_binds_what_a_frame_of_4k_needs() {
    for preset in presets() {
        let style = Style::preset(preset.name).unwrap();
        for resource in asked_for(&style, FRAME_4K, 3) {
            let what = format!("{}: {}", preset.name, resource.name);
            match resource.kind {
                Kind::Image { size, .. } => assert!(size[0].max(size[1]) <= IMAGE_SIDE, "{what}"),
                _ => assert!(resource.word_count() * 4 <= BINDING_BYTES, "{what}"),
            }
        }
    }
}

#[test]
fn a_frame_of_4k_is_drawn_whole_where_lines_are_strokes() {
    let mut style = Style::preset("toon").unwrap();
    assert_eq!(pixels_of(&asked_for(&style, FRAME_4K, 3)), 3840 * 2160);
    style.line.visibility = LineVisibility::Sampled;
    let sampled = asked_for(&style, FRAME_4K, 3);
    assert!(sampled.iter().any(|of| of.name == "samples of lines"));
    style.set("line.method=shape").unwrap();
    assert!(pixels_of(&asked_for(&style, FRAME_4K, 3)) < 3840 * 2160);
}
