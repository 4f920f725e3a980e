//! How much the strokes of a sequence change that should only move.
//!
//! A frame's strokes are carried to the next frame by the surface ([`Step`]) and compared with those that are drawn
//! there. Five figures come of it:
//!
//! - **drift**: how far the ends of open strokes lie from the nearest end of the next frame, and how many have none
//! - **slide**: how far the texture coordinate of a sample moves, and how often it jumps
//! - **flicker**: how much of a line that is still to be seen has no ink in the next frame
//! - **blink**: how much of it goes for one frame alone
//! - **jitter**: how far ink lies beside the carried ink

use std::collections::BTreeMap;

use npr_vector::stroke::Kind;

use super::near::{Near, distance};
use super::step::Step;
use super::traced::{Sample, Traced, is_inside};

/// Distance beyond which an end is lost, and slide beyond which a texture pops, in pixels.
pub const JUMP_PX: f64 = 8.0;

/// Most that an end counts as having drifted, in pixels.
const DRIFT_MOST_PX: f64 = 40.0;

/// Distance up to which a sample is that of the frame before, in pixels.
pub const MATCH_PX: f64 = 3.0;

/// Least cosine between the directions of both, whichever way they run.
const MATCH_COS: f64 = 0.7;

/// Least length of a raw line whose ends count, in pixels: shreds come and go all the time, and are not drawn.
const RAW_LEAST_PX: f64 = 16.0;

/// How much farther than the nearest sample one of the same stroke may lie and be taken for it, in pixels: where
/// strokes meet, two lie at one place.
const TIE_PX: f64 = 0.01;

/// Distance from all ink beyond which a sample is gone, in pixels.
pub const GONE_PX: f64 = 6.0;

/// A sample in the next frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Carried {
    /// As it was drawn, with the place and the point in the world where it is carried to.
    pub sample: Sample,
    /// Whether it is carried to a place in the picture.
    pub is_inside: bool,
}

/// A sample that is drawn, and the carried one that it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Match {
    /// Number of the carried sample.
    pub before: usize,
    /// Number of the sample that is drawn.
    pub after: usize,
    /// How far the texture coordinate moved, in pixels, to half of one, as samples are a pixel apart; around closed
    /// strokes the shorter way.
    pub slide: f64,
    /// How far the drawn sample lies to the left of the carried stroke, in pixels.
    pub offset: f64,
}

/// A frame's strokes carried to the next frame, and what of them is there.
#[derive(Debug, Clone, Default)]
pub struct Pair {
    /// The samples, where they are carried to.
    pub carried: Vec<Carried>,
    /// The same by place.
    pub near: Near,
    /// The ends of strokes, likewise; ends that leave the picture are left out. With their numbers.
    pub ends: Vec<(usize, [f64; 2])>,
    /// What is drawn and was drawn before.
    pub matches: Vec<Match>,
    /// Carried samples in the picture that lie beyond [`GONE_PX`] from all ink.
    pub gone: Vec<usize>,
}

impl Pair {
    /// Carries `before` and compares it with `after`. O(samples).
    pub fn new(before: &Traced, after: &Traced, step: &Step<'_>) -> Self {
        // Carry samples and ends.
        let carry = |sample: &Sample| {
            let (place, world) = step.moved(sample.place, sample.world);
            Carried {
                sample: Sample {
                    place,
                    world,
                    ..*sample
                },
                is_inside: is_inside(place, after.size),
            }
        };
        let carried: Vec<Carried> = before.samples.iter().map(carry).collect();

        // Find what is drawn of it.
        let places = carried.iter().map(|carried| carried.sample.place).collect();
        let near = Near::new(places, after.size);
        let gone = (0..carried.len()).filter(|number| {
            let Carried { sample, is_inside } = &carried[*number];
            *is_inside && !after.near.is_near(sample.place, GONE_PX)
        });
        Self {
            ends: carried_ends(before, after.size, step).collect(),
            matches: matches((before, &carried, &near), after),
            gone: gone.collect(),
            near,
            carried,
        }
    }
}

