//! What is kept of a frame's strokes, and where it shows in the next one.

use crate::mesh_lines::anchor::Anchor;
use crate::mesh_lines::near::{Cells, cells_within};
use crate::mesh_lines::run::distance;
use crate::project::Projector;
use crate::stroke::{Kind, Stroke};
use crate::surface_location::SurfaceLocation;
use glam::DVec3;
use npr_mesh::half_edge::HalfEdgeMesh;
use rayon::prelude::*;
use std::ops::Range;

/// Distance of samples along a stroke, in pixels.
pub(super) const STEP_PX: f64 = 2.0;

/// Distance up to which a sample may be one of the frame before, in pixels.
pub(super) const REACH_PX: f64 = 3.0;

/// Side of the cells that samples are sorted into: what is within reach lies in four of them.
const CELL_PX: f64 = 2.0 * REACH_PX;

/// A place on a remembered stroke.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Sample {
    anchor: Anchor,
    /// Texture coordinate, in pixels.
    u: f32,
}

const _: () = assert!(size_of::<Sample>() <= 32, "a sample takes 32 bytes at most");

/// A remembered stroke, or a part of one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Line {
    pub id: u64,
    /// Identity of the line that it was, or was a part of.
    pub whole_id: u64,
    pub kind: Kind,
    /// Whether something was in front of it.
    pub is_hidden: bool,
    /// Length of a closed stroke in pixels; 0 of an open one.
    pub around_px: f32,
    /// Frames for which nothing took it over.
    pub age: u8,
    /// Where it came among the strokes of its frame.
    pub rank: u32,
    /// Its first sample, and the one after its last.
    pub samples: [u32; 2],
}

impl Line {
    pub fn range(&self) -> Range<usize> {
        self.samples[0] as usize..self.samples[1] as usize
    }
}

/// A place on a stroke of this frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Place {
    pub position: [f64; 2],
    /// Unit direction of the stroke.
    pub along: [f64; 2],
    /// Way from the first point, in pixels.
    pub way: f64,
    u: f64,
    world: DVec3,
    location: SurfaceLocation,
}

impl Place {
    /// What is kept of it.
    pub fn remembered(&self, shape: &HalfEdgeMesh, projector: &Projector) -> Sample {
        let place = (self.position, self.world);
        Sample {
            anchor: Anchor::new(place, self.location, shape, projector),
            u: self.u as f32,
        }
    }
}

/// Places along a stroke, [`STEP_PX`] apart from its first point on.
pub(super) fn sampled(stroke: &Stroke) -> Vec<Place> {
    let points = &stroke.points;
    let around = points.last().zip(points.first()).filter(|_| stroke.closed);
    let pieces = points.windows(2).map(|pair| (&pair[0], &pair[1]));
    let (mut places, mut gone) = (Vec::new(), 0.0);
    let is_reversed = matches!(points[..], [.., a, b] if b.u < a.u);
    for (from, to) in pieces.chain(around) {
        let length = distance(from.position, to.position);
        if !length.is_finite() {
            break;
        }
        let along = [0, 1].map(|i| (to.position[i] - from.position[i]) / length);
        // Around a ring the texture runs on as it did before.
        let [start, end] = [from, to].map(|point| DVec3::from(point.world.map(f64::from)));
        while (places.len() as f64) * STEP_PX < gone + length {
            let way = places.len() as f64 * STEP_PX;
            let share = (way - gone) / length;
            let is_back = std::ptr::eq(to, &points[0]);
            let u_share = match (is_back, is_reversed) {
                (true, false) => length,
                (true, true) => -length,
                (false, _) => to.u - from.u,
            };
            places.push(Place {
                position: [0, 1].map(|i| from.position[i] + along[i] * (way - gone)),
                along,
                way,
                u: from.u + share * u_share,
                world: start.lerp(end, share),
                location: from.location,
            });
        }
        gone += length;
    }
    places
}

/// What is known of the frame before, in the view of this one.
#[derive(Debug, Default)]
pub(super) struct Known {
    pub lines: Vec<Line>,
    /// The places of all samples, in their order.
    samples: Vec<Seen>,
    /// Their numbers, by place.
    near: Option<Cells<u32>>,
}

/// A remembered sample in this frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Seen {
    /// In the picture, in pixels; not finite where it lies behind the eye.
    pub position: [f64; 2],
    /// Unit direction of the stroke here; 0 where nothing is beside it.
    pub along: [f64; 2],
    pub u: f64,
    /// Whether the texture runs as the line does.
    pub is_along: bool,
    pub line: u32,
}

/// Whether the texture of a line runs as the line does at one of its samples.
///
/// Of the steps from and to its neighbours the one counts that is nearer to its own length: the other may lead over a
/// seam.
fn runs_along(samples: &[Sample], index: usize) -> bool {
    let step = |from: usize| f64::from(samples[from + 1].u) - f64::from(samples[from].u);
    let before = index.checked_sub(1).map(step);
    let after = (index + 1 < samples.len()).then(|| step(index));
    let off = |step: &f64| (step.abs() - STEP_PX).abs();
    let best = before
        .into_iter()
        .chain(after)
        .min_by(|a, b| off(a).total_cmp(&off(b)));
    best.is_none_or(|step| step >= 0.0)
}

impl Known {
    /// Finds the samples of lines in a view of the shape, as it is posed now. O(samples).
    pub fn new(
        lines: &[Line],
        samples: &[Sample],
        shape: &HalfEdgeMesh,
        projector: &Projector,
    ) -> Self {
        // Find their places.
        let places: Vec<[f64; 2]> = samples
            .par_iter()
            .map(|sample| {
                sample
                    .anchor
                    .place(shape, projector)
                    .unwrap_or([f64::NAN; 2])
            })
            .collect();

        // Give them directions, from the one before to the one after.
        let mut seen = Vec::with_capacity(samples.len());
        for (line, number) in lines.iter().zip(0..) {
            let range = line.range();
            for index in range.clone() {
                let before = index.max(range.start + 1) - 1;
                let after = (index + 1).min(range.end - 1);
                let step = [0, 1].map(|i| places[after][i] - places[before][i]);
                let length = (step[0] * step[0] + step[1] * step[1]).sqrt();
                let has_way = length.is_finite() && length > 0.0;
                seen.push(Seen {
                    position: places[index],
                    along: if has_way {
                        step.map(|v| v / length)
                    } else {
                        [0.0; 2]
                    },
                    u: f64::from(samples[index].u),
                    is_along: runs_along(&samples[range.clone()], index - range.start),
                    line: number,
                });
            }
        }

        // Sort them by place.
        let mut near = Cells::with_room(CELL_PX, seen.len());
        for (sample, number) in seen.iter().zip(0_u32..) {
            if sample.position.iter().all(|v| v.is_finite()) {
                near.add(sample.position, number);
            }
        }
        Self {
            lines: lines.to_vec(),
            samples: seen,
            near: Some(near),
        }
    }

    /// All samples within reach of a place and some more, with their numbers, in an order that hangs on nothing but
    /// them.
    pub fn around(&self, place: [f64; 2]) -> impl Iterator<Item = (u32, &Seen)> {
        let cells = self.near.iter();
        let near = cells.flat_map(move |near| near.of(cells_within(place, REACH_PX, CELL_PX)));
        near.map(|number| (*number, &self.samples[*number as usize]))
    }

    /// The line of a number.
    pub fn line(&self, number: u32) -> &Line {
        &self.lines[number as usize]
    }

    /// Where the first point of a line shows in this frame.
    pub fn start_of(&self, line: u32) -> [f64; 2] {
        self.samples[self.line(line).samples[0] as usize].position
    }
}
