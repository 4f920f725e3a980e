//! Ends of strokes that grow instead of leaping.

use super::phase::between;
use super::remembered::{Known, Place, REACH_PX, STEP_PX, Seen, sampled};
use crate::mesh_lines::run::distance;
use crate::stroke::{Stroke, StrokePoint};
use glam::DVec2;
use rayon::prelude::*;

/// Most by which an end grows in a frame beyond what was drawn, in pixels. With the reach of samples it is 8.
const GROWTH_PX: f64 = 5.0;

/// Longest part that grows, in pixels; what is longer comes at once, as behind a limb that swings.
const LONGEST_PX: f64 = 24.0;

/// Least cosine between the directions of a stroke and of what it was.
const LEAST_COS: f64 = 0.7;

/// Way from the last sample that is still under a stroke to where its line ended, in samples at most.
const END_SAMPLES: u32 = 4;

/// Distance up to which another line meets an end, in pixels: a little more than that of caps of pens.
const MEETS_PX: f64 = 5.0;

/// Takes off what grew too fast at the ends of visible open strokes, and returns which strokes it shortened.
///
/// An end grows where the line that it was ended, by 5 pixels beyond the last place near one of that line, so by 8 at
/// most. Parts of more than 24 pixels stay whole, and so do those that another visible stroke meets: there it would
/// leave a gap. O(points + growing ends · points), on all threads.
pub(super) fn slow_growth(strokes: &mut [Stroke], known: &Known) -> Vec<usize> {
    // Find what grows, beside nothing.
    let grown: Vec<[f64; 2]> = strokes
        .par_iter()
        .map(|stroke| growth_of(stroke, known))
        .collect();
    let all = &*strokes;
    let is_free = |number: usize, part: &[Place]| {
        let mut others = all.iter().enumerate();
        !others.any(|(other, stroke)| other != number && meets(stroke, part))
    };
    let grown: Vec<(usize, [f64; 2])> = (grown.into_iter().enumerate())
        .filter(|(_, grown)| *grown != [0.0; 2])
        .map(|(number, grown)| {
            let places = sampled(&all[number]);
            let from_end = |px: f64| ((px / STEP_PX) as usize + 1).min(places.len());
            let [first, last] = grown.map(from_end);
            let parts = [&places[..first], &places[places.len() - last..]];
            let kept = [0, 1].map(
                |end| match grown[end] > 0.0 && is_free(number, parts[end]) {
                    true => grown[end],
                    false => 0.0,
                },
            );
            (number, kept)
        })
        .collect();

    // Take it off.
    let mut shortened = Vec::new();
    for (number, [first, last]) in grown {
        let stroke = &mut strokes[number];
        let by_px = [first, last].map(|grown| (grown - GROWTH_PX).max(0.0));
        stroke.part = stroke.part.map(|part| part.shortened(by_px));
        let points = &mut stroke.points;
        if first > 0.0 {
            shorten(points, by_px[0]);
        }
        if last > 0.0 {
            points.reverse();
            shorten(points, by_px[1]);
            // The last point lies on what the piece before it lies on.
            points[0].location = points[1].location;
            points.reverse();
        }
        if first.max(last) > 0.0 {
            shortened.push(number);
        }
    }
    shortened
}

/// How much grew too fast at both ends of a stroke, in pixels; 0 for nothing.
fn growth_of(stroke: &Stroke, known: &Known) -> [f64; 2] {
    let length = stroke.length();
    if stroke.closed || !stroke.is_visible() {
        return [0.0; 2];
    }
    let places = sampled(stroke);
    let steps = (LONGEST_PX / STEP_PX) as usize + 1;
    [true, false].map(|is_start| {
        // Find the first place on what was there.
        let at = |number: usize| match is_start {
            true => &places[number],
            false => &places[places.len() - 1 - number],
        };
        let first = (0..steps.min(places.len())).find_map(|number| {
            let is_ended = is_end_near(known, stroke, at(number), is_start)?;
            Some((at(number).way, is_ended))
        });
        match first {
            Some((way, true)) => {
                let new_px = if is_start { way } else { length - way };
                if new_px > GROWTH_PX && new_px <= LONGEST_PX {
                    new_px
                } else {
                    0.0
                }
            }
            _ => 0.0,
        }
    })
}

/// Whether a visible stroke comes near one of some places.
fn meets(stroke: &Stroke, places: &[Place]) -> bool {
    let points = &stroke.points;
    let around = points.last().zip(points.first()).filter(|_| stroke.closed);
    let pieces = points
        .windows(2)
        .map(|pair| (&pair[0], &pair[1]))
        .chain(around);
    let mut pieces = pieces.map(|(from, to)| [from.position, to.position].map(DVec2::from));
    let is_near = |[from, to]: [DVec2; 2]| {
        let along = to - from;
        places
            .iter()
            .map(|place| DVec2::from(place.position) - from)
            .any(|way| {
                let share = way.dot(along) / along.length_squared().max(f64::MIN_POSITIVE);
                way.distance(along * share.clamp(0.0, 1.0)) <= MEETS_PX
            })
    };
    stroke.is_visible() && pieces.any(is_near)
}

/// Whether the nearest line of the frame before at a place of a stroke ended there, towards an end of the stroke; none
/// where no line was.
fn is_end_near(known: &Known, stroke: &Stroke, place: &Place, is_start: bool) -> Option<bool> {
    let cos = |seen: &Seen| seen.along[0] * place.along[0] + seen.along[1] * place.along[1];
    let fits = |(_, seen): &(u32, &Seen)| {
        let line = known.line(seen.line);
        (line.kind, line.is_hidden, line.age) == (stroke.kind, false, 0)
            && cos(seen).abs() >= LEAST_COS
            && distance(seen.position, place.position) <= REACH_PX
    };
    let is_ended = |(sample, seen): (u32, &Seen)| {
        let line = known.line(seen.line);
        let [from, to] = line.samples;
        let left = match (cos(seen) > 0.0) == is_start {
            true => sample - from,
            false => to - 1 - sample,
        };
        line.around_px == 0.0 && left <= END_SAMPLES
    };
    let away = |(_, seen): &(u32, &Seen)| distance(seen.position, place.position);
    let near = known.around(place.position).filter(fits);
    near.min_by(|a, b| away(a).total_cmp(&away(b)).then(a.0.cmp(&b.0)))
        .map(is_ended)
}

/// Takes some pixels off the start of a way that is longer.
fn shorten(points: &mut Vec<StrokePoint>, by_px: f64) {
    let mut gone = 0.0;
    for next in 1..points.len() {
        let (from, to) = (points[next - 1], points[next]);
        let length = distance(from.position, to.position);
        if gone + length > by_px {
            points.drain(..next - 1);
            points[0] = between(&from, &to, (by_px - gone) / length);
            return;
        }
        gone += length;
    }
}
