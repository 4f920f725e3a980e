//! Corners of runs: where a line turns sharply in the picture.
//!
//! A turn is measured over a fixed length of the line on either side of a point, before anything is smoothed: neither
//! the number of points nor their noise decides. Smoothing keeps corners where they are, closed runs start at one,
//! and [`split`] cuts strokes there.

use crate::mesh_lines::run::{Run, RunPoint, SPECK_PX, base_id, distance};
use crate::rank::hash_key;
use npr_core::math;
use std::collections::BTreeSet;

/// Length of the line on either side of a point over which its turn is measured, in pixels.
const REACH_PX: f64 = 8.0;

/// Most of that length on a closed line, as a share of the line: a circle of any size turns by 36 degrees there.
const REACH_SHARE: f64 = 0.1;

/// Least share of a corner's turn that lies at the point itself, within [`SHARP_REACH`] of the reach: a bend spreads
/// its turn out.
const SHARP_TURN: f64 = 0.75;
const SHARP_REACH: f64 = 0.25;

/// Cosine of the turn from which smoothing leaves a corner alone, and from which closed runs may start: about 45
/// degrees.
pub(crate) const PINNED_COS: f64 = 0.7;

/// Corners whose turn differs by less than this are equally sharp, in radians: noise must not decide between the
/// corners of a box.
const EQUAL_TURN: f64 = 0.25;

/// A point of a line where it turns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Corner {
    /// Index of the point.
    pub point: usize,
    /// Angle between the directions before and after it, in radians, 0..pi.
    pub turn: f64,
    /// Whether the line turns at the point itself, rather than along a bend.
    pub is_sharp: bool,
}

/// Points where the cosine of a line's turn is at most `turn_cos`, ascending; each is the sharpest within 8 pixels.
///
/// Points nearer than that to an end of an open line are left out. O(n log n).
pub fn corners(points: &[RunPoint], closed: bool, turn_cos: f64) -> Vec<Corner> {
    let way = Way::new(points, closed);
    let reach = way.reach();
    let mut candidates: Vec<(f64, usize)> = (0..points.len())
        .map(|point| (way.turn_cos(point, reach), point))
        .filter(|(cos, _)| *cos <= turn_cos)
        .collect();
    candidates.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let mut taken = BTreeSet::new();
    for (_, point) in candidates {
        let before = taken.range(..point).next_back().or(taken.last());
        let after = taken.range(point..).next().or(taken.first());
        let apart = |other: Option<&usize>| other.is_none_or(|o| way.apart(*o, point) >= reach);
        if apart(before) && apart(after) {
            taken.insert(point);
        }
    }
    taken.into_iter().map(|point| way.corner(point)).collect()
}

/// A line with the distance of its points from the start.
struct Way {
    /// Places of the points; on a closed line the first comes again at the end.
    places: Vec<[f64; 2]>,
    stations: Vec<f64>,
    closed: bool,
}

impl Way {
    fn new(points: &[RunPoint], closed: bool) -> Self {
        let again = points.first().filter(|_| closed);
        let places: Vec<[f64; 2]> = points.iter().chain(again).map(|p| p.place).collect();
        let mut at = 0.0;
        let steps = places.windows(2).map(|pair| {
            at += distance(pair[0], pair[1]);
            at
        });
        let start = places.first().map(|_| 0.0);
        Self {
            stations: start.into_iter().chain(steps).collect(),
            places,
            closed,
        }
    }

    fn length(&self) -> f64 {
        self.stations.last().copied().unwrap_or(0.0)
    }

    fn reach(&self) -> f64 {
        match self.closed {
            true => REACH_PX.min(REACH_SHARE * self.length()),
            false => REACH_PX,
        }
    }

    /// Distance of two points along the line.
    fn apart(&self, a: usize, b: usize) -> f64 {
        let along = (self.stations[a] - self.stations[b]).abs();
        match self.closed {
            true => along.min(self.length() - along),
            false => along,
        }
    }

    /// The place at a distance from the start; none beyond the ends of an open line.
    fn place_at(&self, station: f64) -> Option<[f64; 2]> {
        let length = self.length();
        let at = match self.closed {
            true => station.rem_euclid(length),
            false if (0.0..=length).contains(&station) => station,
            false => return None,
        };
        let after = self.stations.partition_point(|s| *s < at);
        let after = after.clamp(1, self.places.len().checked_sub(1)?.max(1));
        let (a, b) = (self.places[after - 1], *self.places.get(after)?);
        let span = self.stations[after] - self.stations[after - 1];
        let share = if span > 0.0 {
            ((at - self.stations[after - 1]) / span).clamp(0.0, 1.0)
        } else {
            0.0
        };
        Some([0, 1].map(|i| a[i] + (b[i] - a[i]) * share))
    }

