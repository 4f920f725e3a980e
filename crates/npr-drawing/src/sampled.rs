//! Strokes of which it is not known yet what is seen, as samples for the passes that find out.

use crate::ink::{BrushLay, Images, Laid, half_width, widest};
use crate::taper::met_ends;
use npr_core::surface::apply_point;
use npr_core::window::View;
use npr_vector::mesh_lines::run::distance;
use npr_vector::sampled::{SampledLine, SpineSample};
use npr_vector::stroke::{Drawing, Stroke, StrokePoint};
use rayon::prelude::*;

/// Least number of samples that fill a list up: those of a line without width.
const FILLING: usize = 2;

/// Most samples of a line beyond one for every step of its length.
const BEYOND_STEPS: usize = 3;

/// Strokes as lists of samples.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SampledStrokes {
    /// The lines, in the order of their strokes; the last one fills the list of samples up.
    pub lines: Vec<SampledLine>,
    /// The samples, line after line.
    pub samples: Vec<SpineSample>,
}

/// Most strokes that are sampled where there is room for a number of samples.
pub fn most_strokes(room: usize) -> usize {
    room.saturating_sub(FILLING) / (2 * BEYOND_STEPS)
}

/// How strokes are seen, and what brushes draw along them.
pub struct Sampling<'a> {
    /// Camera and frame.
    pub view: &'a View,
    /// How the image of its brush lies on a stroke.
    pub lay_of: &'a (dyn Fn(&Stroke) -> BrushLay + Sync),
    /// The number of the [`PartWidth`](npr_vector::sampled::PartWidth) of a stroke, below 2^24.
    pub width_of: &'a (dyn Fn(&Stroke) -> u32 + Sync),
}

/// Samples of the strokes of a drawing at equal steps of at most a pixel, or of so much more that they find room.
///
/// The list has `room` samples, an even number; those behind the last line belong to one without width. `None` for more
/// than [`most_strokes`]. The spine is where the line is in the world, whatever smoothing and a hand did to the stroke.
/// O(points + room), in parallel, with the same result for any number of threads.
pub fn sample_strokes(
    drawing: &Drawing,
    sampling: &Sampling<'_>,
    room: usize,
) -> Option<SampledStrokes> {
    // Choose the step so that all lines find room.
    let strokes = &drawing.strokes;
    if strokes.len() > most_strokes(room) {
        return None;
    }
    let lengths: Vec<f64> = strokes.par_iter().map(Stroke::length).collect();
    let total: f64 = lengths.iter().filter(|length| length.is_finite()).sum();
    let free = room - FILLING - BEYOND_STEPS * strokes.len();
    let step = (total / free as f64).max(1.0);

    // Count the samples of every line.
    let is_met = met_ends(strokes, &lengths, drawing.size);
    let mut first = 0;
    let lines = strokes.iter().zip(&lengths).zip(is_met);
    let lines = lines.map(|((stroke, length), is_met)| {
        let line = line_of(
            stroke,
            (*length, step),
            is_met,
            ((sampling.lay_of)(stroke), (sampling.width_of)(stroke)),
            first,
        );
        first += line.count;
        line
    });
    let mut lines: Vec<SampledLine> = lines.collect();

    // Place them, and fill the list up.
    let numbered = (0..).zip(strokes).zip(&lines);
    let numbered: Vec<((u32, &Stroke), &SampledLine)> = numbered.collect();
    let placed = numbered.par_iter().map(|((number, stroke), line)| {
        let surface = drawing.surfaces.get(stroke.surface as usize);
        let own = surface.map_or([0, 0, 0, 255], |surface| surface.line_color);
        sampling.along(stroke, line, *number, own)
    });
    let placed: Vec<Vec<SpineSample>> = placed.collect();
    let mut samples = placed.concat();
    samples.resize(
        room,
        SpineSample {
            line: lines.len() as u32,
            ..SpineSample::default()
        },
    );
    lines.push(SampledLine {
        first,
        count: room as u32 - first,
        step_px: 1.0,
        ..SampledLine::default()
    });
    Some(SampledStrokes { lines, samples })
}

