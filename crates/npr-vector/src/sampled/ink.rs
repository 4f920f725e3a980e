//! The ink of what is seen of lines: the twins of `stroke.part_samples` and `stroke.ink_samples`.

use super::{PartWidth, SampledLine, SpineSample};
use crate::ink_point::InkPoint;
use crate::rank::scan::{compact, exclusive_scan};
use npr_core::window::View;
use rayon::prelude::*;

/// How far in front of a line, in sizes of a pixel, lies what makes its end one that meets another line: less is a
/// cusp, where a contour goes behind its own surface and a pen is lifted.
pub const JUNCTION: f32 = 6.0;

/// Number of hidden samples beyond an end that tell what hides the line there.
const BEYOND: u32 = 3;

/// Parts of lines, visible and hidden ones in turns.
#[derive(Debug, Clone, Copy)]
pub struct Parts<'a> {
    /// Whether every sample is visible, 1 or 0.
    pub visible: &'a [u32],
    /// Number of parts that start before every sample.
    pub slots: &'a [u32],
    /// The first sample of every part; behind those of all parts, anything.
    pub firsts: &'a [u32],
}

/// Marks the first sample of every part of a line, 1 or 0. O(samples), parallel.
pub fn part_samples(samples: &[SpineSample], visible: &[u32], starts: &mut [u32]) {
    let indices = starts.par_iter_mut().enumerate().with_min_len(4096);
    indices.for_each(|(index, start)| {
        let before = index.checked_sub(1);
        let goes_on = before.is_some_and(|before| {
            visible[before] == visible[index] && samples[before].line == samples[index].line
        });
        *start = u32::from(!goes_on);
    });
}

/// Writes a point of ink for every two samples, in their order; where the line is hidden it has no width.
///
/// Of two samples that are seen the first becomes the point, but where a part ends with the second, that. So pieces are
/// two steps long, and parts end where their samples do. `gaps` are those of [`see_samples`](super::see_samples). Where
/// parts may have been more before, the last line must be without width: it fills the buffer. O(samples), parallel.
pub fn ink_samples(
    (view, widths): (&View, &[PartWidth]),
    lines: &[SampledLine],
    (samples, gaps): (&[SpineSample], &[f32]),
    parts: &Parts<'_>,
    points: &mut [InkPoint],
) {
    let inking = Inking {
        view,
        widths,
        lines,
        samples,
        gaps,
        parts,
    };
    let indices = points.par_iter_mut().enumerate().with_min_len(1024);
    indices.for_each(|(index, point)| *point = inking.point(index as u32));
}

/// Points of ink of samples of which it is known what is seen: [`part_samples`] and [`ink_samples`] with the steps
/// between them.
pub fn inked(
    of_view: (&View, &[PartWidth]),
    lines: &[SampledLine],
    (samples, gaps): (&[SpineSample], &[f32]),
    visible: &[u32],
) -> Vec<InkPoint> {
    // Find where parts begin.
    let (mut starts, mut firsts) = (vec![0; samples.len()], vec![0; samples.len()]);
    part_samples(samples, visible, &mut starts);
    let (slots, _) = exclusive_scan(&starts);
    compact(&starts, &slots, &mut firsts);

    // Ink them.
    let parts = Parts {
        visible,
        slots: &slots,
        firsts: &firsts,
    };
    let mut points = vec![InkPoint::default(); samples.len() / 2];
    ink_samples(of_view, lines, (samples, gaps), &parts, &mut points);
    points
}

/// A part of a line: its samples.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Part {
    first: u32,
    /// The one after its last.
    end: u32,
}

/// What points of ink are made from.
struct Inking<'a> {
    view: &'a View,
    widths: &'a [PartWidth],
    lines: &'a [SampledLine],
    samples: &'a [SpineSample],
    gaps: &'a [f32],
    parts: &'a Parts<'a>,
}

