//! Strokes that thin out towards their ends, as a pen does that is set down and lifted, and where they are short.
//!
//! An end is free where it meets no other line: where a contour ends in a cusp, a crease runs out, or a line of the
//! file stops. Elsewhere a line goes on or ends on another one, and there a pen is not lifted.

use crate::color_runs::point_between;
use crate::fit::distance2_to_segment;
use foldhash::fast::FixedState;
use kurbo::Point;
use npr_vector::mesh_lines::run::distance;
use npr_vector::stroke::{Stroke, StrokePoint};
use rayon::prelude::*;
use std::collections::HashMap;
use std::sync::atomic::{AtomicBool, Ordering};

/// Steps in which the width changes along a taper.
const STEPS: usize = 12;

/// Least distance, in pixels, at which an end meets a line, however thin this is.
const TOUCH_PX: f64 = 1.0;

/// Greatest distance, in pixels, at which an end meets a line, however wide this is.
const FARTHEST_TOUCH_PX: f64 = 64.0;

/// Distance, in pixels, from the border of the picture within which an end is cut off by it.
const BORDER_PX: f64 = 1.0;

/// How strokes thin out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Taper {
    /// Pixels over which a stroke swells from its start and thins out towards its end.
    pub lengths_px: [f64; 2],
    /// Greatest share of its stroke that each of the two takes, 0..0.5.
    pub share: f64,
    /// Share of the width that is left at the tip, 0..1.
    pub tip: f64,
    /// Whether ends that meet another line thin out too.
    pub at_all_ends: bool,
    /// Pixels under which a stroke that meets no other thins out as a whole; at half of them it is a speck, and gone.
    pub short_px: f64,
}

impl Taper {
    /// Whether it leaves every stroke as it is.
    pub fn is_none(&self) -> bool {
        let has_ends =
            self.share > 0.0 && self.tip < 1.0 && self.lengths_px.iter().any(|px| *px > 0.0);
        !(has_ends || self.short_px > 0.0)
    }

    /// Share of the width of a stroke that meets no other, by its length: 0 for specks.
    fn presence(&self, length: f64) -> f64 {
        if length < self.short_px {
            (2.0 * length / self.short_px - 1.0).max(0.0)
        } else {
            1.0
        }
    }

    /// Share of the width at a share of the taper's length from the tip: steep at the tip, even where it ends.
    fn width_at(&self, share: f64) -> f64 {
        let share = share.clamp(0.0, 1.0);
        self.tip + (1.0 - self.tip) * share * (2.0 - share)
    }
}

/// Thins the visible strokes for which `is_tapered` is true, in a picture of `size` pixels, and removes the specks
/// among them.
///
/// Lengths are along the stroke in the picture, so a taper looks the same from every side. Points are added where the
/// width changes; those that were there stay. Rings have no ends, but may be specks. The stroke's own far side counts
/// as another line. O(points), on all threads, with the same result for any number of them.
pub fn taper_strokes(
    strokes: &mut Vec<Stroke>,
    size: [u32; 2],
    taper: &Taper,
    is_tapered: impl Fn(&Stroke) -> bool + Sync,
) {
    if taper.is_none() {
        return;
    }

    // Thin the ends, and all of what is short.
    let lengths: Vec<f64> = strokes.par_iter().map(Stroke::length).collect();
    let is_met = match taper.at_all_ends && taper.short_px <= 0.0 {
        true => vec![[false; 2]; strokes.len()],
        false => met_ends(strokes, &lengths, size),
    };
    let ends = lengths.par_iter().zip(is_met);
    let all = strokes.par_iter_mut().zip(ends);
    let is_left = all.map(|(stroke, (length, is_met))| {
        if !stroke.is_visible() || !is_tapered(stroke) {
            return true;
        }
        let is_alone = stroke.closed || is_met == [false; 2];
        let presence = if is_alone {
            taper.presence(*length)
        } else {
            1.0
        };
        if presence < 1.0 {
            stroke
                .points
                .iter_mut()
                .for_each(|point| point.width *= presence);
        }
        if !stroke.closed {
            let most = taper.share.min(0.5) * length;
            let reach = [0, 1].map(|end| match is_met[end] && !taper.at_all_ends {
                true => 0.0,
                false => taper.lengths_px[end].min(most),
            });
            thin(stroke, *length, reach, taper);
        }
        presence > 0.0
    });
    let is_left: Vec<bool> = is_left.collect();

    // Remove the specks.
    let mut is_left = is_left.into_iter();
    strokes.retain(|_| is_left.next().unwrap_or(true));
}

