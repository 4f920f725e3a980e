//! The line through the middle of an open strip.
//!
//! The border of a strip is one loop: a side there, the tip, a side back, the root. Folded together at root and tip,
//! its sides come to lie on each other, as near as the strip is wide; folded anywhere else they lie far apart. So the
//! ends are where the folded sides are nearest, and the line runs half way between places at equal shares of both
//! sides' lengths. A blunt end, at which the border turns twice, lies half way between its two corners. What lies
//! between the sides does not count: a strip may have several columns, and bend across.

use super::piece::{Piece, area_within, finished, length_of};
use crate::card_lines::CardPoint;
use glam::DVec3;

/// Places along the sides at which their distance is measured.
const SAMPLES: u32 = 24;

/// How far an end may lie from the one opposite the other end, as a share of the whole border: the outer side of a bend
/// is longer than the inner one.
const REACH: f64 = 0.125;

/// Rounds in which both ends are settled in turn.
const ROUNDS: u32 = 3;

/// Most times that one side may be as long as the other. A branch makes its side longer, by twice its length.
const SIDES_MOST: f64 = 2.0;

/// Cosine of the least angle by which the border turns at a corner of a blunt end: 45 degrees.
const TURN_COSINE: f64 = 0.707;

/// Share of the way from an end at which the width near that end is measured.
const NEAR_END: f64 = 0.1;

/// Places of both sides nearer than this are one, as a share of the mean distance of corners.
const SAME: f64 = 0.25;

/// Most that the line may cover of the paper, in areas of the faces: between the arms of a fork there are none.
const COVER_MOST: f64 = 1.1;

/// Least that it may cover: faces that bend across or twist have more area than the line between their sides.
const COVER_LEAST: f64 = 0.5;

/// A loop of a border, measured from its first corner.
struct Border {
    places: Vec<DVec3>,
    vertices: Vec<u32>,
    /// Way along it to every corner, and at the end its whole length.
    ways: Vec<f64>,
}

/// The two ends of a strip, as ways along its border.
#[derive(Clone, Copy)]
struct Ends {
    from: f64,
    to: f64,
}

/// How much a share of the way counts.
type Weight = fn(f64) -> f64;

/// The line through the middle of a piece with one border; `None` where it is no strip that is long for its width.
pub(super) fn line(piece: &Piece<'_>, corners: &[u32]) -> Option<Vec<CardPoint>> {
    let border = Border::new(piece, corners);
    if !(border.length() > 0.0 && border.length().is_finite()) {
        return None;
    }
    let ends = border.ends();
    let [there, back] = border.side_lengths(ends);
    if there.max(back) > SIDES_MOST * there.min(back) {
        return None;
    }
    let points = finished(border.middle(ends))?;

    // See whether it covers what the faces cover.
    let covered = area_within(&points, [0.0, length_of(&points)]);
    let area = piece.area();
    (covered <= COVER_MOST * area && covered >= COVER_LEAST * area).then_some(points)
}

impl Border {
    fn new(piece: &Piece<'_>, corners: &[u32]) -> Self {
        let places: Vec<DVec3> = corners.iter().map(|vertex| piece.point(*vertex)).collect();
        let mut way = 0.0;
        let mut ways = vec![0.0];
        for (index, place) in places.iter().enumerate() {
            way += place.distance(places[(index + 1) % places.len()]);
            ways.push(way);
        }
        Self {
            places,
            vertices: corners.to_vec(),
            ways,
        }
    }

    fn length(&self) -> f64 {
        self.ways[self.places.len()]
    }

    /// The corner before a way along the loop, and the share of the way from there to the next.
    fn at(&self, way: f64) -> (usize, f64) {
        let way = way.rem_euclid(self.length());
        let after = self.ways.partition_point(|corner| *corner <= way);
        let before = after.saturating_sub(1).min(self.places.len() - 1);
        let step = self.ways[before + 1] - self.ways[before];
        let share = if step > 0.0 {
            (way - self.ways[before]) / step
        } else {
            0.0
        };
        (before, share.clamp(0.0, 1.0))
    }

    fn place(&self, way: f64) -> DVec3 {
        let (before, share) = self.at(way);
        let next = self.places[(before + 1) % self.places.len()];
        self.places[before].lerp(next, share)
    }

    /// The corner nearest to a way along the loop.
    fn vertex(&self, way: f64) -> u32 {
        let (before, share) = self.at(way);
        let nearest = if share < 0.5 { before } else { before + 1 };
        self.vertices[nearest % self.vertices.len()]
    }

    /// Lengths of the sides, from the first end on and back.
    fn side_lengths(&self, ends: Ends) -> [f64; 2] {
        let there = (ends.to - ends.from).rem_euclid(self.length());
        [there, self.length() - there]
    }

    /// Places on both sides at a share of the way between the ends.
    fn pair(&self, ends: Ends, share: f64) -> [DVec3; 2] {
        let [there, back] = self.side_lengths(ends);
        [ends.from + share * there, ends.from - share * back].map(|way| self.place(way))
    }

    /// How far the sides lie apart: a sum of squares, each with the weight of its share.
    fn distance(&self, ends: Ends, weight: Weight) -> f64 {
        let shares = (0..SAMPLES).map(|k| (f64::from(k) + 0.5) / f64::from(SAMPLES));
        let squares = shares.map(|share| {
            let [a, b] = self.pair(ends, share);
            weight(share) * a.distance_squared(b)
        });
        squares.sum()
    }

