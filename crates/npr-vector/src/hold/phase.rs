//! Where the texture of a stroke lies: shifted along it as a whole, or in parts.

use super::remembered::{Known, Place, STEP_PX};
use super::votes::Vote;
use crate::mesh_lines::run::distance;
use crate::stroke::{Stroke, StrokePoint};
use std::cmp::Reverse;

/// Shortest part with a texture of its own, in samples: 8 pixels.
const LEAST_SAMPLES: usize = 4;

/// Samples without a vote, or with another one, over which a row of votes goes on.
const GAP_SAMPLES: usize = 8;

/// Most by which shifts differ from a sample to the next in one row, in pixels, beside what is noise: surfaces turn
/// away, and lines on them get longer, of figures that run by more than half in a frame. Where one texture changes over
/// to another they may differ by more.
const STRETCH_PX: f64 = 1.6;

/// Noise of shifts, in pixels.
const NOISE_PX: f64 = 0.4;

/// Difference of shifts up to which two rows are one, in pixels.
const ALIKE_PX: f64 = 1.0;

/// How far the shift of a part comes nearer to that of the largest part in a frame, in pixels.
const APPROACH_PX: f64 = 0.5;

/// Most by which shifts of one row differ, in pixels: where more of a line comes or goes on the way, its texture is
/// parted.
const SPREAD_PX: f64 = 6.0;

/// Way over which one texture changes over to another that is shifted by at most as much, in pixels; of a part that is
/// shorter, its length. Others meet in a seam: squeezed into so little, they would be a streak.
const BLEND_PX: f64 = 12.0;

/// Length of a seam, in pixels.
const SEAM_PX: f64 = 0.5;

/// Shifts are multiples of this, in pixels, so that what stands still stays to the bit: more than rounding, and less
/// than anybody sees.
const GRAIN_PX: f64 = 1.0 / 64.0;

/// Votes of one shift.
#[derive(Debug, Clone, Copy)]
struct Row {
    /// Whether the texture runs as the stroke does.
    is_along: bool,
    first: f64,
    /// The shift of the last vote, and its number.
    last: f64,
    index: usize,
    count: usize,
}

/// A part of a stroke with one shift: its first and its last sample.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Part {
    row: usize,
    from: usize,
    to: usize,
    is_along: bool,
    shift: f64,
}

/// A vote for where the texture lies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Shift {
    /// Whether the texture runs as the stroke does.
    pub is_along: bool,
    /// The texture coordinate where the stroke starts.
    pub shift: f64,
    /// Length of the ring that it lay on; 0 elsewhere.
    pub around: f64,
}

/// Shifts the texture of a stroke to where its samples have it.
pub(super) fn shift(stroke: &mut Stroke, places: &[Place], votes: &[Option<Vote>], known: &Known) {
    // Measure the shift of every vote.
    let shifts: Vec<Option<Shift>> = places
        .iter()
        .zip(votes)
        .map(|(place, vote)| {
            vote.map(|vote| Shift {
                is_along: vote.is_texture_along,
                shift: vote.u
                    - if vote.is_texture_along {
                        place.way
                    } else {
                        -place.way
                    },
                around: f64::from(known.line(vote.line).around_px),
            })
        })
        .collect();
    let own = if stroke.closed { stroke.length() } else { 0.0 };

    // Apply what they agree on.
    let mut parts = parts_of(&shifts, own);
    approach(&mut parts);
    if let (true, Some(first)) = (own > 0.0, parts.first().map(|part| part.shift)) {
        let rounds = (first / own).round() * own;
        parts.iter_mut().for_each(|part| part.shift -= rounds);
    }
    let rounded = |shift: f64| (shift / GRAIN_PX).round() * GRAIN_PX;
    parts
        .iter_mut()
        .for_each(|part| part.shift = rounded(part.shift));
    apply(stroke, &parts);
}

/// The parts of a stroke with shifts of their own, in order. `own` is its length where it is a ring, else 0.
pub(super) fn parts_of(shifts: &[Option<Shift>], own: f64) -> Vec<Part> {
    // Sort votes into rows, each with the last that it goes on from.
    let mut rows: Vec<Row> = Vec::new();
    let mut labels: Vec<Option<(usize, f64)>> = vec![None; shifts.len()];
    for (index, vote) in shifts.iter().enumerate() {
        let Some(vote) = vote else {
            continue;
        };
        let near = |to: f64| nearest(vote.shift, to, [vote.around, own]);
        let goes_on = |row: &Row| {
            let (gap, shift) = (index - row.index, near(row.last));
            let step = (shift - row.last).abs();
            row.is_along == vote.is_along
                && gap <= GAP_SAMPLES
                && step <= STRETCH_PX * gap as f64 + NOISE_PX
                && (shift - row.first).abs() <= SPREAD_PX
        };
        let found = (0..rows.len()).rev().find(|number| goes_on(&rows[*number]));
        let number = found.unwrap_or_else(|| {
            let shift = near(rows.last().map_or(0.0, |row| row.last));
            rows.push(Row {
                is_along: vote.is_along,
                first: shift,
                last: shift,
                index,
                count: 0,
            });
            rows.len() - 1
        });
        let row = &mut rows[number];
        (row.last, row.index, row.count) = (near(row.last), index, row.count + 1);
        labels[index] = Some((number, row.last));
    }

    // Keep the large ones, at least the largest.
    let Some(most) = rows.iter().map(|row| row.count).max() else {
        return Vec::new();
    };
    let is_large = |row: usize| rows[row].count >= LEAST_SAMPLES.min(most);
    let medians = medians(&labels, rows.len());
    let mut parts: Vec<Part> = Vec::new();
    for (index, label) in labels.iter().enumerate() {
        if let Some((row, _)) = label.filter(|(row, _)| is_large(*row)) {
            let part = Part {
                row,
                from: index,
                to: index,
                is_along: rows[row].is_along,
                shift: medians[row],
            };
            add(&mut parts, part);
        }
    }

    // Leave out what is short between others.
    let longest = parts.iter().map(Part::len).max().unwrap_or(0);
    let mut kept: Vec<Part> = Vec::new();
    let is_long = |part: &Part| part.len() >= LEAST_SAMPLES.min(longest);
    for part in parts.into_iter().filter(is_long) {
        add(&mut kept, part);
    }
    kept
}

