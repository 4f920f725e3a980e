//! Sizes at which something changes: nothing at all, a full row of workgroups, the limits of bindings.

use crate::sample_passes::DOUBLE;
use crate::shared;
use npr_gpu::engine::{Engine, EngineError};
use npr_gpu::graph::Graph;
use npr_gpu::pass::Format;

/// Elements of a full row of workgroups.
const ROW: usize = 65535 * 64;

fn doubles(count: usize) -> (Vec<u32>, Vec<u32>) {
    let numbers: Vec<u32> = (0..count as u32)
        .map(|i| i.wrapping_mul(2_654_435_761))
        .collect();
    let doubled = numbers
        .iter()
        .zip(0u32..)
        .map(|(n, i)| n.wrapping_mul(2).wrapping_add(i))
        .collect();
    (numbers, doubled)
}

fn check_doubling(count: usize) {
    let Some(device) = shared::device() else {
        return;
    };
    let mut graph = Graph::new();
    let (from, to) = (
        graph.buffer::<u32>("numbers", count),
        graph.buffer::<u32>("doubled", count),
    );
    graph.compute(&DOUBLE, &[from, to]);
    let mut session = device.prepare(graph).unwrap();
    let (numbers, doubled) = doubles(count);
    session.write(from, &numbers).unwrap();
    session.run().unwrap();
    assert!(
        session.read(to).unwrap() == doubled,
        "wrong at {count} elements"
    );
}

#[test]
fn around_a_workgroup() {
    for count in [0, 1, 63, 64, 65, 128] {
        check_doubling(count);
    }
}

#[test]
fn around_a_full_row_of_workgroups() {
    for count in [ROW - 1, ROW, ROW + 1] {
        check_doubling(count);
    }
}

#[test]
fn an_empty_graph_runs() {
    let Some(device) = shared::device() else {
        return;
    };
    let mut session = device.prepare(Graph::new()).unwrap();
    assert!(
        session
            .run()
            .unwrap()
            .iter()
            .all(|time| time.name == "device")
    );
}

#[test]
fn the_largest_binding_fits_and_one_element_more_does_not() {
    let Some(device) = shared::device() else {
        return;
    };
    let largest = (128 << 20) / 16;
    let graph_of = |count| {
        let mut graph = Graph::new();
        graph.buffer::<[f32; 4]>("points", count);
        graph
    };
    assert!(device.prepare(graph_of(largest)).is_ok());
    let refused = device.prepare(graph_of(largest + 1)).err();
    let bytes = (128 << 20) + 16;
    assert_eq!(
        refused,
        Some(EngineError::OutOfMemory {
            resource: "points",
            bytes
        })
    );
}

#[test]
fn the_largest_image_fits_and_one_column_more_does_not() {
    let Some(device) = shared::device() else {
        return;
    };
    let graph_of = |width| {
        let mut graph = Graph::new();
        graph.image("picture", Format::U32, [width, 2]);
        graph
    };
    assert!(device.prepare(graph_of(8192)).is_ok());
    let refused = device.prepare(graph_of(8193)).err();
    assert!(matches!(refused, Some(EngineError::Failed { place, .. }) if place == "picture"));
}
