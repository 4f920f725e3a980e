//! Lines are detected by one thread for each pixel of the mask.

use crate::shared;
use npr_core::geometry::{GPixel, Part, Stamp};
use npr_core::list::{self, Listed};
use npr_core::outline::{MASK_KINDS, MASK_OWNER, MASK_SIDE, Outline};
use npr_core::window::{View, Window};
use npr_gpu::engine::Engine;
use npr_gpu::graph::Graph;
use npr_gpu::pass::Format;
use npr_gpu::passes::line::{CLAIM_PIXELS, DETECT, FIND_RESIDUAL};
use npr_gpu::processor::Processor;

/// A grid whose pixels fill no whole number of workgroups.
const SIZE: [u32; 2] = [37, 29];

/// The first `count` pixels of the mask of a chessboard of two objects, on which every pixel differs from its
/// neighbours.
fn mask_of_chessboard(engine: &dyn Engine, count: usize) -> Vec<u32> {
    let squares: Vec<GPixel> = (0..SIZE[0] * SIZE[1])
        .map(|i| GPixel {
            depth: 1.0,
            part: (i % SIZE[0] + i / SIZE[0]) % 2,
            ..GPixel::EMPTY
        })
        .collect();
    let outline = Outline {
        detects: Outline::OBJECT_ID,
        ..Outline::default()
    };
    mask_of(engine, View::default(), outline, &squares, count)
}

/// The first `count` pixels of the mask of a grid of pixels of two parts, which are two objects of one material.
fn mask_of(
    engine: &dyn Engine,
    view: View,
    outline: Outline,
    pixels: &[GPixel],
    count: usize,
) -> Vec<u32> {
    let parts = [0, 1].map(|object| Part {
        object,
        flags: Part::LINES,
        ..Part::default()
    });
    let size_px = SIZE.map(|side| side as f32);
    let window = Window::over(size_px, [0.0; 2], size_px, SIZE);

    let mut graph = Graph::new();
    let ids = [
        graph.uniform::<View>("view"),
        graph.uniform::<Window>("window"),
        graph.uniform::<Outline>("outline"),
        graph.buffer::<Part>("parts", parts.len()),
        graph.buffer::<GPixel>("gbuffer", pixels.len()),
        graph.buffer::<u32>("mask", count),
        graph.buffer::<u32>("owners", count + 1),
    ];
    graph.compute(&DETECT, &ids);
    let mut session = engine.prepare(graph).unwrap();
    session
        .write(ids[0], bytemuck::cast_slice(&[view]))
        .unwrap();
    session
        .write(ids[1], bytemuck::cast_slice(&[window]))
        .unwrap();
    session
        .write(ids[2], bytemuck::cast_slice(&[outline]))
        .unwrap();
    session.write(ids[3], bytemuck::cast_slice(&parts)).unwrap();
    session.write(ids[4], bytemuck::cast_slice(pixels)).unwrap();
    session.run().unwrap();
    let mask = session.read(ids[5]).unwrap();
    let owners = Listed::of(&session.read(ids[6]).unwrap());
    assert_eq!(owners.all(), owners_of(&mask));
    mask
}