/// The ends of a frame's strokes where they are carried to, with their numbers; those that leave the picture are left
/// out.
fn carried_ends<'a>(
    before: &'a Traced,
    size: [u32; 2],
    step: &'a Step<'_>,
) -> impl Iterator<Item = (usize, [f64; 2])> + 'a {
    let ends = before.ends.iter().enumerate();
    let ends = ends.map(|(number, end)| (number, step.moved(end.place, end.world).0));
    ends.filter(move |(_, place)| is_inside(*place, size))
}

/// For every drawn sample the nearest carried one that runs the same way or the opposite one.
fn matches((before, carried, near): (&Traced, &[Carried], &Near), after: &Traced) -> Vec<Match> {
    let found = after
        .samples
        .iter()
        .enumerate()
        .filter_map(|(number, sample)| {
            // Find the nearest, or one of the same stroke that is as near.
            let line = &after.strokes[sample.stroke];
            let is_along =
                |other: usize| dot(carried[other].sample.along, sample.along).abs() > MATCH_COS;
            let is_own = |other: usize| {
                is_along(other) && before.strokes[carried[other].sample.stroke].id == line.id
            };
            let (nearest, away) = near.nearest(sample.place, MATCH_PX, is_along)?;
            let own = near.nearest(sample.place, away + TIE_PX, is_own);
            let before = own.map_or(nearest, |(own, _)| own);

            // Compare the two.
            let was = &carried[before].sample;
            let slide = (sample.u - was.u).abs();
            let slide = match line.closed && line.length > 0.0 {
                true => {
                    let round = slide.rem_euclid(line.length);
                    round.min(line.length - round)
                }
                false => slide,
            };
            Some(Match {
                before,
                after: number,
                slide,
                offset: offset(was, sample.place),
            })
        });
    found.collect()
}

/// How far textures still slide where every stroke takes over its texture as a whole, in pixels: the way that it runs
/// and the shift that suit most of what it was matched with [Kalnins et al. 2003]. A slide for every match, in their
/// order.
///
/// Only the step from one frame to the next is told: strokes that are joined have one texture from then on.
pub fn voted_slides(before: &Traced, after: &Traced, matches: &[Match]) -> Vec<f64> {
    let mut of_strokes: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for (number, found) in matches.iter().enumerate() {
        let stroke = after.samples[found.after].stroke;
        of_strokes.entry(stroke).or_default().push(number);
    }
    let mut slides = vec![0.0; matches.len()];
    for (stroke, group) in of_strokes {
        // Decide which way the texture runs.
        let pairs = group.iter().map(|number| {
            let found = &matches[*number];
            (&before.samples[found.before], &after.samples[found.after])
        });
        let turns = pairs
            .clone()
            .map(|(was, is)| dot(was.along, is.along).signum());
        let way = if turns.sum::<f64>() < 0.0 { -1.0 } else { 1.0 };

        // Take the shift in the middle; around a ring all are near the first.
        let line = &after.strokes[stroke];
        let shifts: Vec<f64> = pairs.map(|(was, is)| was.u - way * is.u).collect();
        let first = shifts[0];
        let near_first = |shift: f64| match line.closed && line.length > 0.0 {
            true => shift - ((shift - first) / line.length).round() * line.length,
            false => shift,
        };
        let shifts: Vec<f64> = shifts.into_iter().map(near_first).collect();
        let shift = median(shifts.iter().copied());
        for (number, own) in group.into_iter().zip(shifts) {
            slides[number] = (own - shift).abs();
        }
    }
    slides
}

/// How far a place lies to the left of a stroke at a sample of it, in pixels.
pub fn offset(sample: &Sample, place: [f64; 2]) -> f64 {
    let [x, y] = [0, 1].map(|i| place[i] - sample.place[i]);
    // Rows count downwards.
    x * sample.along[1] - y * sample.along[0]
}