/// Thins a stroke over `reach` pixels from its start and from its end.
fn thin(stroke: &mut Stroke, length: f64, reach: [f64; 2], taper: &Taper) {
    // Choose where the width changes: at even steps along either taper.
    if !(length.is_finite() && reach.iter().any(|px| *px > 0.0)) {
        return;
    }
    let steps = |px: f64| {
        let all = (1..=STEPS).map(move |step| px * step as f64 / STEPS as f64);
        all.filter(move |_| px > 0.0)
    };
    let from_start = steps(reach[0]);
    let from_end: Vec<f64> = steps(reach[1]).map(|px| length - px).collect();
    let mut added = from_start.chain(from_end.into_iter().rev()).peekable();

    // Put points there, and scale the width of all.
    let mut points = Vec::with_capacity(stroke.points.len() + 2 * STEPS);
    let mut along = 0.0;
    let thinned = |point: StrokePoint, along: f64| {
        let shares = [along, length - along];
        let factor = (0..2).filter(|end| reach[*end] > 0.0);
        let factor = factor.map(|end| taper.width_at(shares[end] / reach[end]));
        let width = point.width * factor.fold(1.0, f64::min);
        StrokePoint { width, ..point }
    };
    let old = std::mem::take(&mut stroke.points);
    for pair in old.windows(2) {
        points.push(thinned(pair[0], along));
        let next = along + distance(pair[0].position, pair[1].position);
        while let Some(at) = added.next_if(|at| *at < next - TOO_NEAR_PX) {
            if at > along + TOO_NEAR_PX {
                let share = (at - along) / (next - along);
                points.push(thinned(point_between(&pair[0], &pair[1], share), at));
            }
        }
        along = next;
    }
    points.extend(old.last().map(|last| thinned(*last, length)));
    stroke.points = points;
}

/// Distance from a point, in pixels, within which no other is added.
const TOO_NEAR_PX: f64 = 1e-3;

/// For the start and the end of every stroke whether a visible line or the border of the picture meets it.
fn met_ends(strokes: &[Stroke], lengths: &[f64], size: [u32; 2]) -> Vec<[bool; 2]> {
    // Sort the ends into cells of the picture.
    let ends = Ends::new(strokes);

    // Note those that lines pass.
    let is_met: Vec<[AtomicBool; 2]> = strokes.iter().map(|_| Default::default()).collect();
    let visible = strokes.par_iter().enumerate();
    let visible = visible.filter(|(_, stroke)| stroke.is_visible());
    visible.for_each(|(number, stroke)| {
        let mut along = 0.0;
        for (a, b) in pieces(stroke) {
            let next = along + distance(a.position, b.position);
            let touch = touch_of(a.width.max(b.width));
            ends.near(a.position, b.position, touch, |end| {
                let is_own = end.stroke as usize == number
                    && !stroke.closed
                    && end.arc_from(along, next, lengths[number]) < 4.0 * touch;
                let places = [end.position, a.position, b.position];
                let [place, a, b] = places.map(|[x, y]| Point::new(x, y));
                if !is_own && distance2_to_segment(place, a, b) <= touch * touch {
                    is_met[end.stroke as usize][end.side].store(true, Ordering::Relaxed);
                }
            });
            along = next;
        }
    });

    // Add those at the border.
    let is_cut = |position: [f64; 2]| {
        let side =
            |i: usize| position[i] <= BORDER_PX || position[i] >= f64::from(size[i]) - BORDER_PX;
        side(0) || side(1)
    };
    let all = strokes.iter().zip(is_met);
    all.map(|(stroke, is_met)| {
        let ends = [stroke.points.first(), stroke.points.last()];
        [0, 1].map(|end| {
            is_met[end].load(Ordering::Relaxed)
                || ends[end].is_none_or(|point| is_cut(point.position))
        })
    })
    .collect()
}