/// The line of a stroke, with samples at most a step apart, its ends among them.
fn line_of(
    stroke: &Stroke,
    (length, step): (f64, f64),
    is_met: [bool; 2],
    (lay, width): (BrushLay, u32),
    first: u32,
) -> SampledLine {
    // A stroke without a finite length has two samples in one place.
    let length = if length.is_finite() { length } else { 0.0 };
    let steps = (length / step).ceil() as u32;
    let count = (steps + 1).next_multiple_of(2).max(2);

    // Lay its brush on it.
    let widest = widest(stroke);
    let laid = Laid::new(stroke, lay, widest);
    let bit = |bit: u32, when: bool| if when { bit } else { 0 };
    let is_once = lay.brush > 0 && lay.images == Images::Once;
    SampledLine {
        first,
        count,
        step_px: (length / f64::from(count - 1)) as f32,
        ink_flags: laid.flags,
        u_start: laid.start_on(stroke) as f32,
        u_per_px: laid.per_px as f32,
        full_half_width: widest as f32,
        bits: bit(SampledLine::START_FREE, !stroke.closed && !is_met[0])
            | bit(SampledLine::END_FREE, !stroke.closed && !is_met[1])
            | bit(SampledLine::CLOSED, stroke.closed)
            | bit(SampledLine::ONCE, is_once)
            | width << SampledLine::WIDTH_SHIFT,
    }
}

impl Sampling<'_> {
    /// The samples of a line along its stroke, from its first place to its last; those of a ring end where they begin.
    fn along(
        &self,
        stroke: &Stroke,
        line: &SampledLine,
        number: u32,
        own: [u8; 4],
    ) -> Vec<SpineSample> {
        let back = stroke.points.first().filter(|_| stroke.closed);
        let mut path = stroke.points.iter().chain(back);
        let mut samples = Vec::with_capacity(line.count as usize);
        let Some(mut from) = path.next() else {
            return vec![
                SpineSample {
                    line: number,
                    ..SpineSample::default()
                };
                line.count as usize
            ];
        };
        let mut to = path.next().unwrap_or(from);
        let mut ends = [from, to].map(|point| self.end(point));
        let (mut passed, mut piece) = (0.0, distance(from.position, to.position));
        for index in 0..line.count {
            // Go on to the piece that holds the place.
            let at = f64::from(index) * f64::from(line.step_px);
            while at > passed + piece {
                let Some(next) = path.next() else {
                    break;
                };
                passed += piece;
                (from, to) = (to, next);
                ends = [ends[1], self.end(to)];
                piece = distance(from.position, to.position);
            }
            let share = if piece > 0.0 {
                ((at - passed) / piece).clamp(0.0, 1.0)
            } else {
                0.0
            };

            // Blend its ends.
            let between = |a: f64, b: f64| a + (b - a) * share;
            let [a, b] = &ends;
            let near = if share < 0.5 { from } else { to };
            samples.push(SpineSample {
                spine_px: [0, 1].map(|i| between(a.0[i], b.0[i]) as f32),
                depth: self.view.depth_of_coordinate(between(a.1, b.1) as f32),
                line: number,
                px: [0, 1].map(|i| between(from.position[i], to.position[i]) as f32),
                half_width: between(half_width(from), half_width(to)) as f32,
                color: u32::from_le_bytes(near.color.unwrap_or(own)),
            });
        }
        samples
    }

    /// Where the spine of a point is seen, in pixels, and its plane coordinate.
    fn end(&self, point: &StrokePoint) -> ([f64; 2], f64) {
        let view = self.view;
        let [x, y, _, w] = apply_point(&view.clip_from_world, point.world);
        let [width, height] = view.frame_px;
        let ahead = |i: usize| (point.world[i] - view.eye_world[i]) * view.forward_world[i];
        let depth = ahead(0) + ahead(1) + ahead(2);
        let px = [0.5 * width * (1.0 + x / w), 0.5 * height * (1.0 - y / w)];
        (px.map(f64::from), f64::from(view.plane_coordinate(depth)))
    }
}

#[cfg(test)]
mod tests;
