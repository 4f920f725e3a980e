//! Strokes cut into dashes and dots.

use crate::arc::{Measured, has_course};
use npr_vector::stroke::Stroke;
use rayon::prelude::*;

/// Shortest pattern, in pixels: finer ones are grey, and lines stay whole.
const SHORTEST_PX: f64 = 0.25;

/// Length, in pixels, of the piece of line that a dot is: its round ends make it one.
const DOT_PX: f64 = 0.1;

/// Distance, in pixels, under which two dashes are one, and under which a dash cut off at an end is none.
const TOO_NEAR_PX: f64 = 1e-3;

/// Most pixels of texture on a pixel of a stroke that are dashed: more of it is a seam between two textures.
const SQUEEZED_MOST: f64 = 2.0;

/// Length of the longest seam that ink goes on through, in pixels.
const SEAM_MOST_PX: f64 = 1.0;

/// How strokes are cut into dashes.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Dash {
    /// Pixels of ink, of gap, of ink and so on; none for whole strokes. Ink without length is a dot. Of an odd number
    /// of lengths ink and gap change places every time, as in SVG.
    pub pattern_px: Vec<f64>,
    /// Whether the pattern is stretched to end where strokes do: open ones then begin and end with half of the first
    /// dash, and rings have a whole number of patterns.
    pub fit: bool,
    /// Whether a pattern that is not stretched lies at multiples of its length in the texture coordinate `u`, so that
    /// dashes hold where `u` does; else it begins where strokes do, unless they are parts of a line, whose pattern goes
    /// on behind what hides it.
    pub by_texture: bool,
}

impl Dash {
    /// Whether it leaves every stroke as it is.
    pub fn is_none(&self) -> bool {
        self.period().is_none()
    }

    /// The pattern as pairs of ink and gap, and its whole length; `None` if there is nothing to cut.
    fn period(&self) -> Option<(Vec<[f64; 2]>, f64)> {
        let twice = self.pattern_px.iter().chain(&self.pattern_px).copied();
        let count = match self.pattern_px.len() % 2 {
            0 => self.pattern_px.len(),
            _ => 2 * self.pattern_px.len(),
        };
        let lengths: Vec<f64> = twice.take(count).collect();
        let pairs: Vec<[f64; 2]> = lengths
            .chunks_exact(2)
            .map(|two| [two[0], two[1]])
            .collect();
        let length: f64 = lengths.iter().sum();
        let is_cut = lengths.iter().all(|px| *px >= 0.0)
            && pairs.iter().any(|[_, gap]| *gap > TOO_NEAR_PX)
            && length >= SHORTEST_PX
            && length.is_finite();
        is_cut.then_some((pairs, length))
    }

    /// Whether a pattern that is not stretched lies on a stroke where its texture does.
    fn lies_by_texture(&self, stroke: &Stroke) -> bool {
        self.by_texture || stroke.part.is_some()
    }

    /// The dashes of a stroke; `None` if it stays whole.
    fn cut(&self, stroke: &Stroke) -> Option<Vec<Stroke>> {
        let (pairs, period) = self.period()?;
        let line = Measured::new(stroke).filter(|line| line.length() >= period)?;
        let inked = match (self.fit, self.lies_by_texture(stroke)) {
            (true, _) => fitted(&pairs, period, &line),
            (false, true) => along_texture(&pairs, period, &line),
            (false, false) => from_start(&pairs, &line),
        };
        let dashes = inked.into_iter().map(|[from, to]| Stroke {
            points: line.part(from, to),
            closed: false,
            part: stroke.part.map(|part| part.alone(to - from)),
            ..*stroke
        });
        Some(dashes.collect())
    }

    /// Most points that a stroke has once [`cut_to_dashes`] has cut it.
    fn points_of(&self, stroke: &Stroke) -> u64 {
        let own = stroke.points.len() as u64;
        let Some((pairs, period)) = self.period().filter(|_| stroke.is_visible()) else {
            return own;
        };
        let length = stroke.length();
        if !has_course(length) {
            return own;
        }
        // Stretched patterns are shorter by a third at most, those along a texture by half.
        let by_texture = self.lies_by_texture(stroke);
        let most = if by_texture { SQUEEZED_MOST } else { 1.5 };
        let periods = (most * length / period) as u64 + 2;
        own + periods * 2 * pairs.len() as u64
    }
}

/// Most points that strokes have once [`cut_to_dashes`] has cut them. O(points).
pub fn points_of_dashes<'a>(
    strokes: &[Stroke],
    dash_of: impl Fn(&Stroke) -> Option<&'a Dash> + Sync,
) -> u64 {
    let of_stroke = |stroke: &Stroke| match dash_of(stroke) {
        Some(dash) => dash.points_of(stroke),
        None => stroke.points.len() as u64,
    };
    strokes.par_iter().map(of_stroke).sum()
}

