//! What the passes of a frame ask of a device.

use npr_core::camera::DEFAULT_FOV_DEG;
use npr_gpu::processor::Processor;
use npr_render::{Model, Renderer, RendererOptions};
use npr_scene::testing::Sheet;
use npr_scene::{Limits, MemoryResources, load_bytes};
use npr_stylesheet::Style;

#[test]
fn every_pass_that_is_timed_is_counted_and_the_copy_too() {
    let resources = MemoryResources::default();
    let scene = load_bytes(
        "sheet",
        &Sheet::new(3).glb(),
        None,
        &resources,
        &Limits::default(),
    );
    let model = Model::new(&scene.unwrap()).unwrap();
    let size = [64, 48];
    let options = RendererOptions::new(size);
    let mut renderer = Renderer::new(&Processor, &model, &Style::default(), &options).unwrap();
    let camera = model.framing(4.0 / 3.0, DEFAULT_FOV_DEG.to_radians());
    let frame = renderer.draw(&camera).unwrap();
    let costs = renderer.pass_costs().unwrap();

    // The copy of the picture comes last.
    let (copy, passes) = costs.split_last().unwrap();
    let names = frame.times.iter().map(|time| time.name);
    assert!(passes.iter().map(|pass| pass.name).eq(names));
    let bytes = u64::from(size[0] * size[1] * 4);
    assert_eq!((copy.name, copy.cost.read_bytes), ("copy", bytes));

    // The last pass works on the pixels that were listed, which are fewer than there are.
    let composed = passes.last().unwrap();
    assert_eq!(composed.name, "shade.compose_frame");
    let written = composed.cost.written_bytes;
    assert!((4..bytes).contains(&written), "{written}");
}