impl Inking<'_> {
    fn point(&self, index: u32) -> InkPoint {
        // Choose the sample, and see whether the stroke goes on to the next point.
        let Some(sample) = self.chosen(index) else {
            return InkPoint::default();
        };
        let part = self.part_of(sample);
        let next = self.chosen(index + 1);
        let goes_on = next.is_some_and(|next| self.part_of(next) == part);

        // Leave out specks, and what has no width.
        let SpineSample {
            px,
            half_width,
            color,
            depth,
            line,
            ..
        } = self.samples[sample as usize];
        let line = &self.lines[line as usize];
        let length = (part.end - 1 - part.first) as f32 * line.step_px;
        let is_whole = part
            == Part {
                first: line.first,
                end: line.first + line.count,
            };
        let along = (sample - part.first) as f32 * line.step_px;
        let factor = self.factor(line, part, [along, length], is_whole);
        let is_speck = length < line.width(self.widths).speck_px && !is_whole;
        if is_speck || half_width * factor <= 0.0 {
            return InkPoint::default();
        }

        // Lay the image of the brush on it.
        let half_width = half_width * factor;
        let from_start = (sample - line.first) as f32 * line.step_px;
        let u = match line.bits & SampledLine::ONCE != 0 {
            true => along / length.max(1e-6),
            false => line.u_start + from_start * line.u_per_px,
        };
        let flags = if goes_on {
            InkPoint::GOES_ON | InkPoint::JOINED
        } else {
            0
        };
        InkPoint {
            px,
            half_width,
            nearness: self.view.nearness(depth),
            color,
            flags: line.ink_flags | flags,
            u,
            pressure: (half_width / line.full_half_width.max(1e-6))
                .clamp(0.0, 1.0)
                .sqrt(),
        }
    }

    /// The sample that a point stands for; none where both of its samples are hidden.
    fn chosen(&self, index: u32) -> Option<u32> {
        let first = 2 * index;
        let second = first + 1;
        if second as usize >= self.samples.len() {
            return None;
        }
        let is_seen = |sample: u32| self.parts.visible[sample as usize] != 0;
        match [first, second].map(is_seen) {
            [true, true] => {
                // A part that ends here ends with its last sample; one that also begins here is a speck.
                let part = self.part_of(second);
                let ends = part.end == second + 1 && part.first < first;
                Some(if ends { second } else { first })
            }
            [true, false] => Some(first),
            [false, true] => Some(second),
            [false, false] => None,
        }
    }

    fn part_of(&self, sample: u32) -> Part {
        // As many parts start before the sample; it may itself start one.
        let parts = self.parts;
        let before = parts.slots[sample as usize] as usize;
        let part = match parts.firsts.get(before) == Some(&sample) {
            true => before,
            false => before - 1,
        };
        let first = parts.firsts[part];
        let line = &self.lines[self.samples[sample as usize].line as usize];
        let line_end = line.first + line.count;
        // Behind the last part there is none.
        let next = parts.firsts.get(part + 1).filter(|next| **next > first);
        Part {
            first,
            end: next.map_or(line_end, |next| line_end.min(*next)),
        }
    }

    /// Factor on the width at a place `along` a part of a `length`, in pixels.
    fn factor(
        &self,
        line: &SampledLine,
        part: Part,
        [along, length]: [f32; 2],
        is_whole: bool,
    ) -> f32 {
        // Thin out what is short and meets no other line.
        let width = line.width(self.widths);
        let is_ring = is_whole && line.bits & SampledLine::CLOSED != 0;
        let free = self.free_ends(line, part);
        let is_alone = is_ring || free == [true; 2];
        let mut factor = 1.0;
        if is_alone && length < width.short_px {
            factor = (2.0 * length / width.short_px - 1.0).max(0.0);
        }
        if is_ring {
            return factor;
        }

        // Thin out free ends: steep at the tip, even where the taper ends.
        let most = width.taper_share.min(0.5) * length;
        let ends = free
            .into_iter()
            .zip(width.taper_px)
            .zip([along, length - along]);
        let taper = ends.map(|((is_free, px), from_end)| {
            let reach = px.min(most);
            if reach <= 0.0 || !(is_free || width.at_all_ends != 0) {
                return 1.0;
            }
            let share = (from_end / reach).clamp(0.0, 1.0);
            width.tip + (1.0 - width.tip) * share * (2.0 - share)
        });
        let taper = taper.fold(1.0, f32::min);

        // Press along the part.
        let place = (along / length.max(1e-6)).clamp(0.0, 1.0) * 31.0;
        let stop = (place as u32).min(30);
        let height = |stop: u32| width.along[(stop / 4) as usize][(stop % 4) as usize];
        let pressed = height(stop) + (height(stop + 1) - height(stop)) * (place - stop as f32);
        factor * taper * pressed
    }

    /// Whether no other line meets the start and the end of a part: where it is hidden from there on, what hides it
    /// lies close by.
    fn free_ends(&self, line: &SampledLine, part: Part) -> [bool; 2] {
        let line_end = line.first + line.count;
        let gap = |from: u32, to: u32| {
            let gaps = &self.gaps[from as usize..to as usize];
            gaps.iter().fold(0.0, |most: f32, gap| most.max(*gap))
        };
        let start = match part.first == line.first {
            true => line.bits & SampledLine::START_FREE != 0,
            false => gap(part.first - BEYOND.min(part.first - line.first), part.first) < JUNCTION,
        };
        let end = match part.end == line_end {
            true => line.bits & SampledLine::END_FREE != 0,
            false => gap(part.end, (part.end + BEYOND).min(line_end)) < JUNCTION,
        };
        [start, end]
    }
}

#[cfg(test)]
mod tests;