/// How far from its middle a line meets ends, in pixels.
fn touch_of(width: f64) -> f64 {
    (0.5 * width).clamp(TOUCH_PX, FARTHEST_TOUCH_PX)
}

/// The straight pieces of a stroke.
fn pieces(stroke: &Stroke) -> impl Iterator<Item = (&StrokePoint, &StrokePoint)> {
    let points = &stroke.points;
    let closing =
        (stroke.closed && points.len() > 1).then(|| (&points[points.len() - 1], &points[0]));
    let open = points.windows(2).map(|pair| (&pair[0], &pair[1]));
    open.chain(closing)
}

/// An end of an open stroke.
#[derive(Debug, Clone, Copy)]
struct End {
    stroke: u32,
    /// 0 for the start, 1 for the end.
    side: usize,
    position: [f64; 2],
}

impl End {
    /// The way along its own stroke, `length` long, to a piece of it.
    fn arc_from(&self, from: f64, to: f64, length: f64) -> f64 {
        match self.side {
            0 => from,
            _ => length - to,
        }
    }
}

/// Width of a cell, in pixels.
const CELL_PX: f64 = 16.0;

/// The ends of strokes by cells of the picture.
struct Ends {
    cells: HashMap<[i32; 2], Vec<End>, FixedState>,
}

impl Ends {
    fn new(strokes: &[Stroke]) -> Self {
        let mut cells: HashMap<[i32; 2], Vec<End>, FixedState> = HashMap::default();
        for (number, stroke) in (0..).zip(strokes) {
            if stroke.closed || !stroke.is_visible() {
                continue;
            }
            let ends = [stroke.points.first(), stroke.points.last()];
            for (side, point) in ends.into_iter().enumerate() {
                if let Some(point) = point {
                    let end = End {
                        stroke: number,
                        side,
                        position: point.position,
                    };
                    cells.entry(cell_of(point.position)).or_default().push(end);
                }
            }
        }
        Self { cells }
    }

    /// Calls `visit` with all ends within `reach` of a straight piece, and with some around; none of pieces that are
    /// not finite.
    fn near(&self, a: [f64; 2], b: [f64; 2], reach: f64, mut visit: impl FnMut(&End)) {
        // Walk along the piece, a cell's width a step.
        let length = distance(a, b);
        if length.is_nan() || length > LONGEST_PX {
            return;
        }
        let steps = (length / CELL_PX).ceil().max(1.0) as usize;
        let at = |step: usize| {
            let share = step as f64 / steps as f64;
            [0, 1].map(|i| a[i] + (b[i] - a[i]) * share)
        };
        for step in 0..steps {
            // Visit the cells that it comes near in this step.
            let (from, to) = (at(step), at(step + 1));
            let low = cell_of([0, 1].map(|i| from[i].min(to[i]) - reach));
            let high = cell_of([0, 1].map(|i| from[i].max(to[i]) + reach));
            for y in low[1]..=high[1] {
                for x in low[0]..=high[0] {
                    let there = self.cells.get(&[x, y]);
                    there.into_iter().flatten().for_each(&mut visit);
                }
            }
        }
    }
}

/// Longest piece of a line, in pixels, that is looked at.
const LONGEST_PX: f64 = 1e6;

fn cell_of(position: [f64; 2]) -> [i32; 2] {
    position.map(|v| (v / CELL_PX).floor() as i32)
}

#[cfg(test)]
mod tests;
