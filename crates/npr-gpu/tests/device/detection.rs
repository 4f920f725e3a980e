//! Lines are detected by one thread for each pixel of the mask.

use crate::shared;
use npr_core::geometry::{GPixel, Part};
use npr_core::outline::{MASK_KINDS, Outline};
use npr_core::window::{View, Window};
use npr_gpu::engine::Engine;
use npr_gpu::graph::Graph;
use npr_gpu::passes::line::DETECT;
use npr_gpu::processor::Processor;

/// A grid whose pixels fill no whole number of workgroups.
const SIZE: [u32; 2] = [37, 29];

/// The first `count` pixels of the mask of a chessboard of two objects, on which every pixel differs from its
/// neighbours.
fn mask_of_chessboard(engine: &dyn Engine, count: usize) -> Vec<u32> {
    let squares: Vec<GPixel> = (0..SIZE[0] * SIZE[1])
        .map(|i| GPixel {
            depth: 1.0,
            object: (i % SIZE[0] + i / SIZE[0]) % 2,
            material: 0,
            part: 0,
            ..GPixel::EMPTY
        })
        .collect();
    let part = Part {
        flags: Part::LINES,
        ..Part::default()
    };
    let outline = Outline {
        detects: Outline::OBJECT_ID,
        ..Outline::default()
    };
    let size_px = SIZE.map(|side| side as f32);
    let window = Window::over(size_px, [0.0; 2], size_px, SIZE);

    let mut graph = Graph::new();
    let ids = [
        graph.uniform::<View>("view"),
        graph.uniform::<Window>("window"),
        graph.uniform::<Outline>("outline"),
        graph.buffer::<Part>("parts", 1),
        graph.buffer::<GPixel>("gbuffer", squares.len()),
        graph.buffer::<u32>("mask", count),
    ];
    graph.compute(&DETECT, &ids);
    let mut session = engine.prepare(graph).unwrap();
    session
        .write(ids[0], bytemuck::cast_slice(&[View::default()]))
        .unwrap();
    session
        .write(ids[1], bytemuck::cast_slice(&[window]))
        .unwrap();
    session
        .write(ids[2], bytemuck::cast_slice(&[outline]))
        .unwrap();
    session
        .write(ids[3], bytemuck::cast_slice(&[part]))
        .unwrap();
    session
        .write(ids[4], bytemuck::cast_slice(&squares))
        .unwrap();
    session.run().unwrap();
    session.read(ids[5]).unwrap()
}

#[test]
fn each_pixel_of_the_mask_is_marked_by_a_thread_of_its_own() {
    let Some(device) = shared::device() else {
        return;
    };
    let all = (SIZE[0] * SIZE[1]) as usize;
    let whole = mask_of_chessboard(&Processor, all);
    assert!(
        whole
            .iter()
            .all(|mark| mark & MASK_KINDS == Outline::OBJECT_ID)
    );
    // A mask of fewer pixels has fewer threads: each of them marks its own pixel, also where they end within a row,
    // and within a workgroup, and none stands for its neighbours.
    for count in [1, 2, 36, 37, 38, 63, 64, 65, 640, all - 1, all] {
        let marks = mask_of_chessboard(device, count);
        assert_eq!(marks.len(), count);
        assert_eq!(marks, whole[..count], "{count} pixels");
    }
}
