//! How wide lines are, where their middle is, and where they end, measured across their ink.

use super::calm::{Calm, calm};
use super::link::{Way, WayPoint};
use crate::Bitmap;
use glam::DVec2;

/// Shares of a step from place to place at which the ink is measured: between pixels it is as wide as on them.
const SAMPLES: [f64; 4] = [-0.375, -0.125, 0.125, 0.375];

/// Places on either side of one whose ink says how wide a line is there.
const BESIDE: usize = 2;

/// Lines are never thinner than a pixel: slanted lines of single pixels would come out at 0.71.
const LEAST_WIDTH_PX: f64 = 1.0;

/// A line whose width varies by less than so many pixels, or by that share of its mean, is even: pixels show no less.
const EVEN: [f64; 2] = [0.8, 0.15];

/// How far the ink goes on from a place in a direction, up to `limit` pixels; none where it goes on further.
pub fn ink_along(bitmap: &Bitmap, from: DVec2, direction: DVec2, limit: f64) -> Option<f64> {
    let mut cell = from.floor().as_i64vec2();
    let step = direction.signum().as_i64vec2();
    let pace = direction.abs().recip();
    let ahead = DVec2::select(
        direction.cmpgt(DVec2::ZERO),
        from.floor() + 1.0 - from,
        from - from.floor(),
    );
    // Directions along an axis never leave a row or column; infinity times zero would be no number.
    let mut next = DVec2::select(direction.cmpeq(DVec2::ZERO), DVec2::INFINITY, ahead * pace);
    let mut here = 0.0;
    while bitmap.is_ink(cell.x, cell.y) {
        if next.x <= next.y {
            (here, cell.x) = (next.x, cell.x + step.x);
            next.x += pace.x;
        } else {
            (here, cell.y) = (next.y, cell.y + step.y);
            next.y += pace.y;
        }
        if here > limit {
            return None;
        }
    }
    Some(here)
}

/// What is known across a line at one of its points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Across {
    /// The middle of the ink.
    pub place: DVec2,
    /// Its width, in pixels; none within junctions.
    pub width: Option<f64>,
}

/// Measures the ink across a line at each of its points.
///
/// Chords across the line are measured, in the mean over a step along it, so that the area of the ink is kept. What
/// goes on much further than the edge is away by the distance transform is another line, and counts as not measured.
pub fn measure(way: &Way, bitmap: &Bitmap) -> Vec<Across> {
    // Smooth the way for its directions.
    let places: Vec<DVec2> = way.points.iter().map(|point| point.place).collect();
    let how = Calm {
        tolerance: 1.0,
        most: 8,
        closed: way.closed,
        pinned: [false; 2],
    };
    let mut along: Vec<DVec2> = calm(&places, &how)
        .iter()
        .map(|[_, along]| *along)
        .collect();

    // Hold the direction towards free ends, where thinning bends.
    if !way.closed {
        for (end, _) in way.free.into_iter().enumerate().filter(|(_, free)| *free) {
            hold_direction(way, end, &mut along);
        }
    }

    // Measure across.
    let points = way.points.iter().zip(along).enumerate();
    points
        .map(|(i, (point, along))| across(point, along, limit_at(way, i), bitmap))
        .collect()
}

/// How far the ink of a line of half a width may go on to a side: what goes on farther is another line.
pub fn farthest_aside(radius: f64) -> f64 {
    1.5 * radius + 1.5
}

/// The same at a place of a way; none where it was not measured.
///
/// The pixel of a thin line may lie at the side of its ink, on a step of a stair: the ink beside it says how wide the
/// line is.
fn limit_at(way: &Way, at: usize) -> Option<f64> {
    way.points[at].radius?;
    let last = way.points.len() - 1;
    let around = &way.points[at.saturating_sub(BESIDE)..=(at + BESIDE).min(last)];
    let radii = around.iter().filter_map(|point| point.radius);
    Some(farthest_aside(radii.fold(0.0, f64::max)))
}

/// Gives the last places of a line the direction half a width before them: thinned ends turn to a corner of the ink.
fn hold_direction(way: &Way, end: usize, along: &mut [DVec2]) {
    let last = along.len() - 1;
    let at = |k: usize| if end == 0 { k } else { last - k };
    let widest = (0..=last.min(8))
        .filter_map(|k| way.points[at(k)].radius)
        .fold(0.0, f64::max);
    let held = (widest.ceil() as usize).min(last);
    let direction = along[at(held)];
    (0..held).for_each(|k| along[at(k)] = direction);
}

