//! Properties of graphs and of the engine that runs them on the processor.

use npr_core::geometry::Stamp;
use npr_core::interrupt::{Interrupt, Interrupted};
use npr_core::window::Window;
use npr_gpu::engine::{Engine, EngineError, Session};
use npr_gpu::graph::{Graph, ResourceId};
use npr_gpu::pass::{Agreement, Format, Pass, Work, read, texture};
use npr_gpu::passes::line::CLAIM_PIXELS;
use npr_gpu::passes::vector::{SCAN_ADD, SCAN_BLOCKS};
use npr_gpu::processor::Processor;
use npr_shaders::Shader;
use npr_vector::rank::scan::BLOCK;
use proptest::prelude::*;
use std::sync::Arc;

/// The processor takes every graph and never loses it.
const NEVER_FAILS: &str = "the processor never fails";

/// Values in up to three blocks of sums.
fn values() -> impl Strategy<Value = Vec<u32>> {
    prop::collection::vec(any::<u32>(), 1..3 * BLOCK)
}

/// A session of sums over values and their blocks, with the resources for values and sums.
fn summed(count: usize) -> (Box<dyn Session>, [ResourceId; 2]) {
    let mut graph = Graph::new();
    let block_count = count.div_ceil(BLOCK);
    let values = graph.buffer::<u32>("values", count);
    let prefixes = graph.buffer::<u32>("prefixes", count);
    let sums = graph.buffer::<u32>("sums", block_count);
    let offsets = graph.buffer::<u32>("offsets", block_count);
    let total = graph.buffer::<u32>("total", 1);
    let whole = graph.buffer::<u32>("whole", count);
    graph.compute(&SCAN_BLOCKS, &[values, prefixes, sums]);
    graph.compute(&SCAN_BLOCKS, &[sums, offsets, total]);
    graph.compute(&SCAN_ADD, &[prefixes, offsets, whole]);
    let session = Processor.prepare(graph).expect(NEVER_FAILS);
    (session, [values, whole])
}