    /// Where an end may lie: corners, and the middles between them.
    fn candidates(&self) -> impl Iterator<Item = f64> + '_ {
        let middles = self.ways.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
        let corners = self.ways[..self.places.len()].iter().copied();
        corners.chain(middles)
    }

    /// The ends between which the sides are nearest.
    fn ends(&self) -> Ends {
        // Look for two ends half of the border apart.
        let length = self.length();
        let opposite = self.candidates().map(|from| Ends {
            from,
            to: (from + 0.5 * length).rem_euclid(length),
        });
        let start = Ends {
            from: 0.0,
            to: 0.5 * length,
        };
        let mut best = self.nearest(start, opposite, |_| 1.0);

        // Settle each for itself, by the sides nearest to it: what is off at the other end is settled there.
        for _ in 0..ROUNDS {
            let middle = best.from + 0.5 * length;
            let near = |way: &f64, of: f64| {
                let apart = (way - of).rem_euclid(length);
                apart.min(length - apart) <= REACH * length
            };
            let tips = self.candidates().filter(|to| near(to, middle));
            let tips = tips.map(|to| Ends { to, ..best });
            best = self.nearest(best, tips, |share| share * share);
            let middle = best.to + 0.5 * length;
            let roots = self.candidates().filter(|from| near(from, middle));
            let roots = roots.map(|from| Ends { from, ..best });
            best = self.nearest(best, roots, |share| (1.0 - share) * (1.0 - share));
        }

        // Take blunt ends to their middles: one side of a bend is longer, which moves ends aside.
        let width_at = |share: f64| {
            let [a, b] = self.pair(best, share);
            a.distance(b)
        };
        Ends {
            from: self.between_corners(best.from, width_at(NEAR_END)),
            to: self.between_corners(best.to, width_at(1.0 - NEAR_END)),
        }
    }

    /// Half way between the two corners within a width of an end at which the border turns; where it turns at fewer or
    /// more of them, the end as it is.
    fn between_corners(&self, end: f64, width: f64) -> f64 {
        let length = self.length();
        let offset = |way: f64| (way - end + 0.5 * length).rem_euclid(length) - 0.5 * length;
        let corners = 0..self.places.len();
        let turns: Vec<f64> = corners
            .filter(|at| self.turn_cosine(*at) < TURN_COSINE)
            .map(|at| offset(self.ways[at]))
            .filter(|offset| offset.abs() <= width)
            .collect();
        match turns.as_slice() {
            [a, b] => end + 0.5 * (a + b),
            _ => end,
        }
    }

    /// Cosine of the angle by which the border turns at a corner.
    fn turn_cosine(&self, at: usize) -> f64 {
        let count = self.places.len();
        let here = self.places[at];
        let before = here - self.places[(at + count - 1) % count];
        let after = self.places[(at + 1) % count] - here;
        before.normalize_or_zero().dot(after.normalize_or_zero())
    }

    /// Of ends those between which the sides are nearest, of equal ones the first.
    fn nearest(&self, first: Ends, others: impl Iterator<Item = Ends>, weight: Weight) -> Ends {
        let mut best = (self.distance(first, weight), first);
        for ends in others {
            let distance = self.distance(ends, weight);
            if distance < best.0 {
                best = (distance, ends);
            }
        }
        best.1
    }

    /// The line between the sides, with a point for every corner of one of them, from end to end.
    fn middle(&self, ends: Ends) -> Vec<CardPoint> {
        let shares = self.shares(ends);
        let [there, back] = self.side_lengths(ends);
        let point = |share: &f64| {
            let [a, b] = self.pair(ends, *share);
            CardPoint {
                place: 0.5 * (a + b),
                across: a - b,
                width: a.distance(b),
                vertex: self.vertex(ends.from + share * there),
                ..CardPoint::default()
            }
        };
        let points: Vec<CardPoint> = shares.iter().map(point).collect();

        // A blunt end runs across: there the sides part as fast as the border goes on.
        let steps = points.len() - 1;
        let is_across = |at: &usize, end: usize| {
            let way = 0.5 * (there + back) * (shares[*at] - shares[end]).abs();
            way <= REACH * self.length() && points[*at].width > way
        };
        let first = (0..steps).rev().find(|at| is_across(at, 0)).unwrap_or(0);
        let last = (first + 1..=steps)
            .find(|at| is_across(at, steps))
            .unwrap_or(steps);
        let mut kept = points[first..=last].to_vec();
        kept[0].place = points[0].place;
        kept[last - first].place = points[steps].place;
        kept
    }

    /// Shares of both sides at which either has a corner, ascending from 0 to 1; where a corner of one side lies near
    /// one of the other, both are one.
    fn shares(&self, ends: Ends) -> Vec<f64> {
        // Find the side and the share of every corner.
        let [there, back] = self.side_lengths(ends);
        let corners = self.ways[..self.places.len()].iter();
        let mut placed: Vec<(f64, bool)> = corners
            .map(|way| {
                let on = (way - ends.from).rem_euclid(self.length());
                match on <= there {
                    true => (on / there, true),
                    false => ((self.length() - on) / back, false),
                }
            })
            .filter(|(share, _)| *share > 0.0 && *share < 1.0)
            .collect();
        placed.sort_by(|a, b| a.0.total_cmp(&b.0));

        // Pair them.
        let same = SAME * 2.0 / self.places.len() as f64;
        let mut shares = vec![0.0];
        let mut left: &[(f64, bool)] = &placed;
        while let Some((first, rest)) = left.split_first() {
            let mate = rest
                .first()
                .filter(|mate| mate.1 != first.1 && mate.0 - first.0 < same);
            shares.push(mate.map_or(first.0, |mate| 0.5 * (first.0 + mate.0)));
            left = &rest[usize::from(mate.is_some())..];
        }
        shares.push(1.0);
        shares
    }
}