    /// Cosine of the turn at a point over a length on either side; 1 where there is none.
    fn turn_cos(&self, point: usize, reach: f64) -> f64 {
        let (here, station) = (self.places[point], self.stations[point]);
        let ends = [station - reach, station + reach].map(|s| self.place_at(s));
        let [Some(before), Some(after)] = ends else {
            return 1.0;
        };
        let size = distance(before, here) * distance(here, after);
        let along = |i: usize| (here[i] - before[i]) * (after[i] - here[i]);
        if size > 0.0 {
            ((along(0) + along(1)) / size).clamp(-1.0, 1.0)
        } else {
            1.0
        }
    }

    fn turn(&self, point: usize, reach: f64) -> f64 {
        f64::from(math::acos(self.turn_cos(point, reach) as f32))
    }

    fn corner(&self, point: usize) -> Corner {
        let reach = self.reach();
        let turn = self.turn(point, reach);
        Corner {
            point,
            turn,
            is_sharp: self.turn(point, reach * SHARP_REACH) >= SHARP_TURN * turn,
        }
    }
}

/// Turns a closed run so that it starts at its sharpest corner, or else at the point on the mesh edge with the least
/// hash.
///
/// A brush stroke must not begin in the middle of a smooth line; where all of it is smooth, the mesh edge keeps the
/// start from jumping as the camera moves. Hashes decide between corners about as sharp, too. Open runs stay as they
/// are.
pub fn start_at_head(run: &mut Run) {
    if !run.closed {
        return;
    }
    let corners = corners(&run.points, true, PINNED_COS);
    let sharpest = corners.iter().map(|c| c.turn).fold(0.0, f64::max);
    let as_sharp = corners.iter().filter(|c| c.turn > sharpest - EQUAL_TURN);
    let anchor = |point: &usize| Anchor::of(&run.points[*point]);
    let by_anchor = |a: &usize, b: &usize| anchor(a).cmp(&anchor(b));
    let head = as_sharp
        .map(|corner| corner.point)
        .min_by(by_anchor)
        .or_else(|| (0..run.points.len()).min_by(by_anchor));
    run.points.rotate_left(head.unwrap_or(0));
}

/// Orders points by where they lie on the mesh, whatever list they come from.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
struct Anchor(u32, u32, [i64; 2]);

impl Anchor {
    fn of(point: &RunPoint) -> Self {
        // To a thousandth of a pixel.
        let place = point.place.map(|v| (v * 1e3).round() as i64);
        Self(hash_key(point.edge), point.t.to_bits(), place)
    }
}

/// Cuts runs at sharp corners that turn by at least an angle in radians; both parts keep the corner as an end.
///
/// Ends at a cut are marked, so that nothing joins them again. The identity of a part comes from the mesh edge with the
/// least hash among its own, so that a cut elsewhere does not change it. Runs keep their order, and parts follow each
/// other along their run. A closed run with one corner becomes an open one from the corner to itself.
pub fn split(runs: Vec<Run>, least_turn: f32) -> Vec<Run> {
    let turn_cos = f64::from(math::cos(least_turn));
    let cuts: Vec<Vec<usize>> = runs
        .iter()
        .map(|run| {
            // Specks stay whole, to be left out whole.
            if run.points.is_empty() || run.length() < SPECK_PX {
                return Vec::new();
            }
            let corners = corners(&run.points, run.closed, turn_cos);
            let sharp = corners.iter().filter(|corner| corner.is_sharp);
            sharp.map(|corner| corner.point).collect()
        })
        .collect();
    let whole = runs.iter().zip(&cuts).filter(|(_, cuts)| cuts.is_empty());
    let mut taken: BTreeSet<u64> = whole.map(|(run, _)| run.id).collect();
    let mut found = Vec::with_capacity(runs.len());
    for (run, cuts) in runs.into_iter().zip(cuts) {
        if cuts.is_empty() {
            found.push(run);
            continue;
        }
        for mut part in parts(&run, &cuts) {
            while !taken.insert(part.id) {
                part.id += 1;
            }
            found.push(part);
        }
    }
    found
}

