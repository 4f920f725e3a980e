//! What was drawn between two ends of lines.

use super::remembered::{Known, REACH_PX, STEP_PX};
use crate::mesh_lines::run::distance;
use crate::mesh_lines::{DrawnBetween, Tip};

/// Least cosine between a line and the way that an end points.
const LEAST_COS: f64 = 0.7;

/// How much longer than straight the line between two ends may be, in pixels.
const LONGER_PX: f64 = 8.0;

/// Samples from the end of a line up to which a place is near it: 6 pixels.
const END_SAMPLES: u32 = 3;

/// What lines of the frame before did between two ends: whether one led from the one to the other, or ended near one.
pub(super) fn drawn_between(known: &Known, tips: &[Tip; 2]) -> DrawnBetween {
    // Look for samples beside both that are of one line.
    let [first, second] = tips.each_ref().map(|tip| beside(known, tip));
    let gap = distance(tips[0].place, tips[1].place);
    for (a, line) in &first {
        for (b, other) in &second {
            let way = f64::from(a.abs_diff(*b)) * STEP_PX;
            let around = f64::from(known.line(*line).around_px);
            let way = if around > 0.0 {
                way.min(around - way)
            } else {
                way
            };
            if line == other && way <= gap + LONGER_PX {
                return DrawnBetween::Line;
            }
        }
    }

    // Look for ends.
    let is_end = |(sample, line): &(u32, u32)| {
        let line = known.line(*line);
        let [from, to] = line.samples;
        line.around_px == 0.0 && (sample - from < END_SAMPLES || to - sample <= END_SAMPLES)
    };
    match first.iter().chain(&second).any(is_end) {
        true => DrawnBetween::End,
        false => DrawnBetween::Nothing,
    }
}

/// The samples of the frame before beside an end, of lines that are like its own: their numbers, and their lines.
fn beside(known: &Known, tip: &Tip) -> Vec<(u32, u32)> {
    let fits = known.around(tip.place).filter(|(_, seen)| {
        let line = known.line(seen.line);
        let cos = seen.along[0] * tip.out[0] + seen.along[1] * tip.out[1];
        (line.kind, line.is_hidden, line.age) == (tip.kind, tip.is_hidden, 0)
            && cos.abs() >= LEAST_COS
            && distance(seen.position, tip.place) <= REACH_PX
    });
    fits.map(|(number, seen)| (number, seen.line)).collect()
}
