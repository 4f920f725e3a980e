//! What is written comes back, and passes see it.

use crate::sample_passes::{ADD_TEXELS, DOUBLE};
use crate::shared;
use npr_gpu::engine::Engine;
use npr_gpu::graph::Graph;
use npr_gpu::pass::Format;

#[test]
fn images_come_back_without_padding() {
    let Some(device) = shared::device() else {
        return;
    };
    for size in [[1, 1], [63, 5], [64, 5], [65, 5], [200, 3]] {
        for format in [Format::U32, Format::Rgba8] {
            let mut graph = Graph::new();
            let image = graph.image("picture", format, size);
            let mut session = device.prepare(graph).unwrap();
            let texels: Vec<u32> = (0..size[0] * size[1])
                .map(|i| i.wrapping_mul(0x0102_0305))
                .collect();
            session.write(image, &texels).unwrap();
            assert_eq!(session.read(image).unwrap(), texels, "{format:?} {size:?}");
        }
    }
}

#[test]
fn a_short_write_leaves_the_rest_as_it_was() {
    let Some(device) = shared::device() else {
        return;
    };
    let mut graph = Graph::new();
    let image = graph.image("picture", Format::U32, [3, 3]);
    let buffer = graph.buffer::<u32>("numbers", 4);
    let mut session = device.prepare(graph).unwrap();
    session.write(image, &[9; 9]).unwrap();
    session.write(image, &[1, 2, 3, 4]).unwrap();
    session.write(buffer, &[5, 6]).unwrap();
    assert_eq!(session.read(image).unwrap(), [1, 2, 3, 4, 9, 9, 9, 9, 9]);
    assert_eq!(session.read(buffer).unwrap(), [5, 6, 0, 0]);
}

/// Whole layers come first, then rows, then texels: written, short or not, and read without padding.
#[test]
fn layers_come_back_one_after_the_other() {
    let Some(device) = shared::device() else {
        return;
    };
    for (size, count) in [([5, 3], 4), ([64, 2], 2), ([65, 3], 1)] {
        let mut graph = Graph::new();
        let image = graph.layered_image("pictures", Format::U32, size, count);
        let mut session = device.prepare(graph).unwrap();
        let all: Vec<u32> = (1..=size[0] * size[1] * count).collect();
        session.write(image, &all).unwrap();
        assert_eq!(session.read(image).unwrap(), all);
        let layer = (size[0] * size[1]) as usize;
        for short in [1, layer - 1, layer, all.len() - 1] {
            let (mut expected, mut begun) = (all.clone(), vec![0; short]);
            expected[..short].fill(0);
            session.write(image, &begun).unwrap();
            assert_eq!(session.read(image).unwrap(), expected, "{size:?} {short}");
            begun.copy_from_slice(&all[..short]);
            session.write(image, &begun).unwrap();
        }
    }
}

#[test]
fn resources_without_elements_come_back_empty() {
    let Some(device) = shared::device() else {
        return;
    };
    let mut graph = Graph::new();
    let (buffer, image) = (
        graph.buffer::<u32>("none", 0),
        graph.image("none", Format::U32, [0, 7]),
    );
    let mut session = device.prepare(graph).unwrap();
    for id in [buffer, image] {
        session.write(id, &[]).unwrap();
        assert!(session.read(id).unwrap().is_empty());
    }
}

#[test]
fn passes_see_uniforms_and_texels() {
    let Some(device) = shared::device() else {
        return;
    };
    let mut graph = Graph::new();
    let step = graph.uniform::<[u32; 4]>("step");
    let numbers = graph.image("numbers", Format::U32, [5, 2]);
    let bytes = graph.image("bytes", Format::Rgba8, [5, 2]);
    let sums = graph.buffer::<u32>("sums", 10);
    graph.compute(&ADD_TEXELS, &[step, numbers, bytes, sums]);
    let mut session = device.prepare(graph).unwrap();
    session.write(step, &[1000, 0, 0, 0]).unwrap();
    session
        .write(numbers, &[0, 10, 20, 30, 40, 50, 60, 70, 80, 90])
        .unwrap();
    session.write(bytes, &[0xffff_ff07; 10]).unwrap();
    session.run().unwrap();
    assert_eq!(
        session.read(sums).unwrap(),
        [1007, 1017, 1027, 1037, 1047, 1057, 1067, 1077, 1087, 1097]
    );
}

#[test]
fn a_session_runs_again_with_other_input() {
    let Some(device) = shared::device() else {
        return;
    };
    let mut graph = Graph::new();
    let ids = [
        graph.buffer::<u32>("a", 2),
        graph.buffer::<u32>("b", 2),
        graph.buffer::<u32>("c", 2),
    ];
    graph.compute(&DOUBLE, &[ids[0], ids[1]]);
    graph.compute(&DOUBLE, &[ids[1], ids[2]]);
    let mut session = device.prepare(graph).unwrap();
    for start in [1, 7] {
        session.write(ids[0], &[start, start]).unwrap();
        let times = session.run().unwrap();
        assert!(!device.has_clock() || times.iter().map(|time| time.name).eq(["test.double"; 2]));
        assert_eq!(session.read(ids[2]).unwrap(), [4 * start, 4 * start + 3]);
    }
}