/// Product of two directions.
pub fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// What the frames of a sequence add up to.
#[derive(Debug, Clone, Default)]
pub struct Tally {
    /// Pairs of frames.
    pub pairs: usize,
    /// Strokes of every frame after the first.
    pub strokes: Vec<usize>,
    /// How far every end lies from the nearest of the next frame, in pixels.
    pub drifts: Vec<f64>,
    /// Ends of the next frame, and those of them near which none is carried.
    pub born: [usize; 2],
    /// How far every end of raw lines of 16 pixels or more lies from the nearest of the next frame, in pixels.
    pub raw_drifts: Vec<f64>,
    /// Slide of every match, in pixels.
    pub slides: Vec<f64>,
    /// Matches that would pop although strokes took over their textures as a whole.
    pub voted_pops: usize,
    /// The same by the kind of the line that is drawn, for ends of the one that was.
    pub kinds: BTreeMap<Kind, OfKind>,
    /// Matches whose stroke has the same identity in both frames.
    pub same_id: usize,
    /// Samples that were carried to places in the picture.
    pub carried: usize,
    /// Those of them that are gone although a line is still to be drawn there.
    pub flickers: usize,
    /// Those of them that are gone although their point of the surface is still seen.
    pub gone_points: usize,
    /// Samples carried over two frames, and those of them that are gone in the first and there in the second.
    pub blinks: [usize; 2],
    /// Offset of every match, in pixels.
    pub offsets: Vec<f64>,
    /// Sum of how far contours are drawn outside of the line, in pixels, and their samples.
    pub bias: (f64, usize),
}

/// What lines of one kind add up to.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct OfKind {
    /// Matches, those that pop, and those that pop although strokes took over their textures as a whole.
    pub matches: [usize; 3],
    /// Ends, and those of them that are lost.
    pub ends: [usize; 2],
}

/// How to tell what of a frame is still to be seen.
pub struct Due<'a> {
    /// The lines of the frame before anything is joined, smoothed or left out.
    pub raw: &'a Traced,
    /// Whether a point of the surface is seen.
    pub is_seen: &'a dyn Fn(&Sample) -> bool,
}

impl Tally {
    /// Adds a pair of frames.
    pub fn add(&mut self, (before, after): (&Traced, &Traced), pair: &Pair, due: &Due<'_>) {
        self.pairs += 1;
        self.strokes.push(after.strokes.len());

        // Look for every end in the other frame.
        let there: Vec<[f64; 2]> = after.ends.iter().map(|end| end.place).collect();
        let carried: Vec<[f64; 2]> = pair.ends.iter().map(|(_, place)| *place).collect();
        for (number, place) in &pair.ends {
            let away = least_distance(*place, &there);
            let kind = before.strokes[before.ends[*number].stroke].kind;
            let of_kind = self.kinds.entry(kind).or_default();
            of_kind.ends[0] += 1;
            of_kind.ends[1] += usize::from(away > JUMP_PX);
            self.drifts.push(away);
        }
        let born = there
            .iter()
            .filter(|end| least_distance(**end, &carried) > JUMP_PX);
        self.born[1] += born.count();
        self.born[0] += there.len();

        // Add up what is drawn in both.
        self.slides
            .extend(pair.matches.iter().map(|found| found.slide));
        let voted = voted_slides(before, after, &pair.matches);
        for (found, voted) in pair.matches.iter().zip(voted) {
            let kind = after.strokes[after.samples[found.after].stroke].kind;
            let matches = &mut self.kinds.entry(kind).or_default().matches;
            matches[0] += 1;
            matches[1] += usize::from(found.slide > JUMP_PX);
            matches[2] += usize::from(voted > JUMP_PX);
            self.voted_pops += usize::from(voted > JUMP_PX);
        }
        self.offsets
            .extend(pair.matches.iter().map(|found| found.offset));
        let id = |traced: &Traced, sample: &Sample| traced.strokes[sample.stroke].id;
        let is_same = |found: &&Match| {
            id(before, &before.samples[found.before]) == id(after, &after.samples[found.after])
        };
        self.same_id += pair.matches.iter().filter(is_same).count();

        // Add up what is gone and should not be.
        self.carried += pair
            .carried
            .iter()
            .filter(|sample| sample.is_inside)
            .count();
        for number in &pair.gone {
            let sample = &pair.carried[*number].sample;
            self.flickers += usize::from(due.raw.near.is_near(sample.place, MATCH_PX));
            self.gone_points += usize::from((due.is_seen)(sample));
        }
    }

