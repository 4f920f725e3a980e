//! Properties of graphs and of the engine that runs them on the processor.

use npr_core::geometry::Stamp;
use npr_core::window::Window;
use npr_gpu::engine::{Engine, Session};
use npr_gpu::graph::{Graph, ResourceId};
use npr_gpu::pass::Format;
use npr_gpu::passes::line::{FLAG_TILES, SMOOTH_STAMPS};
use npr_gpu::processor::Processor;
use npr_vector::screen::residual::{TILE, flag_tiles, smooth, tile_count};
use proptest::prelude::*;

/// The processor takes every graph and never loses it.
const NEVER_FAILS: &str = "the processor never fails";

/// A grid of `size` pixels over a frame of the same size.
fn grid(size: [u32; 2]) -> Window {
    let px = size.map(|side| side as f32);
    Window::over(px, [0.0; 2], px, size)
}

/// One stamp for each pixel of a grid, most of them none.
fn stamps(size: [u32; 2]) -> impl Strategy<Value = Vec<Stamp>> {
    let stamp = (0u32..8, 0f32..3.0).prop_map(|(pick, half_width)| Stamp {
        center: [half_width, half_width],
        half_width: if pick == 0 { half_width } else { 0.0 },
        part: pick,
    });
    prop::collection::vec(stamp, (size[0] * size[1]) as usize)
}

fn sized_stamps() -> impl Strategy<Value = ([u32; 2], Vec<Stamp>)> {
    (1u32..40, 1u32..40)
        .prop_flat_map(|(w, h)| stamps([w, h]).prop_map(move |stamps| ([w, h], stamps)))
}

/// A session of stamps smoothed and flagged, with the resources for grid, stamps and tiles.
fn smoothed_and_flagged(size: [u32; 2]) -> (Box<dyn Session>, [ResourceId; 3]) {
    let mut graph = Graph::new();
    let count = (size[0] * size[1]) as usize;
    let window = graph.uniform::<Window>("mask window");
    let stamps = graph.buffer::<Stamp>("stamps", count);
    let smoothed = graph.buffer::<Stamp>("smoothed stamps", count);
    let tiles = graph.buffer::<u32>("tiles", tile_count(size));
    graph.compute(&SMOOTH_STAMPS, &[window, stamps, smoothed]);
    graph.compute(&FLAG_TILES, &[window, smoothed, tiles]);
    let session = Processor.prepare(graph).expect(NEVER_FAILS);
    (session, [window, stamps, tiles])
}

fn run_stamps(size: [u32; 2], stamps: &[Stamp]) -> Vec<u32> {
    let (mut session, [window, buffer, tiles]) = smoothed_and_flagged(size);
    session
        .write(window, bytemuck::cast_slice(&[grid(size)]))
        .expect(NEVER_FAILS);
    session
        .write(buffer, bytemuck::cast_slice(stamps))
        .expect(NEVER_FAILS);
    session.run().expect(NEVER_FAILS);
    session.read(tiles).expect(NEVER_FAILS)
}

proptest! {
    #[test]
    fn a_graph_does_what_its_twins_do_in_order((size, stamps) in sized_stamps()) {
        let window = grid(size);
        let mut smoothed = vec![Stamp::default(); stamps.len()];
        let mut tiles = vec![0; tile_count(size)];
        smooth(&window, &stamps, &mut smoothed);
        flag_tiles(&window, &smoothed, &mut tiles);
        prop_assert_eq!(run_stamps(size, &stamps), tiles);
    }

    #[test]
    fn a_tile_is_flagged_when_one_of_its_pixels_holds_a_stamp((size, stamps) in sized_stamps()) {
        let across = size[0].div_ceil(TILE);
        let mut wanted = vec![0; tile_count(size)];
        for (i, stamp) in stamps.iter().enumerate() {
            let (x, y) = (i as u32 % size[0], i as u32 / size[0]);
            if stamp.half_width > 0.0 {
                wanted[(y / TILE * across + x / TILE) as usize] = 1;
            }
        }
        prop_assert_eq!(run_stamps(size, &stamps), wanted);
    }

    #[test]
    fn running_again_changes_nothing((size, stamps) in sized_stamps()) {
        let (mut session, [window, buffer, tiles]) = smoothed_and_flagged(size);
        session.write(window, bytemuck::cast_slice(&[grid(size)])).expect(NEVER_FAILS);
        session.write(buffer, bytemuck::cast_slice(&stamps)).expect(NEVER_FAILS);
        session.run().expect(NEVER_FAILS);
        let first = session.read(tiles).expect(NEVER_FAILS);
        session.run().expect(NEVER_FAILS);
        prop_assert_eq!(session.read(tiles).expect(NEVER_FAILS), first);
    }

    #[test]
    fn what_is_written_is_read_and_the_rest_stays_zero(
        words in prop::collection::vec(any::<u32>(), 0..50), more in 0usize..20,
    ) {
        let mut graph = Graph::new();
        let buffer = graph.buffer::<u32>("words", words.len() + more);
        let mut session = Processor.prepare(graph).expect(NEVER_FAILS);
        session.write(buffer, &words).expect(NEVER_FAILS);
        let read = session.read(buffer).expect(NEVER_FAILS);
        prop_assert_eq!(&read[..words.len()], &words[..]);
        prop_assert!(read[words.len()..].iter().all(|word| *word == 0));
    }

    #[test]
    fn planned_bytes_are_those_of_all_resources(elements in 0usize..1000, w in 0u32..50, h in 0u32..50) {
        let mut graph = Graph::new();
        graph.buffer::<Stamp>("stamps", elements);
        graph.uniform::<Window>("window");
        graph.image("picture", Format::Rgba8, [w, h]);
        let window = size_of::<Window>() as u64;
        prop_assert_eq!(graph.planned_bytes(), elements as u64 * 16 + window + u64::from(w * h) * 4);
    }

    #[test]
    fn every_pass_has_a_time((size, stamps) in sized_stamps()) {
        let (mut session, [window, buffer, _]) = smoothed_and_flagged(size);
        session.write(window, bytemuck::cast_slice(&[grid(size)])).expect(NEVER_FAILS);
        session.write(buffer, bytemuck::cast_slice(&stamps)).expect(NEVER_FAILS);
        let names: Vec<&str> = session.run().expect(NEVER_FAILS).iter().map(|pass| pass.name).collect();
        prop_assert_eq!(names, ["line.smooth_stamps", "line.flag_tiles"]);
    }
}

#[test]
#[should_panic(expected = "slot 'stamps' cannot bind")]
fn a_buffer_of_another_element_does_not_fit() {
    let mut graph = Graph::new();
    let window = graph.uniform::<Window>("mask window");
    let wrong = graph.buffer::<u32>("words", 4);
    let tiles = graph.buffer::<u32>("tiles", 1);
    graph.compute(&FLAG_TILES, &[window, wrong, tiles]);
}

#[test]
#[should_panic(expected = "both writes and uses")]
fn a_pass_cannot_read_what_it_writes() {
    let mut graph = Graph::new();
    let window = graph.uniform::<Window>("mask window");
    let stamps = graph.buffer::<Stamp>("stamps", 4);
    graph.compute(&SMOOTH_STAMPS, &[window, stamps, stamps]);
}
