//! Strokes as a hand draws them: they sway a little, and are drawn more than once.
//!
//! A stroke sways by a smooth function of the way along it and of its line's id, so it holds still from run to run.
//! Sideways and along: displacements are vectors, not distances along a normal, so corners stay as sharp as they are.

use crate::arc::{Measured, has_course, measure_open};
use crate::ends::{Meeting, meetings};
use crate::seed::Seed;
use npr_vector::stroke::{Stroke, StrokePoint};
use rayon::prelude::*;

/// Shortest wave, in pixels.
const SHORTEST_WAVE_PX: f64 = 4.0;

/// Points of a wave: between two of them a curve and its chord differ by about a hundredth of the sway.
const STEPS_PER_WAVE: f64 = 50.0;

/// Least distance between points that are added, in pixels.
const LEAST_STEP_PX: f64 = 0.5;

/// Knots of a wave: a cubic B-spline over white noise is 0 every 2.7 knots in the mean, and twice a wave; the finer
/// sway adds a few zeros.
const KNOTS_PER_WAVE: f64 = 5.0;

/// Share of the finer sway, which is half as long.
const FINE_SHARE: f64 = 0.15;

/// How much stronger the mean of knots is made: without it a line hardly ever comes near its greatest sway.
const GAIN: f64 = 2.0;

/// Greatest sway as a share of a stroke's length: small rings stay rings.
const SWAY_SHARE: f64 = 1.0 / 16.0;

/// Greatest spread of copies as a share of a stroke's length.
const SPREAD_SHARE: f64 = 0.125;

/// Least share of the spread by which an end of a copy lies beside the line's.
const LEAST_SPREAD: f64 = 0.3;

/// By how many times the spread a copy begins and ends elsewhere, at most.
const END_SPREADS: f64 = 3.0;

/// By how many times the spread a copy of a ring runs on past its start, at most.
const OVERLAP_SPREADS: f64 = 10.0;

/// By how many times half its width a line takes ends along: creases stop two or three pixels before the outline that
/// they run into, which nobody sees until it sways.
const REACH: f64 = 3.0;

/// Greatest way that the texture of a copy is ahead of its line's, in pixels: more than any image of a brush is long.
const AHEAD_PX: f64 = 4096.0;

/// The number of the chance that decides it; those of ends and of the sway are others.
const AHEAD_NUMBER: u32 = u32::MAX;

/// Farthest from where its texture begins that a line starts and sways by it, in pixels.
const FARTHEST_PX: f64 = 1e7;

/// Most copies of a stroke.
pub const COPIES_MAX: u32 = 8;

/// How a hand draws strokes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hand {
    /// Greatest distance, in pixels, that a line sways from its place.
    pub wobble_px: f64,
    /// About how long its waves are, in pixels.
    pub wave_px: f64,
    /// How often a line is drawn, 1..[`COPIES_MAX`].
    pub copies: u32,
    /// Greatest distance, in pixels, of copies from the line, before they sway.
    pub spread_px: f64,
    /// Whether an open line sways by where its texture coordinate `u` is 0, so that its waves hold where `u` does; else
    /// by where it starts, unless it is a part of a line, whose waves go on behind what hides it.
    pub by_texture: bool,
}

impl Hand {
    /// Whether it leaves every stroke as it is.
    pub fn is_none(&self) -> bool {
        !self.sways() && self.copies <= 1
    }

    fn sways(&self) -> bool {
        self.wobble_px > 0.0 && self.wobble_px.is_finite() && self.wave_px > 0.0
    }

    fn copies(&self) -> u32 {
        self.copies.clamp(1, COPIES_MAX)
    }

    /// Greatest distance between points of a stroke that sways.
    fn step(&self) -> f64 {
        (self.wave() / STEPS_PER_WAVE).max(LEAST_STEP_PX)
    }

    fn wave(&self) -> f64 {
        self.wave_px.max(SHORTEST_WAVE_PX)
    }

    /// Most points that a stroke has once [`draw_by_hand`] has drawn it.
    fn points_of(&self, stroke: &Stroke) -> u64 {
        let own = stroke.points.len() as u64;
        if self.is_none() || !stroke.is_visible() {
            return own;
        }
        let length = stroke.length();
        if !has_course(length) {
            return own;
        }
        let added = match self.sways() {
            // A copy is longer than its stroke by a quarter at most.
            true => (1.25 * length / self.step()) as u64,
            false => 0,
        };
        u64::from(self.copies()) * (2 * own + added + 4)
    }
}

