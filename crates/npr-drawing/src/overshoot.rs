//! Strokes whose ends run on beyond where the line ends, as construction lines do, or stop short of it.

use crate::arc::Measured;
use crate::ends::is_cut_off;
use crate::seed::Seed;
use npr_vector::stroke::Stroke;
use rayon::prelude::*;

/// Greatest share of a stroke's length by which an end runs on: what is short stays short.
const LONGEST_SHARE: f64 = 0.12;

/// Greatest share of a stroke's length by which an end stops short, so that a third of it is left.
const SHORT_SHARE: f64 = 1.0 / 3.0;

/// Least share of the lengths asked for.
const LEAST_SHARE: f64 = 0.5;

/// How far ends of strokes lie from the ends of their lines.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Overshoot {
    /// Most pixels by which an end runs on.
    pub beyond_px: f64,
    /// Most pixels by which an end stops short; where ends may do both, chance decides for each.
    pub short_px: f64,
}

impl Overshoot {
    /// Whether it leaves every stroke as it is.
    pub fn is_none(&self) -> bool {
        !(self.beyond_px > 0.0 || self.short_px > 0.0)
    }

    /// Pixels by which an end of a stroke `length` long runs on, or stops short where they are negative.
    fn of_end(&self, seed: Seed, end: u32, length: f64) -> f64 {
        let share = seed.between(2 * end, LEAST_SHARE, 1.0);
        let may_do_both = self.beyond_px > 0.0 && self.short_px > 0.0;
        let is_short = match may_do_both {
            true => seed.share(2 * end + 1) < 0.5,
            false => self.short_px > 0.0,
        };
        match is_short {
            true => -(self.short_px * share).min(length * SHORT_SHARE),
            false => (self.beyond_px * share).min(length * LONGEST_SHARE),
        }
    }
}

/// Moves the ends of the visible open strokes for which `overshoot_of` gives an overshoot, in a picture of `size`
/// pixels.
///
/// Each end by its own share of the lengths asked for, at least half of them, which the stroke's id decides; by an
/// eighth of its stroke's length at most, or a third where it stops short. An end runs on straight, the way that the
/// line's last pixels go. Ends that the picture's border cuts off stay. O(points), on all threads, with the same result
/// for any number of them.
pub fn move_ends<'a>(
    strokes: &mut [Stroke],
    size: [u32; 2],
    overshoot_of: impl Fn(&Stroke) -> Option<&'a Overshoot> + Sync,
) {
    let moved = strokes.par_iter_mut().filter_map(|stroke| {
        let is_open = !stroke.closed && stroke.is_visible();
        let overshoot = overshoot_of(stroke).filter(|overshoot| is_open && !overshoot.is_none());
        Some((stroke, overshoot?))
    });
    moved.for_each(|(stroke, overshoot)| {
        if let Some(line) = Measured::new(stroke) {
            let seed = Seed::new(stroke.id, 0);
            let ends = [stroke.points.first(), stroke.points.last()];
            let by = [0, 1].map(|end| match ends[end] {
                Some(point) if !is_cut_off(point.position, size) => {
                    overshoot.of_end(seed, end as u32, line.length())
                }
                _ => 0.0,
            });
            stroke.points = line.with_ends(by);
        }
    });
}

#[cfg(test)]
mod tests;