/// Cuts each visible stroke into the dashes that `dash_of` gives for it, if any; they keep their stroke's id.
///
/// Strokes shorter than the pattern stay whole. Where a dash of a ring goes through its start it is one. Lengths are
/// those of the line's middle: round ends make dashes longer by the line's width, and gaps shorter. O(points + dashes
/// log points), on all threads, with the same result for any number of them.
pub fn cut_to_dashes<'a>(
    strokes: &mut Vec<Stroke>,
    dash_of: impl Fn(&Stroke) -> Option<&'a Dash> + Sync,
) {
    let is_none = |stroke: &Stroke| dash_of(stroke).is_none_or(Dash::is_none);
    if strokes.par_iter().all(is_none) {
        return;
    }
    let all = std::mem::take(strokes).into_par_iter();
    let cut = all.flat_map_iter(|stroke| {
        let dash = dash_of(&stroke).filter(|_| stroke.is_visible());
        let dashes = dash.and_then(|dash| dash.cut(&stroke));
        dashes.unwrap_or_else(|| vec![stroke])
    });
    *strokes = cut.collect();
}

/// Where a line is inked if the pattern is stretched to begin and end in the middle of its first dash.
fn fitted(pairs: &[[f64; 2]], period: f64, line: &Measured) -> Vec<[f64; 2]> {
    let length = line.length();
    let count = (length / period).round().max(1.0);
    let scale = length / (count * period);
    let half = 0.5 * pairs[0][0] * scale;
    let mut inked = Inked::default();
    for number in 0..count as u32 {
        let mut at = length * f64::from(number) / count - half;
        for [ink, gap] in pairs {
            inked.add(at, at + ink * scale);
            at += (ink + gap) * scale;
        }
    }
    if !line.closed {
        inked.add(length - half, length + half);
    }
    inked.on(line)
}

/// Where a line is inked if the pattern begins at its start, and breaks off at its end.
fn from_start(pairs: &[[f64; 2]], line: &Measured) -> Vec<[f64; 2]> {
    let mut inked = Inked::default();
    let mut at = 0.0;
    for [ink, gap] in pairs.iter().cycle() {
        if at > line.length() {
            break;
        }
        inked.add(at, at + ink);
        at += ink + gap;
    }
    inked.on(line)
}

/// Where a line is inked if the pattern begins where its texture coordinate is 0. Ink, or none, goes on through seams
/// between two textures.
fn along_texture(pairs: &[[f64; 2]], period: f64, line: &Measured) -> Vec<[f64; 2]> {
    // Ink each piece by itself.
    let mut ranges: Vec<[f64; 2]> = Vec::new();
    let mut seams: Vec<[f64; 2]> = Vec::new();
    for ([from, to], [start, end]) in line.pieces() {
        let (length, span) = (to - from, end - start);
        let is_even = span.abs() <= SQUEEZED_MOST * length && span != 0.0 && start.abs() < 1e9;
        if !is_even {
            seams.push([from, to]);
            continue;
        }
        let way_of = |u: f64| from + (u - start) / span * length;
        let (low, high) = (start.min(end), start.max(end));
        let mut number = (low / period).floor() - 1.0;
        while number * period < high {
            let mut at = number * period;
            for [ink, gap] in pairs {
                let is_dot = *ink < DOT_PX;
                let [a, b] = [at.max(low), (at + ink).min(high)];
                if a < b || is_dot && low <= at && at < high {
                    let [a, b] = if is_dot { [at, at] } else { [a, b] }.map(way_of);
                    ranges.push([a.min(b), a.max(b)]);
                }
                at += ink + gap;
            }
            number += 1.0;
        }
    }

    // Go on through seams where ink comes up to them.
    for [from, to] in seams {
        let touches =
            |range: &&mut [f64; 2]| (range[1] - from).abs() <= TOO_NEAR_PX && range[1] > range[0];
        if to - from <= SEAM_MOST_PX
            && let Some(range) = ranges.iter_mut().find(touches)
        {
            range[1] = to;
        }
    }
    ranges.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let mut inked = Inked::default();
    ranges.iter().for_each(|[from, to]| inked.add(*from, *to));
    inked.on(line)
}

/// Ranges of ink in order, of which none touches the one before.
#[derive(Debug, Default)]
struct Inked(Vec<[f64; 2]>);

impl Inked {
    fn add(&mut self, from: f64, to: f64) {
        match self.0.last_mut() {
            Some(last) if from <= last[1] + TOO_NEAR_PX => last[1] = last[1].max(to),
            _ => self.0.push([from, to]),
        }
    }

    /// The ranges that lie on a line, dots with a length.
    fn on(mut self, line: &Measured) -> Vec<[f64; 2]> {
        let length = line.length();
        let [low, high] = match line.closed {
            // The first dash of a ring may begin before its start.
            true => [f64::NEG_INFINITY, length],
            false => [0.0, length],
        };

        // Cut off what lies beyond the ends, and give dots a length.
        let mut ranges: Vec<[f64; 2]> = Vec::with_capacity(self.0.len());
        for [from, to] in self.0.drain(..) {
            let is_dot = to - from < DOT_PX;
            let (from, to) = match is_dot {
                true => {
                    let middle = 0.5 * (from + to);
                    let from = (middle - 0.5 * DOT_PX).clamp(low, high - DOT_PX);
                    (from, from + DOT_PX)
                }
                false => (from.max(low), to.min(high)),
            };
            if to - from > TOO_NEAR_PX {
                ranges.push([from, to]);
            }
        }

        // Join the last dash of a ring to the first one.
        if let (true, [first, .., last]) = (line.closed, &mut ranges[..])
            && last[1] + TOO_NEAR_PX >= first[0] + length
        {
            first[0] = last[0] - length;
            ranges.pop();
        }
        ranges
    }
}

#[cfg(test)]
mod tests;
