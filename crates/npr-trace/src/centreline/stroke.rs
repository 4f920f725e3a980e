//! A way along pixels as a smooth stroke with widths.

use super::calm::{Calm, calm};
use super::centre_stroke::{CentrePoint, CentreStroke};
use super::corner::{Corner, corners};
use super::link::Way;
use super::measure::{farthest_aside, ink_along, measure, smooth_widths};
use crate::Bitmap;
use glam::DVec2;

/// How far, in pixels, a place of a line a pixel wide may be moved to the side: pixels' middles lie within half a
/// pixel of what was drawn.
const TOLERANCE_PX: f64 = 0.7;

/// What is added to that for every pixel of width: wide lines have rough edges.
pub const ROUGHNESS: f64 = 0.05;

/// Most places on either side that a place is the mean of.
const WINDOW: usize = 64;

/// Half the length of a dot, in pixels, so that it has a direction.
pub const DOT_PX: f64 = 0.05;

/// Places between pixels, about a pixel apart, made smooth but for corners of `corner` radians and more; as many as
/// there are.
///
/// Ends that are pinned stay where they are, as far as a parabola can.
pub fn smooth_border(places: &[DVec2], closed: bool, pinned: [bool; 2], corner: f64) -> Vec<DVec2> {
    let how = Calm {
        tolerance: TOLERANCE_PX,
        most: WINDOW,
        closed,
        pinned,
    };
    smooth_between(places, &corners(places, |_| 1, corner, &how), &how)
}

/// The stroke along a way; `corner` in radians.
pub fn stroke(way: &Way, ink: &Bitmap, corner: f64) -> CentreStroke {
    if way.points.len() < 3 {
        return short(way, ink);
    }
    let across = measure(way, ink);
    let measured: Vec<Option<f64>> = across.iter().map(|at| at.width).collect();
    let radius = way
        .points
        .iter()
        .filter_map(|point| point.radius)
        .fold(0.5, f64::max);
    let widths = smooth_widths(&measured, way.closed, 2.0 * radius);
    let mean = widths.iter().sum::<f64>() / widths.len() as f64;
    let places: Vec<DVec2> = across.iter().map(|at| at.place).collect();
    let how = Calm {
        tolerance: TOLERANCE_PX + ROUGHNESS * mean,
        most: WINDOW,
        closed: way.closed,
        pinned: way.free.map(|free| !free),
    };
    // Thinning takes the pixel of a corner, and of wide lines more.
    let gap = |at: usize| ((0.5 * widths[at]).ceil() as usize).max(1);
    let mut corners = corners(&places, gap, corner, &how);
    for corner in &mut corners {
        // Sides that meet outside the ink end in a round corner.
        let [x, y] = corner.place.floor().as_i64vec2().to_array();
        if !ink.is_ink(x, y) {
            corner.place = places[corner.at];
        }
    }
    let smooth = smooth_between(&places, &corners, &how);
    let mut points: Vec<CentrePoint> = smooth
        .into_iter()
        .zip(&widths)
        .map(|(place, width)| CentrePoint {
            place: place.to_array(),
            width: *width,
        })
        .collect();
    if !way.closed {
        for (end, free) in way.free.into_iter().enumerate() {
            if free {
                reach_end(&mut points, end, ink);
            }
        }
    }
    CentreStroke {
        points,
        closed: way.closed,
        free: way.free,
    }
}

/// Smooth places, as many as there are; corners stay.
fn smooth_between(places: &[DVec2], corners: &[Corner], how: &Calm) -> Vec<DVec2> {
    let count = places.len();
    let Some(first) = corners.first() else {
        return calm(places, how).iter().map(|[place, _]| *place).collect();
    };
    // Of a closed line the parts go from corner to corner, around; of an open one there are two more ends.
    let start = if how.closed { first.at } else { 0 };
    let mut cuts: Vec<(usize, Option<&Corner>)> = corners
        .iter()
        .map(|corner| (corner.at - start, Some(corner)))
        .collect();
    if how.closed {
        cuts.push((count, Some(first)));
    } else {
        cuts.insert(0, (0, None));
        cuts.push((count - 1, None));
    }
    let mut smooth = vec![DVec2::ZERO; count];
    for (number, pair) in cuts.windows(2).enumerate() {
        let ([from, to], ends) = ([pair[0].0, pair[1].0], [pair[0].1, pair[1].1]);
        let mut part: Vec<DVec2> = (from..=to).map(|k| places[(start + k) % count]).collect();
        straighten(&mut part, ends);
        let is_last = number + 2 == cuts.len();
        let how = Calm {
            closed: false,
            pinned: [
                ends[0].is_some() || (number == 0 && how.pinned[0]),
                ends[1].is_some() || (is_last && how.pinned[1]),
            ],
            ..*how
        };
        for (k, [place, _]) in (from..=to).zip(calm(&part, &how)) {
            smooth[(start + k) % count] = place;
        }
    }
    for corner in corners {
        smooth[corner.at] = corner.place;
    }
    smooth
}