/// Most points that strokes have once [`draw_by_hand`] has drawn them. O(points).
pub fn points_by_hand<'a>(
    strokes: &[Stroke],
    hand_of: impl Fn(&Stroke) -> Option<&'a Hand> + Sync,
) -> u64 {
    let of_stroke = |stroke: &Stroke| match hand_of(stroke) {
        Some(hand) => hand.points_of(stroke),
        None => stroke.points.len() as u64,
    };
    strokes.par_iter().map(of_stroke).sum()
}

/// Draws each visible stroke as the hand that `hand_of` gives for it does, if any; each is followed by its copies.
///
/// The first of them is the line itself. Where it ends on another line it follows that line's sway, and other ends stay
/// where they are, so lines that meet still do; a ring comes back to its start. Copies lie beside it, each a little
/// turned and stretched, begin and end elsewhere, also in the image of a brush, and sway for themselves; those of rings
/// are open, and run on past where they began. All keep the stroke's id. What a short stroke sways and spreads is
/// limited by its length. O(points + points added + meetings of lines), on all threads, with the same result for any
/// number of them.
pub fn draw_by_hand<'a>(
    strokes: &mut Vec<Stroke>,
    hand_of: impl Fn(&Stroke) -> Option<&'a Hand> + Sync,
) {
    // Choose those that a hand draws.
    let of = |stroke: &Stroke| {
        let hand = hand_of(stroke).filter(|_| stroke.is_visible());
        hand.filter(|hand| !hand.is_none())
    };
    let hands: Vec<Option<&Hand>> = strokes.par_iter().map(of).collect();
    if hands.iter().all(Option::is_none) {
        return;
    }

    // Settle how each line sways, and how far its ends go with the lines that they end on.
    let lengths: Vec<f64> = strokes.par_iter().map(Stroke::length).collect();
    let sways: Vec<Option<Sway>> = strokes
        .par_iter()
        .zip(&lengths)
        .zip(&hands)
        .map(|((stroke, length), hand)| {
            let hand = hand.filter(|hand| hand.sways() && has_course(*length))?;
            let seed = Seed::new(stroke.line(), 0);
            let by_texture = hand.by_texture || stroke.part.is_some();
            let first = stroke.points.first().filter(|_| by_texture);
            let from = first.map_or(0.0, |first| first.u);
            Some(Sway::new(hand, (from, *length), seed, stroke.closed))
        })
        .collect();
    let ends = match sways.iter().any(Option::is_some) {
        true => moved_ends(strokes, &lengths, &sways),
        false => vec![[[0.0; 2]; 2]; strokes.len()],
    };

    // Draw them.
    let of_strokes = sways.into_par_iter().zip(ends).zip(hands);
    let all = std::mem::take(strokes).into_par_iter().zip(of_strokes);
    let drawn = all.flat_map_iter(|(stroke, ((sway, ends), hand))| {
        let measured = hand.and_then(|hand| Some((hand, Measured::new(&stroke)?)));
        let Some((hand, line)) = measured else {
            return vec![stroke];
        };
        let copies = (1..hand.copies()).filter_map(|copy| hand.copy(&stroke, &line, copy));
        let copies: Vec<Stroke> = copies.collect();
        let own = sway.map(|sway| hand.line(&stroke, &line, (&sway, ends)));
        std::iter::once(own.unwrap_or(stroke))
            .chain(copies)
            .collect()
    });
    *strokes = drawn.collect();
}

/// By how much the start and the end of every stroke move with the line that they end on.
///
/// Of the lines that meet an end the nearest counts, at a place where it does not end itself.
fn moved_ends(strokes: &[Stroke], lengths: &[f64], sways: &[Option<Sway>]) -> Vec<[[f64; 2]; 2]> {
    let found: Vec<Meeting> = meetings(strokes, lengths, REACH).collect();
    let mut nearest: Vec<[Option<Meeting>; 2]> = vec![[None; 2]; strokes.len()];
    for meeting in found {
        let from_end = meeting.way.min(lengths[meeting.with] - meeting.way);
        let goes_on = strokes[meeting.with].closed || from_end > meeting.distance.max(1.0);
        let of_end = &mut nearest[meeting.stroke][meeting.place];
        if goes_on && of_end.is_none_or(|last| meeting.distance < last.distance) {
            *of_end = Some(meeting);
        }
    }
    let by = |meeting: Option<Meeting>| {
        let of_line = meeting.and_then(|met| Some((sways[met.with].as_ref()?, met.way)));
        of_line.map_or([0.0; 2], |(sway, way)| sway.between_ends(way))
    };
    nearest.into_iter().map(|ends| ends.map(by)).collect()
}