/// The parts of a run between cuts, of which there is at least one.
fn parts(run: &Run, cuts: &[usize]) -> Vec<Run> {
    let count = run.points.len();
    let stops: Vec<usize> = match run.closed {
        true => cuts.iter().copied().chain([cuts[0] + count]).collect(),
        false => [&[0], cuts, &[count - 1]].concat(),
    };
    let part = |(index, pair): (usize, &[usize])| {
        let points: Vec<RunPoint> = (pair[0]..=pair[1]).map(|i| run.points[i % count]).collect();
        // The first point may lie on an edge of the part before.
        let own = points[1..].iter().map(|point| point.edge);
        let edge = own.min_by_key(|edge| hash_key(*edge)).unwrap_or(0);
        let is_last = index + 2 == stops.len();
        let is_end_of_run = [index == 0, is_last].map(|is_end| is_end && !run.closed);
        Run {
            id: base_id(edge, run.kind) << 8,
            cut: [0, 1].map(|end| !is_end_of_run[end] || run.cut[end]),
            beyond: [0, 1].map(|end| run.beyond[end].filter(|_| is_end_of_run[end])),
            closed: false,
            points,
            ..run.clone_empty()
        }
    };
    stops.windows(2).enumerate().map(part).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh_lines::run::testing::{ring, run_along};
    use proptest::prelude::*;

    fn points_of(places: &[[f64; 2]]) -> Vec<RunPoint> {
        let mut points = run_along(1, places).points;
        for (edge, point) in (0..).zip(&mut points) {
            point.edge = edge;
        }
        points
    }

    /// A square with `steps` points a side, turned about its middle.
    fn square(side: f64, angle: f64, steps: u32) -> Vec<[f64; 2]> {
        let corner = |k: u32| {
            let a = angle + f64::from(k) * std::f64::consts::FRAC_PI_2;
            [300.0 + side * a.cos(), 300.0 + side * a.sin()]
        };
        let on_side = |i: u32| {
            let (from, to) = (corner(i / steps), corner(i / steps + 1));
            let share = f64::from(i % steps) / f64::from(steps);
            [0, 1].map(|k| from[k] + (to[k] - from[k]) * share)
        };
        (0..4 * steps).map(on_side).collect()
    }

    /// The turn at a point, by walking along the line in small steps.
    fn walked_turn(points: &[RunPoint], closed: bool, point: usize, reach: f64) -> Option<f64> {
        let walk = |step: isize| {
            let (mut at, mut left) = (point as isize, reach);
            loop {
                let next = at + step;
                let count = points.len() as isize;
                if !closed && !(0..count).contains(&next) {
                    return None;
                }
                let [a, b] = [at, next].map(|i| points[i.rem_euclid(count) as usize].place);
                let span = distance(a, b);
                if span >= left {
                    return Some([0, 1].map(|i| a[i] + (b[i] - a[i]) * left / span));
                }
                (at, left) = (next, left - span);
            }
        };
        let (before, here, after) = (walk(-1)?, points[point].place, walk(1)?);
        let angle = |a: [f64; 2], b: [f64; 2]| (b[1] - a[1]).atan2(b[0] - a[0]);
        let turn = (angle(here, after) - angle(before, here)).abs();
        Some(turn.min(std::f64::consts::TAU - turn))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        /// Corners are turns as a walk finds them, apart from each other; what turns as much and is none lies beside
        /// one.
        #[test]
        fn corners_are_the_sharpest_turns(
            places in prop::collection::vec(prop::array::uniform2(0.0_f64..60.0), 3..30), closed: bool,
        ) {
            let points = points_of(&places);
            let way = Way::new(&points, closed);
            let reach = way.reach();
            let found = corners(&points, closed, 0.5);
            let turn_of = |i: usize| walked_turn(&points, closed, i, reach).unwrap_or(0.0);
            for corner in &found {
                prop_assert!((corner.turn - turn_of(corner.point)).abs() < 1e-3);
                let others = found.iter().filter(|other| other.point != corner.point);
                prop_assert!(others.clone().all(|o| way.apart(o.point, corner.point) >= reach));
            }
            for i in 0..points.len() {
                let turns = turn_of(i) > std::f64::consts::FRAC_PI_3 + 1e-6;
                let beside = |c: &&Corner| way.apart(c.point, i) < reach || c.point == i;
                let sharpest = found.iter().filter(beside).map(|c| c.turn).fold(0.0, f64::max);
                prop_assert!(!turns || sharpest >= turn_of(i) - 1e-3, "{} at {}", turn_of(i), i);
            }
        }

        /// A circle has no sharp corner, whatever its size and however finely it is given.
        #[test]
        fn smooth_circles_are_never_split(radius in 1.0_f64..300.0, density in 1.0_f64..4.0, least in 0.18_f32..3.0) {
            let run = ring(1, radius, 24 + (radius * density) as usize);
            prop_assert_eq!(split(vec![run.clone()], least), vec![run]);
        }

        /// A square falls into its four sides; each ends exactly at its corners.
        #[test]
        fn squares_are_split_into_sides(
            side in 8.0_f64..250.0, angle in 0.0_f64..7.0, steps in 1_u32..20, turned in 0_usize..80,
        ) {
            let places = square(side, angle, steps);
            let mut run = Run { closed: true, points: points_of(&places), ..run_along(1, &places) };
            let turned = turned % run.points.len();
            run.points.rotate_left(turned);
            let whole = run.length();
            prop_assert_eq!(&split(vec![run.clone()], 1.7), &vec![run.clone()]);
            let parts = split(vec![run], 1.0);
            prop_assert_eq!(parts.len(), 4);
            let length: f64 = parts.iter().map(Run::length).sum();
            prop_assert!((length - whole).abs() < 1e-6);
            for part in &parts {
                prop_assert_eq!(part.cut, [true; 2]);
                for end in [part.points[0], part.points[part.points.len() - 1]] {
                    prop_assert_eq!(end.edge % steps, 0, "corners are every so many points");
                }
            }
            let ids: BTreeSet<u64> = parts.iter().map(|part| part.id).collect();
            prop_assert_eq!(ids.len(), 4);
        }

        /// Where a closed run starts does not depend on where its list does.
        #[test]
        fn closed_runs_start_at_one_point(
            side in 8.0_f64..250.0, angle in 0.0_f64..7.0, steps in 1_u32..20, by in 0_usize..99, round: bool,
        ) {
            let places = square(side, angle, steps);
            let mut run = if round { ring(1, side, 60) } else { run_along(1, &places) };
            (0..).zip(&mut run.points).for_each(|(edge, point)| point.edge = edge);
            run.closed = true;
            let mut other = run.clone();
            let by = by % other.points.len();
            other.points.rotate_left(by);
            start_at_head(&mut run);
            start_at_head(&mut other);
            prop_assert_eq!(&run, &other);
            let least = run.points.iter().map(|p| hash_key(p.edge)).min();
            if round {
                prop_assert_eq!(Some(hash_key(run.points[0].edge)), least);
            } else {
                prop_assert_eq!(run.points[0].edge % steps, 0, "a square starts at a corner");
            }
        }
    }

    #[test]
    fn anything_is_taken() {
        let odd = [f64::NAN, f64::INFINITY, -1e300, 0.0, 0.0, 1e-300, 1e300];
        for count in 0..odd.len() {
            let places: Vec<[f64; 2]> = odd[..count].iter().map(|v| [*v, -*v]).collect();
            for closed in [false, true] {
                let mut run = run_along(1, &places);
                run.closed = closed;
                corners(&run.points, closed, 1.0);
                start_at_head(&mut run);
                split(vec![run], 0.1);
            }
        }
    }

    #[test]
    fn one_corner_opens_a_loop_and_cut_runs_keep_their_ends() {
        // A drop: a point, and round elsewhere.
        let mut places = vec![[0.0, 0.0]];
        let arc = (0..120).map(|i| (f64::from(i) / 119.0 - 0.5) * 4.2);
        places.extend(arc.map(|a| [100.0 + 60.0 * a.cos(), 60.0 * a.sin()]));
        let drop = Run {
            closed: true,
            ..run_along(1, &places)
        };
        let parts = split(vec![drop], 1.0);
        assert_eq!(parts.len(), 1);
        let points = &parts[0].points;
        assert!(!parts[0].closed && points[0] == points[points.len() - 1]);
        assert_eq!(points[0].place, [0.0, 0.0]);

        let mut bent = run_along(2, &[[0.0, 0.0], [50.0, 0.0], [50.0, 50.0]]);
        bent.cut = [true, false];
        let cuts: Vec<[bool; 2]> = split(vec![bent], 1.0).iter().map(|p| p.cut).collect();
        assert_eq!(cuts, [[true, true], [true, false]]);
    }
}
