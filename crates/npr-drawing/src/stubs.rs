//! Stubs: short lines with an end in the open, where no other line meets it.
//!
//! A crease that barely reaches its angle shows on a few edges here and there, and the contour of a rough surface in
//! shreds. A draughtsman draws such a fold as a whole or not at all.

use crate::ends::{Meeting, is_cut_off, meetings};
use npr_vector::stroke::Stroke;
use rayon::prelude::*;

/// How far from a line ends meet it, in halves of its width: what smoothing moves apart is within it.
const REACH: f64 = 2.0;

/// Most rounds in which what met stubs alone is a stub too.
const ROUNDS_MOST: usize = 16;

/// Removes the visible open strokes that are stubs, in a picture of `size` pixels: of lines shorter than the pixels
/// that `least_px` gives for their strokes, with an open end, which meets nothing that stays. Strokes of 0 pixels stay.
///
/// A line meets an end that lies within its width; the border of the picture holds ends as lines do. Two strokes whose
/// ends meet and that meet nothing else there are one line, so a long fold in short strokes stays. Stubs go in rounds,
/// 16 at most: what met them alone may be one then. O(strokes log strokes + points), on all threads, with the same
/// result for any number of them.
pub fn remove_stubs(
    strokes: &mut Vec<Stroke>,
    size: [u32; 2],
    least_px: impl Fn(&Stroke) -> f64 + Sync,
) {
    // Choose what may go.
    let lengths: Vec<f64> = strokes.par_iter().map(Stroke::length).collect();
    let least_of = |(stroke, length): (&Stroke, &f64)| {
        let may_go = stroke.is_visible() && !stroke.closed;
        let least_px = least_px(stroke);
        if may_go && *length < least_px {
            least_px
        } else {
            0.0
        }
    };
    let least_px: Vec<f64> = strokes.par_iter().zip(&lengths).map(least_of).collect();
    let is_short: Vec<bool> = least_px.iter().map(|least_px| *least_px > 0.0).collect();
    if !is_short.contains(&true) {
        return;
    }

    // Let stubs go, until there are none.
    let mut net = Net::new(strokes, size, lengths, least_px);
    for _ in 0..ROUNDS_MOST {
        let stubs = net.stubs();
        if stubs.is_empty() {
            break;
        }
        net.remove(&stubs);
    }
    let mut stays = net.stays.into_iter();
    strokes.retain(|_| stays.next().unwrap_or(true));
}

/// Short strokes, and what meets their ends.
struct Net {
    lengths: Vec<f64>,
    /// Of every short stroke the length below which a line is a stub; 0 of others.
    least_px: Vec<f64>,
    stays: Vec<bool>,
    /// Of every short stroke and each of its ends the strokes that stay and meet it; itself where the border does.
    held_by: Vec<[Vec<usize>; 2]>,
}

impl Net {
    fn new(strokes: &[Stroke], size: [u32; 2], lengths: Vec<f64>, least_px: Vec<f64>) -> Self {
        // Find the strokes that meet ends of others.
        let is_met = |found: &Meeting| least_px[found.stroke] > 0.0 && found.with != found.stroke;
        let met = meetings(strokes, &lengths, REACH).filter(is_met);
        let mut met: Vec<_> = met
            .map(|found| (found.stroke, found.side, found.with))
            .collect();
        met.par_sort_unstable();
        met.dedup();

        // Add the border.
        let mut held_by = vec![[Vec::new(), Vec::new()]; strokes.len()];
        for (number, stroke) in strokes
            .iter()
            .enumerate()
            .filter(|(i, _)| least_px[*i] > 0.0)
        {
            let ends = [stroke.points.first(), stroke.points.last()];
            for (side, end) in ends.into_iter().enumerate() {
                if end.is_some_and(|end| is_cut_off(end.position, size)) {
                    held_by[number][side].push(number);
                }
            }
        }
        met.into_iter()
            .for_each(|(stroke, side, with)| held_by[stroke][side].push(with));
        Self {
            stays: vec![true; strokes.len()],
            lengths,
            least_px,
            held_by,
        }
    }

    /// The strokes of all stubs, ascending.
    fn stubs(&self) -> Vec<usize> {
        let ends = (0..self.stays.len()).flat_map(|stroke| [(stroke, 0), (stroke, 1)]);
        let is_open = |(stroke, side): &(usize, usize)| {
            self.least_px[*stroke] > 0.0
                && self.stays[*stroke]
                && self.held_by[*stroke][*side].is_empty()
        };
        let mut stubs: Vec<usize> = ends
            .filter(is_open)
            .filter_map(|end| self.stub_from(end))
            .flatten()
            .collect();
        stubs.sort_unstable();
        stubs.dedup();
        stubs
    }

    /// The strokes of the line that begins with an open end, if it is a stub.
    fn stub_from(&self, end: (usize, usize)) -> Option<Vec<usize>> {
        let (mut stroke, mut side) = end;
        let mut line = vec![stroke];
        let mut length = self.lengths[stroke];
        while length < self.least_px[end.0] {
            let Some(next) = self.beyond(stroke, 1 - side) else {
                return Some(line);
            };
            (stroke, side) = next;
            line.push(stroke);
            length += self.lengths[stroke];
        }
        None
    }

    /// The end of another short stroke that alone goes on where a stroke ends.
    fn beyond(&self, stroke: usize, side: usize) -> Option<(usize, usize)> {
        let [other] = self.held_by[stroke][side][..] else {
            return None;
        };
        let meets_alone = |side: &usize| self.held_by[other][*side] == [stroke];
        let side = (0..2).find(meets_alone)?;
        (other != stroke && self.least_px[other] > 0.0).then_some((other, side))
    }

    fn remove(&mut self, stubs: &[usize]) {
        stubs.iter().for_each(|stub| self.stays[*stub] = false);
        let stays = &self.stays;
        let ends = self.held_by.iter_mut().flatten();
        ends.for_each(|held_by| held_by.retain(|by| stays[*by]));
    }
}

#[cfg(test)]
mod tests;