    /// Adds the ends of raw lines, before anything is joined or left out: what the surface and what hides it lose.
    pub fn add_raw_ends(&mut self, before: &Traced, after: &Traced, step: &Step<'_>) {
        let there: Vec<[f64; 2]> = after.ends.iter().map(|end| end.place).collect();
        for (number, place) in carried_ends(before, after.size, step) {
            if before.strokes[before.ends[number].stroke].length >= RAW_LEAST_PX {
                self.raw_drifts.push(least_distance(place, &there));
            }
        }
    }

    /// Adds what is gone in the middle one of three frames alone; `second` carries the samples of the first pair on.
    pub fn add_blinks(&mut self, first: &Pair, second: &Step<'_>, last: &Traced) {
        self.blinks[0] += first.carried.len();
        let is_back = |number: &&usize| {
            let sample = &first.carried[**number].sample;
            let (place, _) = second.moved(sample.place, sample.world);
            is_inside(place, last.size) && last.near.is_near(place, GONE_PX)
        };
        self.blinks[1] += first.gone.iter().filter(is_back).count();
    }

    /// Adds how far the contours of a frame lie outside of its raw ones, which run with the surface to their left.
    pub fn add_bias(&mut self, drawn: &Traced, raw: &Traced) {
        let is_contour =
            |traced: &Traced, sample: &Sample| traced.strokes[sample.stroke].kind == Kind::Contour;
        for sample in drawn
            .samples
            .iter()
            .filter(|sample| is_contour(drawn, sample))
        {
            let fits = |number: usize| {
                let other = &raw.samples[number];
                is_contour(raw, other) && dot(other.along, sample.along).abs() > MATCH_COS
            };
            if let Some((number, _)) = raw.near.nearest(sample.place, MATCH_PX, fits) {
                self.bias.0 -= offset(&raw.samples[number], sample.place);
                self.bias.1 += 1;
            }
        }
    }

    /// Median of how far ends drift, at most 40 pixels each.
    pub fn drift(&self) -> f64 {
        drift_of(&self.drifts)
    }

    /// The same of ends of raw lines.
    pub fn raw_drift(&self) -> f64 {
        drift_of(&self.raw_drifts)
    }

    /// Share of ends that have none within 8 pixels.
    pub fn lost(&self) -> f64 {
        lost_of(&self.drifts)
    }

    /// The same of ends of raw lines.
    pub fn raw_lost(&self) -> f64 {
        lost_of(&self.raw_drifts)
    }

    /// Share of ends of the next frame that had none within 8 pixels.
    pub fn born_share(&self) -> f64 {
        share(self.born[1], self.born[0])
    }

    /// Median slide of the texture coordinate, in pixels.
    pub fn slide(&self) -> f64 {
        median(self.slides.iter().copied())
    }

    /// Share of matches that slide by more than 8 pixels.
    pub fn pop(&self) -> f64 {
        let pops = self.slides.iter().filter(|slide| **slide > JUMP_PX);
        share(pops.count(), self.slides.len())
    }

    /// The same where strokes took over their textures as a whole.
    pub fn voted_pop(&self) -> f64 {
        share(self.voted_pops, self.slides.len())
    }

    /// Share of matches whose stroke keeps its identity.
    pub fn held(&self) -> f64 {
        match self.slides.len() {
            0 => 1.0,
            count => share(self.same_id, count),
        }
    }

    /// Share of samples that are gone although a line is still to be drawn there.
    pub fn flicker(&self) -> f64 {
        share(self.flickers, self.carried)
    }

    /// Share of samples that are gone although their point of the surface is still seen.
    pub fn gone_point_share(&self) -> f64 {
        share(self.gone_points, self.carried)
    }

    /// Share of samples that are gone for one frame alone.
    pub fn blink(&self) -> f64 {
        share(self.blinks[1], self.blinks[0])
    }

    /// Root of the mean squared offset without its mean, in pixels.
    pub fn jitter(&self) -> f64 {
        let count = self.offsets.len().max(1) as f64;
        let mean = self.offsets.iter().sum::<f64>() / count;
        let squares = self.offsets.iter().map(|offset| (offset - mean).powi(2));
        (squares.sum::<f64>() / count).sqrt()
    }

    /// Mean of how far contours are drawn outside of the line, in pixels.
    pub fn mean_bias(&self) -> f64 {
        self.bias.0 / self.bias.1.max(1) as f64
    }

