//! Drawing: depth, clearing, layers, and nothing to draw.

use crate::sample_passes::{ADD_LAYERS, DRAW_LARGEST};
use crate::shared;
use npr_gpu::engine::{Engine, Session};
use npr_gpu::graph::{Graph, ResourceId};
use npr_gpu::pass::Format;
use npr_gpu::processor::Processor;

const SIZE: [u32; 2] = [7, 3];

/// A session that draws `count` numbers, then `more` on top without clearing.
struct Drawing {
    session: Box<dyn Session>,
    numbers: [ResourceId; 2],
    targets: [ResourceId; 2],
}

impl Drawing {
    fn new(engine: &dyn Engine, counts: [usize; 2]) -> Self {
        let mut graph = Graph::new();
        let numbers = counts.map(|count| graph.buffer::<u32>("numbers", count));
        let targets = [
            graph.image("picture", Format::U32, SIZE),
            graph.image("depth", Format::Depth, SIZE),
        ];
        graph.draw(&DRAW_LARGEST, &numbers[..1], &targets, true);
        graph.draw(&DRAW_LARGEST, &numbers[1..], &targets, false);
        Self {
            session: engine.prepare(graph).unwrap(),
            numbers,
            targets,
        }
    }

    /// The one value that fills the picture, and the one that fills the depths.
    fn run(&mut self, first: &[u32], second: &[u32]) -> (u32, f32) {
        self.session.write(self.numbers[0], first).unwrap();
        self.session.write(self.numbers[1], second).unwrap();
        self.session.run().unwrap();
        let [texels, depths] = self.targets.map(|id| self.session.read(id).unwrap());
        assert!(texels.len() == 21 && texels.iter().all(|texel| *texel == texels[0]));
        assert!(depths.len() == 21 && depths.iter().all(|depth| *depth == depths[0]));
        (texels[0], f32::from_bits(depths[0]))
    }
}

#[test]
fn the_greatest_depth_wins() {
    let Some(device) = shared::device() else {
        return;
    };
    let mut drawing = Drawing::new(device, [3, 1]);
    assert_eq!(drawing.run(&[5, 200, 7], &[100]), (200, 200.0 / 256.0));
    assert_eq!(drawing.run(&[5, 20, 7], &[100]), (100, 100.0 / 256.0));
}

/// A buffer that grows holds nothing, and passes draw as many elements as it has then; a run in flight is not touched.
#[test]
fn buffers_grow_between_runs() {
    let processor: &dyn Engine = &Processor;
    for engine in shared::device()
        .map(|device| device as _)
        .into_iter()
        .chain([processor])
    {
        let mut drawing = Drawing::new(engine, [1, 1]);
        assert_eq!(drawing.run(&[5], &[0]), (5, 5.0 / 256.0));
        let picture = drawing.targets[0];

        // The run in flight ends with what it started with.
        drawing.session.submit(&[picture]).unwrap();
        drawing.session.grow(drawing.numbers[0], 3).unwrap();
        drawing
            .session
            .write(drawing.numbers[0], &[0, 7, 9])
            .unwrap();
        drawing.session.submit(&[picture]).unwrap();
        for largest in [5, 9] {
            let texels = drawing.session.collect().unwrap().1.take(picture);
            assert!(texels.iter().all(|texel| *texel == largest), "{texels:?}");
        }

        // Less room than it has changes nothing; more room is empty, and read whole.
        drawing.session.grow(drawing.numbers[0], 2).unwrap();
        assert_eq!(drawing.session.read(drawing.numbers[0]).unwrap(), [0, 7, 9]);
        drawing.session.grow(drawing.numbers[0], 5).unwrap();
        assert_eq!(drawing.session.read(drawing.numbers[0]).unwrap(), [0; 5]);
        assert_eq!(drawing.run(&[1, 2, 3, 4, 200], &[0]), (200, 200.0 / 256.0));
    }
}

#[test]
fn nothing_to_draw_still_clears() {
    let Some(device) = shared::device() else {
        return;
    };
    assert_eq!(Drawing::new(device, [0, 0]).run(&[], &[]), (0, 0.0));
    let mut drawing = Drawing::new(device, [0, 1]);
    assert_eq!(drawing.run(&[], &[9]), (9, 9.0 / 256.0));
    assert_eq!(drawing.run(&[], &[3]), (3, 3.0 / 256.0));
}

#[test]
fn the_processor_draws_the_same() {
    let Some(device) = shared::device() else {
        return;
    };
    let (mut here, mut there) = (
        Drawing::new(&Processor, [2, 2]),
        Drawing::new(device, [2, 2]),
    );
    for numbers in [[[1, 2], [3, 4]], [[90, 2], [3, 40]], [[0, 0], [0, 0]]] {
        assert_eq!(
            here.run(&numbers[0], &numbers[1]),
            there.run(&numbers[0], &numbers[1])
        );
    }
}

/// Draws a number into each layer of a picture, out of order, with two layers of depths for all; adds all layers up.
fn layers_on(engine: &dyn Engine, numbers: [u32; 3], clears: bool) -> [Vec<u32>; 3] {
    let mut graph = Graph::new();
    let bound = numbers.map(|_| graph.buffer::<u32>("number", 1));
    let picture = graph.layered_image("picture", Format::U32, SIZE, 4);
    let depths = graph.layered_image("depths", Format::Depth, SIZE, 2);
    let sums = graph.buffer::<u32>("sums", 21);
    for (layer, number) in [(2, bound[2]), (0, bound[0]), (1, bound[1])] {
        let targets = [picture.layer(layer), depths.layer(layer % 2)];
        graph.draw(&DRAW_LARGEST, &[number], &targets, clears);
    }
    graph.compute(&ADD_LAYERS, &[picture, depths, sums]);
    let mut session = engine.prepare(graph).unwrap();

    // Fill the picture before, so that what is cleared and what is kept differ.
    session.write(picture, &[7; 4 * 21]).unwrap();
    for (id, number) in bound.iter().zip(numbers) {
        session.write(*id, &[number]).unwrap();
    }
    session.run().unwrap();
    [picture, depths, sums].map(|id| session.read(id).unwrap())
}

/// Every layer of `SIZE`, filled with one value.
fn filled(values: &[u32]) -> Vec<u32> {
    values.iter().flat_map(|value| [*value; 21]).collect()
}

#[test]
fn a_layer_is_cleared_and_drawn_alone() {
    let Some(device) = shared::device() else {
        return;
    };
    let depth = |number: u32| (number as f32 / 256.0).to_bits();
    for engine in [&Processor as &dyn Engine, device] {
        // Each draw clears its own layers: the first and third share their depths, but not what they drew.
        let [picture, depths, sums] = layers_on(engine, [3, 50, 90], true);
        assert_eq!(picture, filled(&[3, 50, 90, 7]));
        assert_eq!(depths, filled(&[depth(3), depth(50)]));
        assert_eq!(sums, [3 + 2 * 50 + 3 * 90 + 4 * 7 + 3 + 2 * 50; 21]);

        // Without, what was drawn before hides what lies deeper.
        let [picture, depths, _] = layers_on(engine, [3, 50, 90], false);
        assert_eq!(picture, filled(&[7, 50, 90, 7]));
        assert_eq!(depths, filled(&[depth(90), depth(50)]));
    }
}
