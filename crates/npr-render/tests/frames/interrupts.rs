//! Frames that somebody ends before they are done.

use crate::sequences::{LOOKS, camera, engines, options, scene, style};
use npr_core::interrupt::Interrupt;
use npr_render::{LineModel, LineModelOptions, LineRenderer, Model, Renderer, RendererOptions};
use proptest::prelude::*;
use std::thread;
use std::time::Duration;

/// Draws a frame, ends the next one, and checks that the one after is as if it were the first.
fn check_ended(look: &[&str], tile_pixels: u32, end: impl Fn(&Interrupt) + Sync) {
    // Make two renderers of a look, only one of which heeds a flag.
    let (scene, style) = (scene(), style(look));
    let model = Model::new(&scene).unwrap();
    let lines = LineModel::new(&scene, &LineModelOptions::default()).unwrap();
    let interrupt = Interrupt::new();
    let heeding = RendererOptions {
        interrupt: interrupt.clone(),
        ..options(tile_pixels)
    };
    for engine in engines() {
        let renderer = |options: &RendererOptions| {
            let lines = LineRenderer::new(engine, &lines);
            Renderer::with_lines(engine, (&model, lines), &style, options).unwrap()
        };
        let [mut ended, mut other] = [&heeding, &options(tile_pixels)].map(renderer);
        let place = format!("{look:?}, {}", engine.describe());

        // A flag that is lowered changes nothing.
        let first = ended.draw(&camera(0.0)).unwrap();
        assert!(
            first.rgba == other.draw(&camera(0.0)).unwrap().rgba,
            "{place}"
        );

        // A frame is ended, or was faster than the hand.
        let drawn = thread::scope(|scope| {
            scope.spawn(|| end(&interrupt));
            ended.draw(&camera(7.0))
        });
        interrupt.lower();
        let is_ended = match drawn {
            Ok(frame) => {
                assert!(
                    frame.rgba == other.draw(&camera(7.0)).unwrap().rgba,
                    "{place}"
                );
                false
            }
            Err(error) => {
                assert!(error.is_interrupted(), "{error}, {place}");
                true
            }
        };

        // The next one goes on from what was whole.
        let next = ended.draw(&camera(9.0)).unwrap();
        let mut other = match is_ended {
            true => renderer(&options(tile_pixels)),
            false => other,
        };
        assert!(
            next.rgba == other.draw(&camera(9.0)).unwrap().rgba,
            "{place}"
        );
    }
}

#[test]
fn a_flag_that_is_up_ends_a_frame_of_every_look() {
    let (scene, interrupt) = (scene(), Interrupt::new());
    let model = Model::new(&scene).unwrap();
    let lines = LineModel::new(&scene, &LineModelOptions::default()).unwrap();
    interrupt.raise();
    for (look, engine) in LOOKS
        .iter()
        .flat_map(|look| engines().into_iter().map(move |e| (look, e)))
    {
        let (style, options) = (style(look), options(1 << 20));
        let options = RendererOptions {
            interrupt: interrupt.clone(),
            ..options
        };
        let lines = LineRenderer::new(engine, &lines);
        let mut renderer = Renderer::with_lines(engine, (&model, lines), &style, &options).unwrap();
        let drawn = renderer.draw(&camera(0.0));
        assert!(drawn.is_err_and(|error| error.is_interrupted()), "{look:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 12, ..ProptestConfig::default() })]

    /// Whenever the flag is raised, the frame is whole or none, and the next one does not see it.
    #[test]
    fn a_frame_is_whole_or_none(look in 0..LOOKS.len(), in_tiles in any::<bool>(), wait_us in 0u64..20_000) {
        let tile_pixels = if in_tiles { 4096 } else { 1 << 20 };
        check_ended(LOOKS[look], tile_pixels, |interrupt| {
            thread::sleep(Duration::from_micros(wait_us));
            interrupt.raise();
        });
    }
}