    /// Mean number of strokes of a frame, and its standard deviation.
    pub fn stroke_counts(&self) -> [f64; 2] {
        let count = self.strokes.len().max(1) as f64;
        let mean = self.strokes.iter().sum::<usize>() as f64 / count;
        let squares = self.strokes.iter().map(|n| (*n as f64 - mean).powi(2));
        [mean, (squares.sum::<f64>() / count).sqrt()]
    }

    /// Whether nothing changed at all.
    pub fn is_still(&self) -> bool {
        let is_zero = |values: &[f64]| values.iter().all(|value| *value == 0.0);
        is_zero(&self.drifts)
            && is_zero(&self.slides)
            && is_zero(&self.offsets)
            && [
                self.born[1],
                self.flickers,
                self.gone_points,
                self.blinks[1],
            ] == [0; 4]
            && self.same_id == self.slides.len()
    }
}

fn least_distance(place: [f64; 2], others: &[[f64; 2]]) -> f64 {
    let away = others.iter().map(|other| distance(place, *other));
    away.fold(f64::INFINITY, f64::min)
}

/// A part of a whole; 0 of nothing.
pub fn share(part: usize, whole: usize) -> f64 {
    part as f64 / whole.max(1) as f64
}

/// Median of how far ends drift, at most 40 pixels each.
fn drift_of(drifts: &[f64]) -> f64 {
    median(drifts.iter().map(|away| away.min(DRIFT_MOST_PX)))
}

/// Share of ends that have none within 8 pixels.
fn lost_of(drifts: &[f64]) -> f64 {
    let lost = drifts.iter().filter(|away| **away > JUMP_PX);
    share(lost.count(), drifts.len())
}