impl Hand {
    /// The line itself, which sways between its ends; these move by so much.
    fn line(
        &self,
        stroke: &Stroke,
        line: &Measured,
        (sway, ends): (&Sway, [[f64; 2]; 2]),
    ) -> Stroke {
        let moved = |(way, point): (f64, StrokePoint)| {
            let by = sway.between_ends(way);
            let of_ends = [way, line.length() - way].map(|from| 1.0 - sway.share(from));
            let with_ends = |i: usize| by[i] + of_ends[0] * ends[0][i] + of_ends[1] * ends[1][i];
            moved_by(point, [0, 1].map(with_ends))
        };
        let points = line.in_steps(self.step());
        Stroke {
            points: points.into_iter().map(moved).collect(),
            ..*stroke
        }
    }

    /// Copy number `copy`, from 1; `None` where nothing of it is left.
    fn copy(&self, stroke: &Stroke, line: &Measured, copy: u32) -> Option<Stroke> {
        let seed = Seed::new(stroke.id, copy);
        let length = line.length();
        // No number is no spread.
        let spread = self.spread_px.max(0.0).min(SPREAD_SHARE * length);

        // Begin and end elsewhere.
        let points = if line.closed {
            let start = seed.share(0) * length;
            let longest = (OVERLAP_SPREADS * spread).min(SPREAD_SHARE * length);
            let points = line.part(start, length + start);
            let ring = measure_open(points)?;
            // What runs on is the ring's own beginning once more.
            let overlap = ring.part(0.0, seed.between(1, 0.2, 1.0) * longest);
            let round = ring.at(length).u - ring.at(0.0).u;
            let mut points = ring.part(0.0, length);
            points.extend(overlap.into_iter().skip(1).map(|point| StrokePoint {
                u: point.u + round,
                ..point
            }));
            points
        } else {
            let longest = (END_SPREADS * spread).min(SPREAD_SHARE * length);
            line.with_ends([0, 1].map(|end| seed.between(end, -longest, longest)))
        };
        let course = measure_open(points)?;

        // Lay it beside the line, and let it sway.
        let sway = self
            .sways()
            .then(|| Sway::new(self, (0.0, course.length()), seed, false));
        let beside = [2, 4].map(|number| {
            let far = spread * seed.between(number, LEAST_SPREAD, 1.0);
            seed.direction(number + 1).map(|part| part * far)
        });
        let step = match sway.is_some() {
            true => self.step(),
            false => f64::INFINITY,
        };
        let ahead = AHEAD_PX * seed.share(AHEAD_NUMBER);
        let moved = |(way, mut point): (f64, StrokePoint)| {
            point.u += ahead;
            let share = (way / course.length()).clamp(0.0, 1.0);
            let sway = sway.as_ref().map_or([0.0; 2], |sway| sway.at(way));
            let by = [0, 1].map(|i| beside[0][i] * (1.0 - share) + beside[1][i] * share + sway[i]);
            moved_by(point, by)
        };
        Some(Stroke {
            points: course.in_steps(step).into_iter().map(moved).collect(),
            closed: false,
            ..*stroke
        })
    }
}

fn moved_by(point: StrokePoint, by: [f64; 2]) -> StrokePoint {
    StrokePoint {
        position: [0, 1].map(|i| point.position[i] + by[i]),
        ..point
    }
}

