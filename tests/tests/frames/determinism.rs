//! Same scene, same style, same camera: same bytes.

use npr_gpu::processor::Processor;
use npr_render::{Frame, Model, Renderer, RendererOptions};
use npr_stylesheet::Style;
use npr_tests::{Agreement, asset, models_camera};

const SIZE: [u32; 2] = [480, 270];

fn draw(options: &RendererOptions, style: &Style) -> Frame {
    let model = Model::new(&asset("still_life.glb")).unwrap();
    let camera = models_camera(&model, options.size);
    let mut renderer = Renderer::new(&Processor, &model, style, options).unwrap();
    renderer.draw(&camera).unwrap()
}

fn styles() -> impl Iterator<Item = Style> {
    let presets = ["toon", "ink", "technical", "okuya", "filter-hull"];
    presets.into_iter().map(|name| Style::preset(name).unwrap())
}

#[test]
fn frames_are_equal_for_any_number_of_threads() {
    for style in styles() {
        let with_threads = |count: usize| {
            let pool = rayon::ThreadPoolBuilder::new()
                .num_threads(count)
                .build()
                .unwrap();
            pool.install(|| draw(&RendererOptions::new(SIZE), &style))
                .rgba
        };
        let one = with_threads(1);
        for count in [2, 8] {
            assert!(
                with_threads(count) == one,
                "{} on {count} threads",
                style.title
            );
        }
    }
}

#[test]
fn a_renderer_draws_the_same_frame_again() {
    let model = Model::new(&asset("teapot_box_plane.glb")).unwrap();
    let camera = models_camera(&model, SIZE);
    let aside = model.framing(1.0, 1.2);
    let style = Style::preset("ink").unwrap();
    let mut renderer =
        Renderer::new(&Processor, &model, &style, &RendererOptions::new(SIZE)).unwrap();
    let first = renderer.draw(&camera).unwrap().rgba;
    for _ in 0..20 {
        // What another view leaves in memory must not show.
        renderer.draw(&aside).unwrap();
        assert!(renderer.draw(&camera).unwrap().rgba == first);
    }
}

#[test]
fn a_frame_in_tiles_equals_the_frame_drawn_whole() {
    // Corners round in the tile's own coordinates, so that a corner between two steps may fall on either.
    for style in styles() {
        let whole = draw(&RendererOptions::new(SIZE), &style);
        for tile_pixels in [0, 20_000, 60_000] {
            let options = RendererOptions {
                tile_pixels,
                ..RendererOptions::new(SIZE)
            };
            let tiled = draw(&options, &style);
            let agreement = Agreement::between(&whole, &tiled, 0);
            assert!(
                agreement.within > 0.9999,
                "{} in tiles of {tile_pixels}: {agreement}",
                style.title
            );
        }
    }
}