proptest! {
    #[test]
    fn a_graph_does_what_its_twins_do_in_order(values in values()) {
        let (mut session, [buffer, whole]) = summed(values.len());
        session.write(buffer, &values).expect(NEVER_FAILS);
        session.run().expect(NEVER_FAILS);
        let mut sum = 0u32;
        let before = values.iter().map(|value| {
            let before = sum;
            sum = sum.wrapping_add(*value);
            before
        });
        prop_assert_eq!(session.read(whole).expect(NEVER_FAILS), before.collect::<Vec<_>>());
    }

    #[test]
    fn a_run_that_is_interrupted_is_none_and_the_next_is_whole(values in values()) {
        let (mut session, [buffer, whole]) = summed(values.len());
        let interrupt = Interrupt::new();
        session.heed(&interrupt);
        session.write(buffer, &values).expect(NEVER_FAILS);
        let wanted = session.run_reading(&[whole]).expect(NEVER_FAILS).1;
        interrupt.raise();
        prop_assert_eq!(session.run(), Err(EngineError::Interrupted(Interrupted)));
        prop_assert_eq!(session.in_flight(), 0);
        interrupt.lower();
        prop_assert_eq!(session.run_reading(&[whole]).expect(NEVER_FAILS).1, wanted);
    }

    #[test]
    fn words_that_others_keep_are_read_where_they_are_and_never_written(values in values()) {
        let (mut session, [buffer, whole]) = summed(values.len());
        session.write(buffer, &values).expect(NEVER_FAILS);
        session.run().expect(NEVER_FAILS);
        let wanted = session.read(whole).expect(NEVER_FAILS);

        // Sums of shared values are the same; where sums go, others keep words, which stay.
        let (mut session, [buffer, whole]) = summed(values.len());
        let shared = Arc::new(values.clone());
        session.write_shared(buffer, &shared).expect(NEVER_FAILS);
        session.write_shared(whole, &shared).expect(NEVER_FAILS);
        prop_assert_eq!(Arc::strong_count(&shared), 3);
        session.run().expect(NEVER_FAILS);
        prop_assert_eq!(session.read(whole).expect(NEVER_FAILS), wanted);
        session.write(buffer, &[7]).expect(NEVER_FAILS);
        prop_assert_eq!(&*shared, &values);
        prop_assert_eq!(Arc::strong_count(&shared), 1);

        // Fewer words than there is room for leave the rest.
        let first = Arc::new(vec![9; values.len() - values.len() / 2]);
        session.write_shared(buffer, &first).expect(NEVER_FAILS);
        let read = session.read(buffer).expect(NEVER_FAILS);
        prop_assert_eq!(&read[..first.len()], &first[..]);
        prop_assert_eq!(&read[first.len()..], &values[first.len()..]);
    }

    #[test]
    fn running_again_changes_nothing(values in values()) {
        let (mut session, [buffer, whole]) = summed(values.len());
        session.write(buffer, &values).expect(NEVER_FAILS);
        session.run().expect(NEVER_FAILS);
        let first = session.read(whole).expect(NEVER_FAILS);
        session.run().expect(NEVER_FAILS);
        prop_assert_eq!(session.read(whole).expect(NEVER_FAILS), first);
    }

    /// Stamps of one moment claim no pixel of the next.
    #[test]
    fn what_is_written_in_part_begins_at_zero(
        moments in prop::collection::vec(prop::collection::btree_set(0u32..60, 0..9), 2..4),
    ) {
        let size = [10, 6];
        let px = size.map(|side| side as f32);
        let mut graph = Graph::new();
        let window = graph.constant("window", Window::over(px, [0.0; 2], px, size));
        let found = graph.buffer::<u32>("found", 61);
        let smoothed = graph.buffer::<Stamp>("smoothed", 60);
        let claims = graph.buffer::<u32>("claims", 60);
        let covered = graph.buffer::<u32>("covered", 61);
        graph.compute(&CLAIM_PIXELS, &[window, found, smoothed, claims, covered]);
        let mut session = Processor.prepare(graph).expect(NEVER_FAILS);
        let stamps: Vec<Stamp> = (0..60)
            .map(|i| Stamp { center: [(i % 10) as f32 + 0.5, (i / 10) as f32 + 0.5], half_width: 0.4, part: 0 })
            .collect();
        session.write(smoothed, bytemuck::cast_slice(&stamps)).expect(NEVER_FAILS);
        for moment in &moments {
            let list: Vec<u32> = [moment.len() as u32].into_iter().chain(moment.iter().copied()).collect();
            session.write(found, &list).expect(NEVER_FAILS);
            session.run().expect(NEVER_FAILS);
            let wanted: Vec<u32> = (0..60).map(|i| if moment.contains(&i) { i + 1 } else { 0 }).collect();
            prop_assert_eq!(session.read(claims).expect(NEVER_FAILS), wanted);
            prop_assert_eq!(&session.read(covered).expect(NEVER_FAILS)[..list.len()], &list[..]);
        }
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
    fn planned_bytes_are_those_of_all_resources(
        elements in 0usize..1000, w in 0u32..50, h in 0u32..50, layers in 1u32..5,
    ) {
        let mut graph = Graph::new();
        graph.buffer::<Stamp>("stamps", elements);
        graph.uniform::<Window>("window");
        graph.image("picture", Format::Rgba8, [w, h]);
        graph.layered_image("pictures", Format::U32, [h, w], layers);
        let window = size_of::<Window>() as u64;
        let texels = u64::from(w * h * (1 + layers));
        prop_assert_eq!(graph.planned_bytes(), elements as u64 * 16 + window + texels * 4);
    }

    #[test]
    fn every_pass_has_a_time(values in values()) {
        let (mut session, [buffer, _]) = summed(values.len());
        session.write(buffer, &values).expect(NEVER_FAILS);
        let names: Vec<&str> = session.run().expect(NEVER_FAILS).iter().map(|pass| pass.name).collect();
        prop_assert_eq!(names, ["vector.scan_blocks", "vector.scan_blocks", "vector.scan_add"]);
    }
}

#[test]
#[should_panic(expected = "slot 'sums' cannot bind")]
fn a_buffer_of_another_element_does_not_fit() {
    let mut graph = Graph::new();
    let values = graph.buffer::<u32>("values", 4);
    let prefixes = graph.buffer::<u32>("prefixes", 4);
    let wrong = graph.buffer::<Stamp>("stamps", 1);
    graph.compute(&SCAN_BLOCKS, &[values, prefixes, wrong]);
}

#[test]
#[should_panic(expected = "both writes and uses")]
fn a_pass_cannot_read_what_it_writes() {
    let mut graph = Graph::new();
    let values = graph.buffer::<u32>("values", 4);
    let sums = graph.buffer::<u32>("sums", 1);
    graph.compute(&SCAN_BLOCKS, &[values, values, sums]);
}

/// Draws nothing, and needs an image of one layer for it.
const DRAW_NOTHING: Pass = Pass {
    name: "test.draw_nothing",
    shader: Shader {
        path: "test",
        text: "",
    },
    slots: &[read::<u32>("numbers"), texture("picture", Format::U32)],
    work: Work::Draw {
        of: "numbers",
        vertices: 3,
        targets: &[Format::U32],
        fills: false,
    },
    agreement: Agreement::Exact,
    twin: |_| {},
};

/// A graph that draws nothing into a layer of three, beside a picture of some layers.
fn draw_nothing(layers: u32, layer: u32) -> Graph {
    let mut graph = Graph::new();
    let numbers = graph.buffer::<u32>("numbers", 1);
    let picture = graph.layered_image("seen", Format::U32, [4, 4], layers);
    let drawn = graph.layered_image("drawn", Format::U32, [4, 4], 3);
    let targets = [drawn.layer(layer)];
    graph.draw(&DRAW_NOTHING, &[numbers, picture], &targets, true);
    graph
}

#[test]
fn any_layer_is_drawn_into() {
    for layer in 0..3 {
        assert_eq!(draw_nothing(1, layer).nodes()[0].layers, [layer]);
    }
}

#[test]
#[should_panic(expected = "slot 'picture' cannot bind 'seen'")]
fn several_layers_do_not_fit_where_one_is_read() {
    draw_nothing(2, 0);
}

#[test]
#[should_panic(expected = "cannot draw into layer 3 of 'drawn'")]
fn a_layer_that_is_not_there_is_not_drawn_into() {
    draw_nothing(1, 3);
}

#[test]
fn graphs_that_draw_into_other_layers_differ() {
    assert!(draw_nothing(1, 1).is_same_as(&draw_nothing(1, 1)));
    assert!(!draw_nothing(1, 1).is_same_as(&draw_nothing(1, 2)));
}