/// The pixels of a mask that own a line.
fn owners_of(mask: &[u32]) -> Vec<u32> {
    let owning = (0..)
        .zip(mask)
        .filter(|(_, marks)| *marks & MASK_OWNER != 0);
    owning.map(|(element, _)| element).collect()
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

#[test]
fn bends_and_valleys_own_the_same_lines() {
    let Some(device) = shared::device() else {
        return;
    };
    let all = (SIZE[0] * SIZE[1]) as usize;
    // Rows of ridges and valleys, whose planes cross between every third pixel and the next.
    let pixels: Vec<GPixel> = (0..SIZE[0] * SIZE[1])
        .map(|i| {
            let [x, y] = [i % SIZE[0], i / SIZE[0]];
            let side = if x / 3 % 2 == 0 { 1.0 } else { -1.0 };
            let slope = side * (20.0 + y as f32);
            GPixel {
                plane_step: [slope, 0.0],
                depth: 1000.0 + slope * ((x % 3) as f32 - 0.8),
                part: 0,
                ..GPixel::EMPTY
            }
        })
        .collect();
    let outline = Outline {
        depth_threshold: 1.0,
        detects: Outline::DEPTH | Outline::PLANE_DEPTH,
        normal_cos: -2.0,
        ..Outline::default()
    };
    let view = View {
        view_height: 1.0,
        ..View::default()
    };
    let marks = mask_of(&Processor, view, outline, &pixels, all);
    for is_owner in [false, true] {
        let is_so = |mark: &&u32| **mark != 0 && (**mark & MASK_OWNER != 0) == is_owner;
        assert!(marks.iter().filter(is_so).count() > 100);
    }
    assert_eq!(mask_of(device, view, outline, &pixels, all), marks);
}

/// The stamps that an engine finds for a mask over one surface where nothing is inked.
fn stamps_of(engine: &dyn Engine, mask: &[u32]) -> Vec<Stamp> {
    let part = Part {
        flags: Part::LINES,
        ..Part::default()
    };
    let surface = GPixel {
        depth: 1.0,
        half_width: 1.0,
        part: 0,
        ..GPixel::EMPTY
    };
    let size_px = SIZE.map(|side| side as f32);
    let window = Window::over(size_px, [0.0; 2], size_px, SIZE);

    let mut graph = Graph::new();
    let ids = [
        graph.uniform::<Window>("window"),
        graph.uniform::<Window>("mask_window"),
        graph.buffer::<Part>("parts", 1),
        graph.buffer::<GPixel>("gbuffer", mask.len()),
        graph.buffer::<u32>("mask", mask.len()),
        graph.buffer::<u32>("owners", mask.len() + 1),
        graph.image("ribbons", Format::Rgba8, SIZE),
        graph.buffer::<Stamp>("stamps", mask.len()),
        graph.buffer::<u32>("found", mask.len() + 1),
    ];
    graph.compute(&FIND_RESIDUAL, &ids);
    let mut session = engine.prepare(graph).unwrap();
    let (windows, parts, pixels) = ([window], [part], vec![surface; mask.len()]);
    let mut owners = vec![0; mask.len() + 1];
    list::fill(&mut owners, &[owners_of(mask)]);
    let written: [&[u32]; 6] = [
        bytemuck::cast_slice(&windows),
        bytemuck::cast_slice(&windows),
        bytemuck::cast_slice(&parts),
        bytemuck::cast_slice(&pixels),
        mask,
        &owners,
    ];
    for (id, words) in ids.into_iter().zip(written) {
        session.write(id, words).unwrap();
    }
    session.run().unwrap();
    let stamps: Vec<Stamp> = bytemuck::pod_collect_to_vec(&session.read(ids[7]).unwrap());
    let found = Listed::of(&session.read(ids[8]).unwrap());
    let with = (0..)
        .zip(&stamps)
        .filter(|(_, stamp)| stamp.half_width > 0.0);
    assert_eq!(found.all(), with.map(|(i, _)| i).collect::<Vec<u32>>());
    stamps
}

#[test]
fn dots_beside_an_outline_get_no_stamps() {
    let Some(device) = shared::device() else {
        return;
    };
    // An outline, three dots beside it, and a line within the surface.
    let owned = |kinds: u32| kinds | MASK_OWNER | MASK_SIDE;
    let mut mask = vec![0; (SIZE[0] * SIZE[1]) as usize];
    for x in 5..30 {
        mask[10 * SIZE[0] as usize + x] = owned(Outline::OBJECT_ID | Outline::DEPTH);
        mask[20 * SIZE[0] as usize + x] = owned(Outline::DEPTH);
    }
    for x in [10, 11, 20] {
        mask[11 * SIZE[0] as usize + x] = owned(Outline::DEPTH);
    }
    let stamps = stamps_of(&Processor, &mask);
    let count = stamps.iter().filter(|stamp| stamp.half_width > 0.0);
    // The line fades out over two pixels at either end.
    assert_eq!(count.count(), 25 + 21);
    assert_eq!(stamps_of(device, &mask), stamps);
}

/// The claims of an engine for one list of stamps after another, over a grid of overlapping stamps of equal widths.
fn claims_of(engine: &dyn Engine, moments: &[&[u32]]) -> Vec<(Vec<u32>, Vec<u32>)> {
    let size_px = SIZE.map(|side| side as f32);
    let count = (SIZE[0] * SIZE[1]) as usize;
    let stamps: Vec<Stamp> = (0..SIZE[0] * SIZE[1])
        .map(|i| Stamp {
            center: [i % SIZE[0], i / SIZE[0]].map(|at| at as f32 + 0.5),
            half_width: 2.5,
            part: 0,
        })
        .collect();

    let mut graph = Graph::new();
    let window = Window::over(size_px, [0.0; 2], size_px, SIZE);
    let ids = [
        graph.constant("window", window),
        graph.buffer::<u32>("found", count + 1),
        graph.constants("smoothed", &stamps),
        graph.buffer::<u32>("claims", count),
        graph.buffer::<u32>("covered", count + 1),
    ];
    graph.compute(&CLAIM_PIXELS, &ids);
    let mut session = engine.prepare(graph).unwrap();
    let moments = moments.iter().map(|stamps| {
        let mut found = vec![0; count + 1];
        list::fill(&mut found, &[stamps.to_vec()]);
        session.write(ids[1], &found).unwrap();
        session.run().unwrap();
        let covered = Listed::of(&session.read(ids[4]).unwrap());
        (session.read(ids[3]).unwrap(), covered.all().to_vec())
    });
    moments.collect()
}

#[test]
fn the_first_of_equal_stamps_claims_a_pixel_whatever_was_there_before() {
    let Some(device) = shared::device() else {
        return;
    };
    let forth: Vec<u32> = (0..300).step_by(2).collect();
    let back: Vec<u32> = forth.iter().rev().copied().collect();
    let moments: [&[u32]; 4] = [&[1000], &forth, &back, &[5]];
    let found = claims_of(device, &moments);
    assert_eq!(found, claims_of(&Processor, &moments));
    // The order of the list does not matter, and nothing of a moment is left in the next.
    assert_eq!(found[1], found[2]);
    let around_5 = found[3].0.iter().filter(|claim| **claim != 0);
    assert!(around_5.clone().all(|claim| *claim == 6));
    assert_eq!(around_5.count(), found[3].1.len());
}
