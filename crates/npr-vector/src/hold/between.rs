//! What was drawn between two ends of lines.

use super::remembered::{Known, REACH_PX, STEP_PX, Seen};
use crate::mesh_lines::run::distance;
use crate::mesh_lines::{DrawnBetween, Tip};

/// Least cosine between a line and the way that an end points.
const LEAST_COS: f64 = 0.7;

/// How much longer than straight the line between two ends may be, in pixels.
const LONGER_PX: f64 = 8.0;

/// How far back that line may lead, in pixels: ends run past each other.
const BACK_PX: f64 = 4.0;

/// How far beyond the gap a line may end that ended there, in pixels: ends move.
const BEYOND_PX: f64 = 4.0;

/// A sample of the frame before that lies under an end.
struct Under {
    sample: u32,
    line: u32,
    /// Whether the line runs out of the end.
    is_out: bool,
}

/// What lines of the frame before did between two ends: whether one led from the one to the other, or ended on the way.
///
/// Lines are looked for under the lines of both ends, a little way back from their tips: at the tips themselves that of
/// the one may lie under the other.
pub(super) fn drawn_between(known: &Known, tips: &[Tip; 2]) -> DrawnBetween {
    let [first, second] = tips.each_ref().map(|tip| under(known, tip));
    let gap = distance(tips[0].place, tips[1].place);
    let back = tips
        .each_ref()
        .map(|tip| distance(tip.place, tip.back_place));

    // Follow lines from the one to the other.
    let most = back[0] + gap + back[1] + LONGER_PX;
    let leads = |a: &Under, b: &Under| {
        let is_one = a.line == b.line && a.is_out != b.is_out;
        is_one && (-BACK_PX..=most).contains(&way_between(known, a, b))
    };
    let leads_on = |a| second.iter().any(|b| leads(a, b));
    if first.iter().any(leads_on) {
        return DrawnBetween::Line;
    }

    // Look for lines that ended.
    let ended = |back: f64| {
        move |under: &Under| {
            left_of(known, under).is_some_and(|left| left <= back + gap + BEYOND_PX)
        }
    };
    match first.iter().any(ended(back[0])) || second.iter().any(ended(back[1])) {
        true => DrawnBetween::End,
        false => DrawnBetween::Nothing,
    }
}

/// The way along their line from one sample to another, in pixels; it is less than 0 where it leads back.
fn way_between(known: &Known, from: &Under, to: &Under) -> f64 {
    let ahead = i64::from(to.sample) - i64::from(from.sample);
    let way = if from.is_out { ahead } else { -ahead } as f64 * STEP_PX;
    match f64::from(known.line(from.line).around_px) {
        around if around > 0.0 && way < -BACK_PX => way + around,
        _ => way,
    }
}

/// The way from a sample to where its line ended, in pixels; none for rings.
fn left_of(known: &Known, under: &Under) -> Option<f64> {
    let line = known.line(under.line);
    let [from, to] = line.samples;
    let left = if under.is_out {
        to - 1 - under.sample
    } else {
        under.sample - from
    };
    (line.around_px == 0.0).then_some(f64::from(left) * STEP_PX)
}

/// The samples of the frame before under the line of an end, of lines that are like its own.
fn under(known: &Known, tip: &Tip) -> Vec<Under> {
    let under = |(sample, seen): (u32, &Seen)| {
        let line = known.line(seen.line);
        let cos = seen.along[0] * tip.out[0] + seen.along[1] * tip.out[1];
        let is_alike = (line.kind, line.is_hidden, line.age) == (tip.kind, tip.is_hidden, 0);
        let is_near = distance(seen.position, tip.back_place) <= REACH_PX;
        (is_alike && is_near && cos.abs() >= LEAST_COS).then_some(Under {
            sample,
            line: seen.line,
            is_out: cos > 0.0,
        })
    };
    known.around(tip.back_place).filter_map(under).collect()
}
