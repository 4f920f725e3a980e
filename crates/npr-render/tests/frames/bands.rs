//! Frames in bands are the whole frames, and plan for no more than a band.

use npr_core::camera::Camera;
use npr_gpu::processor::Processor;
use npr_render::{Model, RenderError, Renderer, RendererOptions};
use npr_scene::testing::Sheet;
use npr_scene::{Limits, MemoryResources, load_bytes};
use npr_stylesheet::Style;
use proptest::prelude::*;

fn model() -> Model {
    let resources = MemoryResources::default();
    let scene = load_bytes(
        "sheet",
        &Sheet::new(3).glb(),
        None,
        &resources,
        &Limits::default(),
    );
    Model::new(&scene.expect("a sound file")).expect("a model")
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 12, ..ProptestConfig::default() })]
    #[test]
    fn bands_put_together_are_the_frame(width in 150u32..400, height in 150u32..400, tile_pixels in 10_000u32..30_000) {
        let options = RendererOptions { tile_pixels, in_bands: true, ..RendererOptions::new([width, height]) };
        let model = model();
        let mut renderer = Renderer::new(&Processor, &model, &Style::default(), &options).expect("a stage");
        prop_assume!(renderer.draws_bands());
        let camera = Camera::framing([0.0; 3], [3.0, 0.1, 3.0]);
        let mut rgba = Vec::new();
        let reported = renderer.draw_bands(&camera, &mut |band| {
            assert_eq!(band.rgba.len() as u32, band.size[0] * band.size[1] * 4);
            assert_eq!(band.size[0], width);
            rgba.extend_from_slice(&band.rgba);
            true
        });
        let whole = renderer.draw(&camera).expect("drawn");
        prop_assert!(rgba == whole.rgba);
        prop_assert_eq!(reported.expect("drawn").notices, whole.notices);
    }
}

#[test]
fn a_band_needs_a_band_of_memory() {
    let model = model();
    let size = [4000, 4000];
    let plan = |in_bands, memory_limit| {
        let options = RendererOptions {
            tile_pixels: 100_000,
            in_bands,
            memory_limit,
            ..RendererOptions::new(size)
        };
        Renderer::new(&Processor, &model, &Style::default(), &options).map(|_| ())
    };
    // The picture alone has 64 MB; tiles and a band of it have less.
    let limit = 60 << 20;
    assert_eq!(plan(true, limit), Ok(()));
    assert!(matches!(plan(false, limit), Err(RenderError::Memory(_))));
}

#[test]
fn whoever_has_seen_enough_ends_it() {
    let model = model();
    let options = RendererOptions {
        tile_pixels: 20_000,
        ..RendererOptions::new([300, 300])
    };
    let mut renderer =
        Renderer::new(&Processor, &model, &Style::default(), &options).expect("a stage");
    let mut count = 0;
    let reported = renderer.draw_bands(&Camera::framing([0.0; 3], [3.0, 0.1, 3.0]), &mut |_| {
        count += 1;
        false
    });
    assert!(reported.is_ok());
    assert_eq!(count, 1);
}