/// Leads a part of a line straight to the corners at its ends, where their ink has moved it.
fn straighten(part: &mut [DVec2], ends: [Option<&Corner>; 2]) {
    for (end, corner) in ends.into_iter().enumerate() {
        let Some(corner) = corner else { continue };
        let last = part.len() - 1;
        let at = |k: usize| if end == 0 { k } else { last - k };
        let gap = corner.gap.min(last);
        let kept = part[at(gap)];
        for k in 0..gap.max(1) {
            let share = k as f64 / gap.max(1) as f64;
            part[at(k)] = corner.place.lerp(kept, share);
        }
    }
}

/// Leads an end to where a round cap of its width ends with the ink.
fn reach_end(points: &mut Vec<CentrePoint>, end: usize, ink: &Bitmap) {
    let count = points.len();
    let at = |k: usize| if end == 0 { k } else { count - 1 - k };
    let tip = points[at(0)];
    let half = 0.5 * tip.width;
    let back = ((2.0 * tip.width).ceil() as usize)
        .clamp(3, 12)
        .min(count - 1);
    let [here, there] = [at(0), at(back)].map(|k| DVec2::from_array(points[k].place));
    let Some(along) = (here - there).try_normalize() else {
        return;
    };
    // Beyond this the ink is another line that the end runs into. A thin line's middle may leave the ink by its side.
    let limit = 3.0 * half + 3.0;
    let aside = along.perp() * (0.5 * half);
    let rays = [here, here - aside, here + aside].map(|from| ink_along(ink, from, along, limit));
    let [Some(left), Some(a), Some(b)] = rays else {
        return;
    };
    let left = a.max(b).min(left + 1.0).max(left);
    if left > half {
        let steps = (left - half).ceil();
        let reached = (1..=steps as u32).map(|k| CentrePoint {
            place: (here + along * ((left - half) * f64::from(k) / steps)).to_array(),
            width: tip.width,
        });
        if end == 0 {
            points.splice(0..0, reached.rev().collect::<Vec<_>>());
        } else {
            points.extend(reached);
        }
    } else {
        draw_back(points, end, half - left);
    }
}

/// Shortens a line, but leaves two points.
fn draw_back(points: &mut Vec<CentrePoint>, end: usize, by: f64) {
    if end == 0 {
        points.reverse();
    }

    // Take points off until the length is used up.
    let mut left = by;
    while points.len() > 2 {
        let [before, last] =
            [points.len() - 2, points.len() - 1].map(|k| DVec2::from_array(points[k].place));
        let step = before.distance(last);
        if step > left {
            let place = last.lerp(before, left / step);
            let count = points.len();
            points[count - 1].place = place.to_array();
            break;
        }
        left -= step;
        points.pop();
    }
    if end == 0 {
        points.reverse();
    }
}

/// A stroke of one or two pixels.
fn short(way: &Way, ink: &Bitmap) -> CentreStroke {
    let first = way.points.first().map_or(DVec2::ZERO, |point| point.place);
    let last = way.points.last().map_or(DVec2::ZERO, |point| point.place);
    let radius = way
        .points
        .iter()
        .filter_map(|point| point.radius)
        .fold(0.5, f64::max);
    let along = (last - first).try_normalize().unwrap_or(DVec2::X);
    let reach = |from: DVec2, along: DVec2| {
        ink_along(ink, from, along, farthest_aside(radius)).unwrap_or(radius)
    };
    let middle = first.midpoint(last);
    let [left, right] = [along.perp(), -along.perp()].map(|side| reach(middle, side));
    let middle = middle + along.perp() * (0.5 * (left - right));
    let width = (left + right).max(1.0);
    // Free ends go on to the edge of the ink, but for their caps.
    let ends =
        [(first, -along, way.free[0]), (last, along, way.free[1])].map(|(place, away, free)| {
            let shifted = place + along.perp() * (middle - first.midpoint(last)).dot(along.perp());
            let on = if free {
                reach(shifted, away) - 0.5 * width
            } else {
                0.0
            };
            shifted + away * on
        });
    let [mut a, mut b] = ends;
    if (b - a).dot(along) < 2.0 * DOT_PX {
        let centre = a.midpoint(b);
        (a, b) = (centre - along * DOT_PX, centre + along * DOT_PX);
    }
    CentreStroke {
        points: [a, b]
            .map(|place| CentrePoint {
                place: place.to_array(),
                width,
            })
            .to_vec(),
        closed: false,
        free: way.free,
    }
}
