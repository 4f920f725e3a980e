//! The strokes of a frame, sampled a pixel apart.

use glam::DVec3;
use npr_vector::project::Lens;
use npr_vector::stroke::{Kind, Stroke, StrokePoint};

use super::near::{Near, distance};
use crate::lines::viewpoint::wide;

/// Distance of samples along a stroke, in pixels.
const STEP_PX: f64 = 1.0;

/// How near to the border of the picture an end is one that the border cut, in pixels.
const BORDER_PX: f64 = 2.0;

/// A place on a stroke.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// In the picture, in pixels.
    pub place: [f64; 2],
    /// Unit direction of the stroke.
    pub along: [f64; 2],
    /// In the world.
    pub world: DVec3,
    /// Distance from the eye along the view axis.
    pub depth: f64,
    /// Texture coordinate as drawn, in pixels.
    pub u: f64,
    /// Way from the start of the stroke, in pixels.
    pub station: f64,
    /// Number of the stroke in [`Traced::strokes`].
    pub stroke: usize,
}

/// What is kept of a stroke.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Line {
    /// Its identity.
    pub id: u64,
    /// What it is on the shape.
    pub kind: Kind,
    /// What it lies on.
    pub surface: u32,
    /// Whether its end runs on to its start.
    pub closed: bool,
    /// Length in pixels.
    pub length: f64,
    /// Its first sample, and the one after its last.
    pub samples: [usize; 2],
}

/// An end of an open stroke that the border of the picture did not cut.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct End {
    /// In the picture, in pixels.
    pub place: [f64; 2],
    /// In the world.
    pub world: DVec3,
    /// Number of the stroke.
    pub stroke: usize,
    /// Whether it is the stroke's start.
    pub is_start: bool,
}

/// The visible strokes of a frame.
#[derive(Debug, Clone, Default)]
pub struct Traced {
    /// Width and height of the frame in pixels.
    pub size: [u32; 2],
    /// The strokes.
    pub strokes: Vec<Line>,
    /// Their samples, stroke by stroke.
    pub samples: Vec<Sample>,
    /// Their ends.
    pub ends: Vec<End>,
    /// The samples by place.
    pub near: Near,
}

impl Traced {
    /// Samples the visible ones of `strokes`, drawn in a frame of `size` pixels. O(points + pixels of line).
    pub fn new(strokes: &[Stroke], size: [u32; 2], lens: Lens) -> Self {
        let mut traced = Self {
            size,
            ..Self::default()
        };
        for stroke in strokes.iter().filter(|stroke| stroke.is_visible()) {
            traced.add(stroke, lens);
        }
        let places = traced.samples.iter().map(|sample| sample.place).collect();
        traced.near = Near::new(places, size);
        traced
    }

    fn add(&mut self, stroke: &Stroke, lens: Lens) {
        // Walk along the stroke.
        let (number, first) = (self.strokes.len(), self.samples.len());
        let mut walk = Walk::default();
        let points = &stroke.points;
        let around = match stroke.closed {
            true => points.last().zip(points.first()),
            false => None,
        };
        let pieces = points.windows(2).map(|pair| (&pair[0], &pair[1]));
        for (from, to) in pieces.chain(around) {
            walk.piece(from, to, lens, |sample| {
                self.samples.push(Sample {
                    stroke: number,
                    ..sample
                });
            });
        }
        self.turn_along(first, stroke.closed);
        self.strokes.push(Line {
            id: stroke.id,
            kind: stroke.kind,
            surface: stroke.surface,
            closed: stroke.closed,
            length: walk.gone,
            samples: [first, self.samples.len()],
        });

        // Note the ends.
        let ends = [(points.first(), true), (points.last(), false)];
        let ends = ends.into_iter().filter(|_| !stroke.closed);
        let ends = ends.filter_map(|(point, is_start)| {
            let point = point?;
            Some(End {
                place: point.position,
                world: wide(point.world),
                stroke: number,
                is_start,
            })
        });
        let size = self.size;
        self.ends
            .extend(ends.filter(|end| is_inside(end.place, size)));
    }