/// Smooth step from 0 to 1 over 0..1.
fn ease(share: f64) -> f64 {
    let t = share.clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// How a line sways along itself: a uniform cubic B-spline over random vectors of length 1, and a finer one.
///
/// It lies within the hull of its vectors, so it never leaves the unit circle, and turns without a kink.
#[derive(Debug)]
struct Sway {
    px: f64,
    length: f64,
    /// Pixels from an end over which the line comes to sway; none of rings.
    fade: Option<f64>,
    coarse: Spline,
    fine: Spline,
}

/// The number of the first knot's chance: those before are taken for ends.
const FIRST_KNOT: u32 = 16;

impl Sway {
    /// That of a stroke `length` long, which starts at `from` in its waves; with `comes_back` it ends as it began,
    /// and starts where they do.
    fn new(hand: &Hand, (from, length): (f64, f64), seed: Seed, comes_back: bool) -> Self {
        let spacing = hand.wave() / KNOTS_PER_WAVE;
        let from = if from.abs() < FARTHEST_PX { from } else { 0.0 };
        let coarse = Spline::new((from, length), spacing, seed, (0, comes_back));
        let fine = Spline::new((from, length), 0.5 * coarse.spacing, seed, (1, comes_back));
        Self {
            px: hand.wobble_px.min(SWAY_SHARE * length),
            length,
            fade: (!comes_back).then(|| 0.5 * hand.wave().min(length)),
            coarse,
            fine,
        }
    }

    /// Share of the sway at a distance from an end, along the line.
    fn share(&self, from_end: f64) -> f64 {
        self.fade.map_or(1.0, |fade| ease(from_end / fade))
    }

    /// As [`Sway::at`], but none at the ends of a line.
    fn between_ends(&self, way: f64) -> [f64; 2] {
        let share = self.share(way.min(self.length - way));
        self.at(way).map(|px| px * share)
    }

    /// The displacement, in pixels, `way` pixels from the start; shorter than the greatest sway.
    fn at(&self, way: f64) -> [f64; 2] {
        let (coarse, fine) = (self.coarse.at(way), self.fine.at(way));
        let mix = |i: usize| GAIN * (coarse[i] * (1.0 - FINE_SHARE) + fine[i] * FINE_SHARE);
        let strong = [mix(0), mix(1)];
        // What lies far out is pressed into the circle.
        let pressed = (1.0 + strong[0] * strong[0] + strong[1] * strong[1]).sqrt();
        strong.map(|part| self.px * part / pressed)
    }
}

/// A uniform cubic B-spline over random vectors of length 1.
#[derive(Debug)]
struct Spline {
    /// Pixels from knot to knot.
    spacing: f64,
    /// Pixels from the first knot to the start.
    before: f64,
    knots: Vec<[f64; 2]>,
}

impl Spline {
    fn new(
        (from, length): (f64, f64),
        spacing: f64,
        seed: Seed,
        (octave, comes_back): (u32, bool),
    ) -> Self {
        // A ring has a whole number of knots, and the first at its start.
        let [first, before] = match comes_back {
            true => [0.0; 2],
            false => [(from / spacing).floor(), from.rem_euclid(spacing)],
        };
        let count = match comes_back {
            true => (length / spacing).round().max(3.0),
            false => ((before + length) / spacing).ceil() + 1.0,
        };
        let spacing = match comes_back {
            true => length / count,
            false => spacing,
        };
        // Three more than there are spaces, which of a ring are the first ones again.
        let count = count as u32;
        let knot = |i: u32| {
            let number = if comes_back { i % count } else { i };
            let number = number.wrapping_add(first as i64 as u32);
            seed.direction(number.wrapping_mul(2).wrapping_add(FIRST_KNOT + octave))
        };
        Self {
            spacing,
            before,
            knots: (0..count + 3).map(knot).collect(),
        }
    }

    fn at(&self, way: f64) -> [f64; 2] {
        let place = ((self.before + way) / self.spacing).max(0.0);
        let first = (place as usize).min(self.knots.len() - 4);
        let t = (place - first as f64).clamp(0.0, 1.0);
        let s = 1.0 - t;
        let weights = [
            s * s * s / 6.0,
            (3.0 * t * t * t - 6.0 * t * t + 4.0) / 6.0,
            (3.0 * s * s * s - 6.0 * s * s + 4.0) / 6.0,
            t * t * t / 6.0,
        ];
        let knots = &self.knots[first..first + 4];
        let part = |i: usize| {
            let weighted = weights.iter().zip(knots).map(|(w, knot)| w * knot[i]);
            weighted.sum()
        };
        [part(0), part(1)]
    }
}

#[cfg(test)]
mod tests;