fn across(point: &WayPoint, along: DVec2, limit: Option<f64>, bitmap: &Bitmap) -> Across {
    let nothing = Across {
        place: point.place,
        width: None,
    };
    let Some(limit) = limit else {
        return nothing;
    };

    // Send rays to both sides at several places.
    let (mut left, mut right, mut count) = (0.0, 0.0, 0.0);
    for share in SAMPLES {
        let from = point.place + along * share;
        let sides = [along.perp(), -along.perp()].map(|side| ink_along(bitmap, from, side, limit));
        let [Some(a), Some(b)] = sides else {
            return nothing;
        };
        (left, right, count) = (left + a, right + b, count + 1.0);
    }

    // Move the place to the middle of the ink.
    let shift = (0.5 * (left - right) / count).clamp(-1.5, 1.5);
    Across {
        place: point.place + along.perp() * shift,
        width: Some((left + right) / count),
    }
}

/// Smooth widths along a line, from those measured; `fallback` where there are none.
///
/// Where nothing was measured, the nearest measured ones go on; then the median of 5, then the mean over about two
/// widths. A line that is even but for what pixels cannot show gets one width.
pub fn smooth_widths(measured: &[Option<f64>], closed: bool, fallback: f64) -> Vec<f64> {
    // Without a measured width all are the fallback.
    let mut known: Vec<(usize, f64)> = measured
        .iter()
        .enumerate()
        .filter_map(|(i, width)| Some((i, (*width)?)))
        .collect();
    if known.is_empty() {
        return vec![fallback.max(LEAST_WIDTH_PX); measured.len()];
    }

    // Take out outliers by medians of five.
    let values: Vec<f64> = known.iter().map(|(_, width)| *width).collect();
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let at = |i: isize| {
        let count = values.len() as isize;
        values[if closed {
            i.rem_euclid(count)
        } else {
            i.clamp(0, count - 1)
        } as usize]
    };
    let medians: Vec<f64> = (0..values.len() as isize)
        .map(|i| {
            let mut five = [-2, -1, 0, 1, 2].map(|k| at(i + k));
            five.sort_by(f64::total_cmp);
            five[2]
        })
        .collect();

    // Smooth over a length that grows with the width.
    let reach = (mean.ceil() as usize).clamp(4, 24);
    let smooth = means(&means(&medians, reach, closed), reach, closed);
    for ((_, width), smooth) in known.iter_mut().zip(smooth) {
        *width = smooth.max(LEAST_WIDTH_PX);
    }

    // Make widths even where they hardly differ.
    let low = known
        .iter()
        .map(|(_, width)| *width)
        .fold(f64::INFINITY, f64::min);
    let high = known.iter().map(|(_, width)| *width).fold(0.0, f64::max);
    if high - low <= EVEN[0].max(EVEN[1] * mean) {
        return vec![mean.max(LEAST_WIDTH_PX); measured.len()];
    }

    // Fill the gaps where nothing was measured.
    spread(&known, measured.len(), closed)
}

/// Places that the mean at the end of an open line goes on over: few, so that pointed ends stay pointed.
const END_REACH: usize = 6;

/// Means over places up to `reach` away; fewer at the ends of open lines.
fn means(values: &[f64], reach: usize, closed: bool) -> Vec<f64> {
    // Sum up, three times around a closed line.
    let count = values.len();
    let mut sums = vec![0.0];
    let around = if closed { 3 } else { 1 };
    for i in 0..around * count {
        sums.push(sums[i] + values[i % count]);
    }

    // Take the mean of a window, shorter at the ends of an open line.
    (0..count)
        .map(|i| {
            let [from, to] = if closed {
                let reach = reach.min(count / 2);
                [i + count - reach, i + count + reach + 1]
            } else {
                let [before, after] = [i, count - 1 - i];
                let side = |own: usize, other: usize| reach.min(own).min(other + END_REACH);
                [i - side(before, after), i + side(after, before) + 1]
            };
            (sums[to] - sums[from]) / (to - from) as f64
        })
        .collect()
}

/// Known values with those between them, in straight lines; beyond the first and last, the same.
fn spread(known: &[(usize, f64)], count: usize, closed: bool) -> Vec<f64> {
    let (first, last) = (known[0], known[known.len() - 1]);
    let mut at = 0;
    (0..count)
        .map(|i| {
            while known.get(at).is_some_and(|(k, _)| *k < i) {
                at += 1;
            }

            // Find the known widths on both sides.
            let (before, after) = match (at.checked_sub(1), known.get(at)) {
                (Some(b), Some(a)) => (known[b], *a),
                (None, Some(a)) if closed => ((last.0.wrapping_sub(count), last.1), *a),
                (Some(b), None) if closed => (known[b], (first.0 + count, first.1)),
                (None, Some(a)) => (*a, *a),
                (Some(b), None) => (known[b], known[b]),
                (None, None) => (first, first),
            };

            // Mix them by distance.
            let span = after.0.wrapping_sub(before.0) as isize as f64;
            let share = i.wrapping_sub(before.0) as isize as f64 / span;
            if span > 0.0 {
                before.1 + (after.1 - before.1) * share.clamp(0.0, 1.0)
            } else {
                before.1
            }
        })
        .collect()
}