impl Part {
    fn len(&self) -> usize {
        self.to + 1 - self.from
    }

    /// The texture coordinate at a way from the start of the stroke.
    fn u(&self, way: f64) -> f64 {
        self.shift + if self.is_along { way } else { -way }
    }
}

/// Adds a part behind others, to the last one where both are alike.
fn add(parts: &mut Vec<Part>, next: Part) {
    let Some(last) = parts.last_mut() else {
        return parts.push(next);
    };
    let is_alike = last.is_along == next.is_along && (last.shift - next.shift).abs() <= ALIKE_PX;
    if !is_alike && last.row != next.row {
        return parts.push(next);
    }
    if next.len() > last.len() {
        (last.row, last.shift) = (next.row, next.shift);
    }
    last.to = next.to;
}

/// The middle one of the shifts of each row, the lower one of two.
fn medians(labels: &[Option<(usize, f64)>], count: usize) -> Vec<f64> {
    let mut of_rows: Vec<Vec<f64>> = vec![Vec::new(); count];
    for (row, shift) in labels.iter().flatten() {
        of_rows[*row].push(*shift);
    }
    let of_rows = of_rows.into_iter().map(|mut shifts| {
        let middle = (shifts.len() - 1) / 2;
        *shifts.select_nth_unstable_by(middle, f64::total_cmp).1
    });
    of_rows.collect()
}

/// The value that is `value` but for whole periods, and nearest to another one; periods of 0 are none.
fn nearest(value: f64, to: f64, periods: [f64; 2]) -> f64 {
    let mut best = value;
    for period in periods.into_iter().filter(|period| *period > 0.0) {
        let moved = value - ((value - to) / period).round() * period;
        if (moved - to).abs() < (best - to).abs() {
            best = moved;
        }
    }
    best
}

/// Brings parts a little nearer to the longest, where they run as it does.
fn approach(parts: &mut [Part]) {
    let longest = parts
        .iter()
        .max_by_key(|part| (part.len(), Reverse(part.from)));
    if let Some(target) = longest.copied() {
        for part in parts
            .iter_mut()
            .filter(|part| part.is_along == target.is_along)
        {
            part.shift += (target.shift - part.shift).clamp(-APPROACH_PX, APPROACH_PX);
        }
    }
}

/// Gives the points of a stroke their texture coordinate, with points where it begins and ends to change over.
fn apply(stroke: &mut Stroke, parts: &[Part]) {
    // Settle where it changes over: half way between parts.
    let Some(first) = parts.first() else {
        return;
    };
    let mut knots: Vec<(f64, &Part)> = Vec::new();
    for pair in parts.windows(2) {
        let middle = (pair[0].to + pair[1].from) as f64 * 0.5 * STEP_PX;
        let shorter = pair[0].len().min(pair[1].len()) as f64 * STEP_PX;
        let is_near = pair[0].is_along == pair[1].is_along
            && (pair[0].shift - pair[1].shift).abs() <= BLEND_PX.min(shorter);
        let half = 0.5 * shorter.min(if is_near { BLEND_PX } else { SEAM_PX });
        knots.extend([(middle - half, &pair[0]), (middle + half, &pair[1])]);
    }
    let u_at = |way: f64| {
        let next = knots.partition_point(|knot| knot.0 <= way);
        let last = next.checked_sub(1).map(|last| knots[last]);
        match (last, knots.get(next)) {
            (None, _) => first.u(way),
            (Some((_, part)), None) => part.u(way),
            (Some((from, part)), Some((to, other))) => {
                // Between the two knots of one part it is that of the part.
                let share = (way - from) / (to - from);
                part.u(way) + (other.u(way) - part.u(way)) * share
            }
        }
    };

    // Walk along, and put points at the knots.
    let mut way = 0.0;
    let mut points: Vec<StrokePoint> = Vec::with_capacity(stroke.points.len() + knots.len());
    let mut left = knots.iter().map(|knot| knot.0).peekable();
    let old = std::mem::take(&mut stroke.points);
    let around = old.first().copied().filter(|_| stroke.closed);
    for (index, from) in old.iter().enumerate() {
        points.push(StrokePoint {
            u: u_at(way),
            ..*from
        });
        let Some(to) = old.get(index + 1).or(around.as_ref()) else {
            break;
        };
        let length = distance(from.position, to.position);
        while let Some(knot) = left.next_if(|knot| *knot < way + length) {
            let share = (knot - way) / length;
            if share > 0.0 && from.color == to.color {
                points.push(StrokePoint {
                    u: u_at(knot),
                    ..between(from, to, share)
                });
            }
        }
        way += length;
    }
    stroke.points = points;
}

/// The point a share of the way from one to another of the same colour.
pub(super) fn between(from: &StrokePoint, to: &StrokePoint, share: f64) -> StrokePoint {
    let mix = |a: f64, b: f64| a + (b - a) * share;
    StrokePoint {
        position: [0, 1].map(|i| mix(from.position[i], to.position[i])),
        depth: mix(from.depth, to.depth),
        width: mix(from.width, to.width),
        world: [0, 1, 2].map(|i| mix(from.world[i].into(), to.world[i].into()) as f32),
        ..*from
    }
}