/// The middle one of some values, the upper one of two; 0 of none.
fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    let middle = values.len() / 2;
    match values.is_empty() {
        true => 0.0,
        false => *values.select_nth_unstable_by(middle, f64::total_cmp).1,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::testing::{line, ring, ring_from, sheet_moved, stroke, traced};
    use npr_vector::stroke::Stroke;
    use proptest::prelude::*;

    /// Nothing moves.
    fn still() -> Step<'static> {
        Step {
            from: sheet_moved(0.0),
            to: sheet_moved(0.0),
            skin: None,
        }
    }

    /// What two frames add up to where all points are seen, and lines are due where they were.
    fn tally_of(before: &[Stroke], after: &[Stroke], step: &Step<'_>) -> Tally {
        let (before, after) = (traced(before), traced(after));
        let pair = Pair::new(&before, &after, step);
        let due = Due {
            raw: &before,
            is_seen: &|_| true,
        };
        let mut tally = Tally::default();
        tally.add((&before, &after), &pair, &due);
        tally.add_raw_ends(&before, &after, step);
        tally
    }

    /// `count` lines of 100 pixels, 40 pixels apart.
    fn rows(count: usize) -> Vec<Stroke> {
        let row = |i: usize| {
            let y = 40.0 + 40.0 * i as f64;
            line([100.0, y], [200.0, y])
        };
        (0..count).map(row).collect()
    }

    fn shifted(mut stroke: Stroke, by: f64) -> Stroke {
        stroke.points.iter_mut().for_each(|point| point.u += by);
        stroke
    }

    #[test]
    fn what_stays_is_still_to_the_bit() {
        let frame = [rows(5), vec![ring([400.0, 200.0], 61.7)]].concat();
        let tally = tally_of(&frame, &frame, &still());
        assert!(tally.is_still());
        assert_eq!(tally.slides.len(), 5 * 100 + 388);
        let figures = [
            tally.drift(),
            tally.lost(),
            tally.born_share(),
            tally.slide(),
            tally.pop(),
        ];
        let more = [
            tally.flicker(),
            tally.gone_point_share(),
            tally.jitter(),
            tally.mean_bias(),
        ];
        assert_eq!((figures, more, tally.held()), ([0.0; 5], [0.0; 4], 1.0));
    }

    proptest! {
        #[test]
        fn ends_drift_by_as_much_as_they_move(k in 0.0..30.0f64) {
            let grown = line([200.0 - k, 90.0], [400.0 + k, 90.0]);
            let tally = tally_of(&[line([200.0, 90.0], [400.0, 90.0])], &[grown], &still());
            prop_assert!((tally.drift() - k).abs() < 1e-9);
            let is_lost = if k > JUMP_PX { 1.0 } else { 0.0 };
            prop_assert_eq!([tally.lost(), tally.born_share(), tally.flicker()], [is_lost, is_lost, 0.0]);
        }

        #[test]
        fn a_stroke_that_goes_is_lost_and_flickers(count in 2usize..10) {
            let frame = rows(count);
            let without = &frame[1..];
            let tally = tally_of(&frame, without, &still());
            let of_all = 1.0 / count as f64;
            prop_assert_eq!([tally.lost(), tally.raw_lost()], [of_all; 2]);
            prop_assert_eq!([tally.flicker(), tally.gone_point_share()], [of_all; 2]);
            prop_assert_eq!([tally.born_share(), tally.pop(), tally.slide()], [0.0; 3]);
            prop_assert_eq!(tally_of(without, &frame, &still()).born_share(), of_all);
        }

        #[test]
        fn a_texture_slides_by_as_much_as_it_is_shifted(k in 0.0..60.0f64) {
            prop_assume!((k - JUMP_PX).abs() > 1e-6);
            let is_pop = if k > JUMP_PX { 1.0 } else { 0.0 };
            let frame = rows(3);
            let after: Vec<Stroke> = frame.iter().map(|row| shifted(row.clone(), k)).collect();
            let tally = tally_of(&frame, &after, &still());
            prop_assert!((tally.slide() - k).abs() < 1e-9);
            prop_assert_eq!([tally.pop(), tally.lost(), tally.flicker()], [is_pop, 0.0, 0.0]);

            // One of three strokes is a third of the samples.
            let one = [vec![after[0].clone()], frame[1..].to_vec()].concat();
            prop_assert_eq!(tally_of(&frame, &one, &still()).pop(), is_pop / 3.0);
        }

        #[test]
        fn around_a_ring_the_shorter_way_counts(first in 0u32..180) {
            let (middle, radius) = ([300.0, 200.0], 90.0);
            let tally = tally_of(&[ring(middle, radius)], &[ring_from(middle, radius, first)], &still());
            let steps = f64::from(first.min(180 - first));
            let expected = steps * std::f64::consts::TAU * radius / 180.0;
            prop_assert!((tally.slide() - expected).abs() < 1.1, "{} {expected}", tally.slide());
            prop_assert_eq!(tally.drifts.len(), 0);
        }

        #[test]
        fn lines_beside_the_carried_ones_jitter(k in 0.0..2.5f64, count in 1usize..5) {
            let frame = rows(2 * count);
            let to = |i: usize, y: f64| if i.is_multiple_of(2) { y - k } else { y + k };
            let moved = frame.iter().enumerate().map(|(i, row)| {
                let [x, y] = row.points[0].position;
                line([x, to(i, y)], [x + 100.0, to(i, y)])
            });
            let tally = tally_of(&frame, &moved.collect::<Vec<_>>(), &still());
            prop_assert!((tally.jitter() - k).abs() < 1e-9, "{} {k}", tally.jitter());
        }

        #[test]
        fn what_the_camera_moves_is_still(right in -20.0..20.0f64) {
            // Half pixels, so that samples do not lie between two others.
            let right = (2.0 * right).round() / 2.0;
            let step = Step { to: sheet_moved(right), ..still() };
            let frame = rows(4);
            let after: Vec<Stroke> = frame.iter().cloned().map(|mut row| {
                row.points.iter_mut().for_each(|point| point.position[0] += right);
                row
            }).collect();
            let tally = tally_of(&frame, &after, &step);
            prop_assert!(tally.drift() < 1e-6 && tally.slide() < 1e-6 && tally.jitter() < 1e-6);
            prop_assert_eq!([tally.lost(), tally.pop(), tally.flicker()], [0.0; 3]);

            // What stays on the paper drifts.
            let tally = tally_of(&frame, &frame, &step);
            prop_assert!((tally.drift() - right.abs()).abs() < 1e-6);
        }

        #[test]
        fn what_is_hidden_now_does_not_flicker(count in 1usize..6) {
            let (before, after) = (traced(&rows(count)), traced(&[]));
            let pair = Pair::new(&before, &after, &still());
            let due = Due { raw: &after, is_seen: &|_| false };
            let mut tally = Tally::default();
            tally.add((&before, &after), &pair, &due);
            prop_assert_eq!([tally.flicker(), tally.gone_point_share(), tally.lost()], [0.0, 0.0, 1.0]);
        }
    }

    proptest! {
        #[test]
        fn a_vote_takes_over_a_shift_and_the_way(k in 20.0..60.0f64, first in 0u32..180, share in 0.1..0.45f64) {
            // Shifts of whole strokes, rings that start elsewhere, and strokes that run the other way.
            let whole = line([100.0, 90.0], [300.0, 90.0]);
            let back = line([300.0, 90.0], [100.0, 90.0]);
            let before = [whole.clone(), ring([400.0, 300.0], 90.0)];
            let around = ring_from([400.0, 300.0], 90.0, first);
            for after in [[shifted(whole.clone(), k), around.clone()], [back, around]] {
                let tally = tally_of(&before, &after, &still());
                prop_assert_eq!(tally.voted_pop(), 0.0);
            }

            // Of two strokes that are joined the shorter one pops.
            let cut = 100.0 + (200.0 * share).round();
            let parts = [line([100.0, 90.0], [cut, 90.0]), line([cut, 90.0], [300.0, 90.0])];
            let tally = tally_of(&parts, &[whole], &still());
            prop_assert!((tally.voted_pop() - (cut - 100.0) / 200.0).abs() < 0.02);
            prop_assert!((tally.pop() - (300.0 - cut) / 200.0).abs() < 0.02);
        }
    }

    #[test]
    fn what_is_gone_for_a_frame_blinks() {
        let frame = traced(&rows(4));
        let without = traced(&rows(4)[1..]);
        for (last, blink) in [(&frame, 0.25), (&without, 0.0)] {
            let pair = Pair::new(&frame, &without, &still());
            let mut tally = Tally::default();
            tally.add_blinks(&pair, &still(), last);
            assert_eq!(tally.blink(), blink);
        }
    }

    #[test]
    fn a_ring_that_shrinks_is_drawn_inside_of_the_line() {
        // Counter-clockwise to the eye, with the surface inside.
        let around = |radius: f64| {
            let mut ring = ring([300.0, 200.0], radius);
            ring.points.reverse();
            traced(&[ring])
        };
        let mut tally = Tally::default();
        tally.add_bias(&around(99.0), &around(100.0));
        assert!(
            (tally.mean_bias() + 1.0).abs() < 0.02,
            "{}",
            tally.mean_bias()
        );
    }

    #[test]
    fn kinds_are_counted_apart() {
        let of_kind = |kind: Kind, mut stroke: Stroke| {
            stroke.kind = kind;
            stroke
        };
        let [first, second] = [0, 1].map(|i| rows(2)[i].clone());
        let before = [first.clone(), of_kind(Kind::Crease, second.clone())];
        let after = [shifted(first, 20.0), of_kind(Kind::Crease, second)];
        let kinds = tally_of(&before, &after[..1], &still()).kinds;
        let lost = OfKind {
            matches: [0; 3],
            ends: [2, 2],
        };
        let shifted = OfKind {
            matches: [100, 100, 0],
            ends: [2, 0],
        };
        assert_eq!(
            kinds,
            BTreeMap::from([(Kind::Contour, shifted), (Kind::Crease, lost)])
        );
        let kinds = tally_of(&before, &after, &still()).kinds;
        let held = OfKind {
            matches: [100, 0, 0],
            ends: [2, 0],
        };
        assert_eq!(
            kinds,
            BTreeMap::from([(Kind::Contour, shifted), (Kind::Crease, held)])
        );
    }

    #[test]
    fn strokes_that_run_the_other_way_are_the_same_ink() {
        let there = stroke([[200.0, 90.0], [100.0, 90.0]], false);
        let tally = tally_of(&[line([100.0, 90.0], [200.0, 90.0])], &[there], &still());
        assert_eq!([tally.lost(), tally.flicker(), tally.jitter()], [0.0; 3]);
        assert!(tally.pop() > 0.9);
    }
}
