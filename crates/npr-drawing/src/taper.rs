//! Strokes that thin out towards their ends, as a pen does that is set down and lifted, and where they are short.
//!
//! An end is free where it meets no other line: where a contour ends in a cusp, a crease runs out, or a line of the
//! file stops. Elsewhere a line goes on or ends on another one, and there a pen is not lifted.

use crate::color_runs::point_between;
use crate::ends::{Meeting, is_cut_off, meetings};
use npr_vector::mesh_lines::run::distance;
use npr_vector::stroke::{Stroke, StrokePoint};
use rayon::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};

/// Steps in which the width changes along a taper.
const STEPS: usize = 12;

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

/// Thins each visible stroke by the taper that `taper_of` gives for it, if any, in a picture of `size` pixels, and
/// removes the specks among them.
///
/// Lengths are along the stroke in the picture, so a taper looks the same from every side. Points are added where the
/// width changes; those that were there stay. Rings have no ends, but may be specks. The stroke's own far side counts
/// as another line. Ends of which `is_lifted` says so thin out whatever they meet. O(points), on all threads, with the
/// same result for any number of them.
pub fn taper_strokes<'a>(
    strokes: &mut Vec<Stroke>,
    size: [u32; 2],
    taper_of: impl Fn(&Stroke) -> Option<&'a Taper> + Sync,
    is_lifted: impl Fn(&Stroke) -> [bool; 2] + Sync,
) {
    // Choose those that thin out.
    let of = |stroke: &Stroke| {
        let taper = taper_of(stroke).filter(|_| stroke.is_visible());
        taper.filter(|taper| !taper.is_none())
    };
    let tapers: Vec<Option<&Taper>> = strokes.par_iter().map(of).collect();
    if tapers.iter().all(Option::is_none) {
        return;
    }

    // Thin the ends, and all of what is short.
    let lengths: Vec<f64> = strokes.par_iter().map(Stroke::length).collect();
    let mut chosen = tapers.iter().flatten();
    let is_met = match chosen.all(|taper| taper.at_all_ends && taper.short_px <= 0.0) {
        true => vec![[false; 2]; strokes.len()],
        false => met_ends(strokes, &lengths, size),
    };
    let ends = lengths.par_iter().zip(is_met).zip(tapers);
    let all = strokes.par_iter_mut().zip(ends);
    let is_left = all.map(|(stroke, ((length, is_met), taper))| {
        let Some(taper) = taper else {
            return true;
        };
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
            let is_lifted = is_lifted(stroke);
            let goes_on = |end: usize| is_met[end] && !taper.at_all_ends && !is_lifted[end];
            let reach = [0, 1].map(|end| match goes_on(end) {
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

/// Half widths of a line within which it meets an end: a pen that stops beside a line is not lifted before it, and
/// where two outlines meet at a corner without touching, tapers would leave the form open.
const MET: f64 = 3.0;

/// For the start and the end of every stroke whether a visible line or the border of the picture meets it.
pub(crate) fn met_ends(strokes: &[Stroke], lengths: &[f64], size: [u32; 2]) -> Vec<[bool; 2]> {
    // Note those that lines pass.
    let is_met: Vec<[AtomicBool; 2]> = strokes.iter().map(|_| Default::default()).collect();
    meetings(strokes, lengths, MET).for_each(|Meeting { stroke, place, .. }| {
        is_met[stroke][place].store(true, Ordering::Relaxed);
    });

    // Add those at the border.
    let all = strokes.iter().zip(is_met);
    all.map(|(stroke, is_met)| {
        let ends = [stroke.points.first(), stroke.points.last()];
        [0, 1].map(|end| {
            is_met[end].load(Ordering::Relaxed)
                || ends[end].is_none_or(|point| is_cut_off(point.position, size))
        })
    })
    .collect()
}

#[cfg(test)]
mod tests;
