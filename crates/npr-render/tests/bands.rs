//! Frames in bands are the whole frames, and plan for no more than a band.

use npr_core::camera::Camera;
use npr_gpu::processor::Processor;
use npr_render::{Model, RenderError, Stage, StageOptions};
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
        let options = StageOptions { tile_pixels, in_bands: true, ..StageOptions::new([width, height]) };
        let model = model();
        let mut stage = Stage::new(&Processor, &model, &Style::default(), &options).expect("a stage");
        prop_assume!(stage.draws_bands());
        let camera = Camera::framing([0.0; 3], [3.0, 0.1, 3.0]);
        let mut rgba = Vec::new();
        let told = stage.draw_bands(&camera, &mut |band| {
            assert_eq!(band.rgba.len() as u32, band.size[0] * band.size[1] * 4);
            assert_eq!(band.size[0], width);
            rgba.extend_from_slice(&band.rgba);
            true
        });
        let whole = stage.draw(&camera).expect("drawn");
        prop_assert!(rgba == whole.rgba);
        prop_assert_eq!(told.expect("drawn").notices, whole.notices);
    }
}

#[test]
fn a_band_needs_a_band_of_memory() {
    let model = model();
    let size = [4000, 4000];
    let plan = |in_bands, memory_limit| {
        let options = StageOptions {
            tile_pixels: 100_000,
            in_bands,
            memory_limit,
            ..StageOptions::new(size)
        };
        Stage::new(&Processor, &model, &Style::default(), &options).map(|_| ())
    };
    // The picture alone has 64 MB; tiles and a band of it have less.
    let limit = 60 << 20;
    assert_eq!(plan(true, limit), Ok(()));
    assert!(matches!(plan(false, limit), Err(RenderError::Memory(_))));
}

#[test]
fn whoever_has_seen_enough_ends_it() {
    let model = model();
    let options = StageOptions {
        tile_pixels: 20_000,
        ..StageOptions::new([300, 300])
    };
    let mut stage = Stage::new(&Processor, &model, &Style::default(), &options).expect("a stage");
    let mut count = 0;
    let told = stage.draw_bands(&Camera::framing([0.0; 3], [3.0, 0.1, 3.0]), &mut |_| {
        count += 1;
        false
    });
    assert!(told.is_ok());
    assert_eq!(count, 1);
}
