//! Lines over a made-up frame: samples of all lengths of lines, and what both engines see of them.

use crate::contours::engines;
use npr_core::camera::{Camera, Projection};
use npr_core::geometry::GPixel;
use npr_core::math::mix_bits;
use npr_core::window::{View, Window};
use npr_gpu::curves::sampling::{SampledFrame, add_sampling};
use npr_gpu::engine::Engine;
use npr_gpu::graph::Graph;
use npr_vector::mesh_lines::sample::{
    SampledLines, SpineSample, Surroundings, sample_visibility, visible_samples,
};

const SIDE: u32 = 64;

/// Samples and the frame that they lie in.
pub struct Sampled {
    pub frame: (View, Window, Vec<GPixel>),
    pub lines: SampledLines,
    pub radius: u32,
}

impl Sampled {
    /// A number of samples on lines of 0 to 199 samples that wander over a frame of tilted squares.
    pub fn new(count: usize) -> Self {
        let camera = Camera {
            eye: [0.0, 0.0, 4.0],
            target: [0.0; 3],
            up: [0.0, 1.0, 0.0],
            projection: Projection::Perspective { fov_y: 0.7 },
        };
        let view = camera.view([2 * SIDE; 2], ([-9.0; 3], [9.0; 3]));
        let window = Window::over(view.frame_px, [0.0; 2], view.frame_px, [SIDE; 2]);
        let gbuffer = (0..SIDE * SIDE).map(pixel).collect();
        Self {
            frame: (view, window, gbuffer),
            lines: lines(count as u32),
            radius: 3,
        }
    }

    fn surroundings(&self) -> Surroundings<'_> {
        let (view, window, gbuffer) = &self.frame;
        Surroundings {
            view,
            window,
            gbuffer,
        }
    }

    /// What an engine sees of the samples, all passes in one graph.
    fn seen_on(&self, engine: &dyn Engine) -> Vec<u32> {
        let mut graph = Graph::new();
        let on = SampledFrame {
            view: graph.uniform::<View>("view"),
            window: graph.uniform::<Window>("window"),
            gbuffer: graph.buffer::<GPixel>("G-buffer", self.frame.2.len()),
            samples: graph.buffer::<SpineSample>("samples", self.lines.samples.len()),
            line_starts: graph.buffer::<u32>("line starts", self.lines.line_starts.len()),
            radius: graph.uniform::<u32>("radius"),
        };
        let visible = add_sampling(&mut graph, &on);
        let mut session = engine.prepare(graph).unwrap();
        let (view, window, gbuffer) = &self.frame;
        let SampledLines {
            samples,
            line_starts,
        } = &self.lines;
        for (id, words) in [
            (on.view, bytemuck::cast_slice(&[*view])),
            (on.window, bytemuck::cast_slice(&[*window])),
            (on.gbuffer, bytemuck::cast_slice(gbuffer)),
            (on.samples, bytemuck::cast_slice(samples)),
            (on.line_starts, line_starts),
            (on.radius, &[self.radius]),
        ] {
            session.write(id, words).unwrap();
        }
        session.run().unwrap();
        session.read(visible).unwrap()
    }
}

/// A number 0..1 that looks random.
fn unit(seed: u32) -> f32 {
    (mix_bits(seed) >> 8) as f32 / (1 << 24) as f32
}

/// Squares of eight pixels, every fifth of them empty.
fn pixel(index: u32) -> GPixel {
    let (x, y) = (index % SIDE, index / SIDE);
    let square = y / 8 * (SIDE / 8) + x / 8;
    if mix_bits(square).is_multiple_of(5) {
        return GPixel::EMPTY;
    }
    let slope = |seed| (unit(square ^ seed) - 0.5) * 0.01;
    GPixel {
        depth: 3.0 + 2.0 * unit(!square),
        plane_step: [slope(77), slope(1234)],
        part: square % 5,
        ..GPixel::EMPTY
    }
}

fn lines(count: u32) -> SampledLines {
    let (mut samples, mut line_starts) = (Vec::new(), vec![0]);
    while samples.len() < count as usize {
        let line = line_starts.len() as u32 - 1;
        let length = (mix_bits(line) % 200).min(count - samples.len() as u32);
        samples.extend((0..length).map(|place| sample(line, place as f32)));
        line_starts.push(samples.len() as u32);
    }
    SampledLines {
        samples,
        line_starts,
    }
}

/// Lines are straight and start anywhere, some outside the frame.
fn sample(line: u32, place: f32) -> SpineSample {
    let of = |key: u32| unit(mix_bits(line).wrapping_add(key));
    let angle = 6.0 * of(1);
    let along = [1.0 - angle.rem_euclid(2.0), 0.5 - of(2)];
    let length = (along[0] * along[0] + along[1] * along[1]).sqrt();
    let [x, y] = along.map(|v| v / length.max(0.01));
    let side = (mix_bits(line) % 3) as f32 - 1.0;
    SpineSample {
        place_px: [
            160.0 * of(3) - 16.0 + place * x,
            160.0 * of(4) - 16.0 + place * y,
        ],
        outward: [-y * side, x * side],
        depth: 3.0 + 2.0 * of(5) + 0.002 * place,
        part: mix_bits(line) % 5,
        line,
        unused: 0,
    }
}

#[test]
fn both_engines_see_the_same_of_lines() {
    for count in [0, 1, 63, 64, 65, 5000, 100_000] {
        let sampled = Sampled::new(count);
        let SampledLines {
            samples,
            line_starts,
        } = &sampled.lines;
        let mut shares = vec![0.0; count];
        sample_visibility(&sampled.surroundings(), samples, &mut shares);
        let plain = visible_samples(sampled.radius, samples, line_starts, &shares);
        for engine in engines() {
            let seen = sampled.seen_on(engine);
            let other = plain.iter().zip(&seen).filter(|(a, b)| a != b).count();
            // A share that is read otherwise may turn its neighbours too.
            let allowed = if engine.runs_twins() { 0 } else { count / 500 };
            assert!(
                other <= allowed,
                "{other} of {count} samples, {}",
                engine.describe()
            );
        }
        let visible = plain.iter().filter(|seen| **seen != 0).count();
        assert!(
            count < 100 || (count / 5..count * 4 / 5).contains(&visible),
            "{visible} of {count}"
        );
    }
}
