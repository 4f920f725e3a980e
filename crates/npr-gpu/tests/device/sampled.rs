//! Lines over the test scene: what is seen of them by all passes in one graph.

use crate::contours::engines;
use crate::frame::Frame;
use crate::scene::{Look, PART_WIDTHS, sampled_lines, view};
use npr_core::geometry::{PosedVertex, Triangle};
use npr_core::window::Window;
use npr_gpu::curves::sampling::{SampledFrame, add_sampling};
use npr_gpu::engine::Engine;
use npr_gpu::graph::Graph;
use npr_gpu::pass::Format;
use npr_vector::ink_point::InkPoint;
use npr_vector::sampled::{
    PartWidths, SampledLine, Scenery, SpineSample, inked, see_samples, visible_samples,
};

const SIZE: [u32; 2] = [160, 120];

/// The scene that lines lie in, and the lines.
struct Sampled {
    window: Window,
    ids: Vec<u32>,
    posed: Vec<PosedVertex>,
    triangles: Vec<Triangle>,
    lines: Vec<SampledLine>,
    samples: Vec<SpineSample>,
}

impl Sampled {
    fn new() -> Self {
        let frame = Frame::new(Look::Ours, SIZE, SIZE);
        let (lines, samples) = sampled_lines();
        let words = |name: &str| frame.named(name).words.clone();
        Self {
            window: bytemuck::pod_read_unaligned(bytemuck::cast_slice(&words("sample_window"))),
            ids: words("ids"),
            posed: bytemuck::cast_slice(&words("posed")).to_vec(),
            triangles: bytemuck::cast_slice(&words("triangles")).to_vec(),
            lines,
            samples,
        }
    }

    /// The points of ink by the plain functions.
    fn plainly(&self) -> Vec<InkPoint> {
        let view = view(Look::Ours);
        let on = Scenery {
            view: &view,
            window: &self.window,
            ids: &self.ids,
            posed: &self.posed,
            triangles: &self.triangles,
        };
        let mut gaps = vec![0.0; self.samples.len()];
        see_samples(&on, &self.samples, &mut gaps);
        let visible = visible_samples(&PART_WIDTHS, &self.lines, &self.samples, &gaps);
        inked(
            (&view, &PART_WIDTHS),
            &self.lines,
            (&self.samples, &gaps),
            &visible,
        )
    }

    /// The same by all passes in one graph.
    fn on(&self, engine: &dyn Engine) -> Vec<InkPoint> {
        let mut graph = Graph::new();
        let on = SampledFrame {
            view: graph.uniform::<npr_core::window::View>("view"),
            window: graph.uniform::<Window>("window"),
            ids: graph.image("ids", Format::U32, self.window.size),
            posed: graph.buffer::<PosedVertex>("posed", self.posed.len()),
            triangles: graph.buffer::<Triangle>("triangles", self.triangles.len()),
            samples: graph.buffer::<SpineSample>("samples", self.samples.len()),
            lines: graph.buffer::<SampledLine>("lines", self.lines.len()),
            widths: graph.uniform::<PartWidths>("widths"),
        };
        let points = add_sampling(&mut graph, &on);
        let mut session = engine.prepare(graph).unwrap();
        for (id, words) in [
            (on.view, bytemuck::cast_slice(&[view(Look::Ours)])),
            (on.window, bytemuck::cast_slice(&[self.window])),
            (on.ids, &self.ids[..]),
            (on.posed, bytemuck::cast_slice(&self.posed)),
            (on.triangles, bytemuck::cast_slice(&self.triangles)),
            (on.samples, bytemuck::cast_slice(&self.samples)),
            (on.lines, bytemuck::cast_slice(&self.lines)),
            (
                on.widths,
                bytemuck::cast_slice(&[PartWidths::of(&PART_WIDTHS)]),
            ),
        ] {
            session.write(id, words).unwrap();
        }
        session.run().unwrap();
        bytemuck::cast_slice(&session.read(points).unwrap()).to_vec()
    }
}

#[test]
fn both_engines_ink_the_same_of_lines() {
    let sampled = Sampled::new();
    let plain = sampled.plainly();
    let drawn = plain.iter().filter(|point| point.goes_on()).count();
    let share = drawn as f64 / plain.len() as f64;
    assert!(
        (0.2..0.8).contains(&share),
        "{share} of all points are seen"
    );
    for engine in engines() {
        let found = sampled.on(engine);
        let differs = |(a, b): &(&InkPoint, &InkPoint)| {
            let is_near = |a: f32, b: f32| (a - b).abs() < 1e-3;
            !(a.flags == b.flags && is_near(a.half_width, b.half_width) && is_near(a.u, b.u))
        };
        let other = plain.iter().zip(&found).filter(differs).count();
        // A sample that is seen otherwise turns the width of all of its part.
        let allowed = if engine.runs_twins() {
            0
        } else {
            plain.len() / 50
        };
        assert!(
            other <= allowed,
            "{other} of {} points, {}",
            plain.len(),
            engine.describe()
        );
    }
}