    /// Gives the samples from `first` on the direction from the one before to the one after.
    fn turn_along(&mut self, first: usize, closed: bool) {
        let samples = &mut self.samples[first..];
        let count = samples.len();
        let places: Vec<[f64; 2]> = samples.iter().map(|sample| sample.place).collect();
        for (i, sample) in samples.iter_mut().enumerate() {
            let before = match i {
                0 if closed => count - 1,
                _ => i.saturating_sub(1),
            };
            let after = match i + 1 == count {
                true if closed => 0,
                true => i,
                false => i + 1,
            };
            let away = distance(places[before], places[after]);
            if away > 0.0 {
                sample.along = [0, 1].map(|k| (places[after][k] - places[before][k]) / away);
            }
        }
    }
}

/// Whether a place lies in the picture, away from its border.
pub fn is_inside(place: [f64; 2], size: [u32; 2]) -> bool {
    let is_between = |i: usize| (BORDER_PX..f64::from(size[i]) - BORDER_PX).contains(&place[i]);
    is_between(0) && is_between(1)
}

/// The way along a stroke.
#[derive(Debug, Default)]
struct Walk {
    /// How far it went, in pixels.
    gone: f64,
    /// How many samples it took.
    taken: usize,
}

impl Walk {
    /// Goes on from a point to the next, and hands over every sample on the way.
    fn piece(
        &mut self,
        from: &StrokePoint,
        to: &StrokePoint,
        lens: Lens,
        mut take: impl FnMut(Sample),
    ) {
        let length = distance(from.position, to.position);
        let [a, b] = [from, to].map(|point| wide(point.world));
        while self.taken as f64 * STEP_PX < self.gone + length {
            let station = self.taken as f64 * STEP_PX;
            let share = (station - self.gone) / length;
            let place =
                [0, 1].map(|i| from.position[i] + share * (to.position[i] - from.position[i]));
            let in_world = lens.world_share(share, [from.depth, to.depth]);
            take(Sample {
                place,
                along: [0.0; 2],
                world: a.lerp(b, in_world),
                depth: from.depth + in_world * (to.depth - from.depth),
                u: from.u + share * length,
                station,
                stroke: 0,
            });
            self.taken += 1;
        }
        self.gone += length;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::testing::{SIZE, line, ring};

    #[test]
    fn samples_lie_a_pixel_apart_on_their_stroke() {
        let traced = Traced::new(
            &[
                line([100.0, 50.0], [140.5, 50.0]),
                ring([300.0, 200.0], 40.0),
            ],
            SIZE,
            Lens::Parallel,
        );
        let [[from, to], [start, end]] = [0, 1].map(|i| traced.strokes[i].samples);
        assert_eq!(to - from, 41);
        for (i, sample) in traced.samples[from..to].iter().enumerate() {
            assert!(
                (sample.place[0] - 100.0 - i as f64).abs() < 1e-9 && sample.along == [1.0, 0.0]
            );
            assert!((sample.u - sample.station).abs() < 1e-9);
        }
        let around = std::f64::consts::TAU * 40.0;
        assert!(((end - start) as f64 - around).abs() < 2.0);
        for sample in &traced.samples[start..end] {
            let out = [sample.place[0] - 300.0, sample.place[1] - 200.0];
            let across = out[0] * sample.along[0] + out[1] * sample.along[1];
            assert!(across.abs() < 0.5, "{across}");
        }
        assert_eq!(traced.ends.len(), 2, "a ring has no ends");
    }

    #[test]
    fn the_border_of_the_picture_makes_no_ends() {
        let whole = line([0.5, 50.0], [80.0, 50.0]);
        let traced = Traced::new(&[whole], SIZE, Lens::Parallel);
        assert_eq!(traced.ends.len(), 1);
    }
}
