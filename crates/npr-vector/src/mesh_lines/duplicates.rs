//! Leaves out what would be inked twice.
//!
//! Where a mesh is noisy its contour doubles back, and a cusp grows a fringe of hairs beside the line it ends. Runs
//! are taken from the longest to the shortest; what lies beside a run already taken, and along it, is cut away.

use crate::mesh_lines::near::{Cells, cells_within};
use crate::mesh_lines::run::{Run, RunPoint, distance};
use crate::stroke::Kind;
use std::collections::BTreeSet;

/// Within this distance of a longer run a sample is a double, in pixels.
const BESIDE_PX: f64 = 2.25;

/// Width of the pen that draws the lines, in pixels: within it of a line there is ink already.
const PEN_PX: f64 = 3.0;

/// Cosine of the largest angle at which lines count as running along each other.
const ALONG_COS: f64 = 0.8;

/// Length along a run within which it may come near to itself, in pixels.
const OWN_PX: f64 = 12.0;

/// Number of samples on either side that vote on one.
const MAJORITY: usize = 3;

/// Fewest samples that a part left after cutting may have.
const LEAST_SAMPLES: usize = 2;

/// Number of samples after one that decide whether it is drawn: as many as vote on the least row that may be left.
const SETTLING: usize = MAJORITY + LEAST_SAMPLES - 1;

/// How many samples beyond a cut are kept, so that what is left reaches the line it ran into.
const OVERLAP: usize = 2;

/// A run shorter than this, all of it beside a longer one in any direction, is a hair, in pixels.
const HAIR_PX: f64 = 12.0;

/// A run shorter than this, all of it in the ink of longer ones, is a shred, in pixels: it would only lead their
/// ends astray.
const SHRED_PX: f64 = 4.0;

/// Runs without doubles; order is kept. Runs must be sampled about evenly.
///
/// What is left of a run is cut by majority, so that noise leaves no shreds, but not where it holds lines together: a
/// short bare part from the end of a line to that of another stays, however little it is, of contours to the side of
/// another, too, and so does a hair from one end to the other. O(samples) for lines that do not crowd in one place.
pub fn suppress(runs: Vec<Run>) -> Vec<Run> {
    let mut taken = Taken::new();
    let mut kept: Vec<Vec<Run>> = vec![Vec::new(); runs.len()];
    for (index, length) in longest_first(&runs) {
        let run = &runs[index];
        let reach = if length < SHRED_PX { PEN_PX } else { BESIDE_PX };
        let is_hair = length < HAIR_PX && !run.closed && taken.surrounds(run, reach);
        if is_hair && !taken.joins_ends(run) {
            continue;
        }
        let doubled = taken.doubled(run, index);
        kept[index] = parts(run, &doubled);
    }
    kept.into_iter().flatten().collect()
}

/// Runs without the fragments that add less ink than half the pen's width to longer runs; order is kept.
///
/// A run is left out if less than 1.5 pixels of it lie farther than 3 from longer runs that stay. Runs away from
/// others, those that hold two ends together, parts cut at corners, and the longest run of every object always stay.
/// Runs must be sampled about evenly. O(samples) for lines that do not crowd in one place.
pub fn leave_out_short_fragments(mut runs: Vec<Run>) -> Vec<Run> {
    let mut taken = Taken::new();
    let mut objects = BTreeSet::new();
    let mut stays = vec![true; runs.len()];
    for (index, length) in longest_first(&runs) {
        let run = &runs[index];
        let is_first = objects.insert((run.object, run.occluders > 0));
        if !is_first && run.cut == [false; 2] && !taken.joins_ends(run) {
            let bare = run.points.iter().filter(|p| !taken.inks(run, p.place));
            stays[index] = bare.count() as f64 * length >= 0.5 * PEN_PX * run.points.len() as f64;
        }
        if stays[index] {
            taken.take(run, index);
        }
    }
    let mut stays = stays.into_iter();
    runs.retain(|_| stays.next().unwrap_or(true));
    runs
}

/// Indices and lengths of runs, from the longest to the shortest.
fn longest_first(runs: &[Run]) -> Vec<(usize, f64)> {
    let mut order: Vec<(usize, f64)> = runs.iter().map(Run::length).enumerate().collect();
    order.sort_by(|(a, length_a), (b, length_b)| {
        length_b
            .total_cmp(length_a)
            .then(runs[*a].id.cmp(&runs[*b].id))
            .then(a.cmp(b))
    });
    order
}

/// A sample of a run that is drawn.
#[derive(Clone, Copy)]
struct Sample {
    place: [f64; 2],
    along: [f64; 2],
    run: usize,
    /// Distance from the start of its run, in pixels.
    at: f64,
    occluded: bool,
    /// Whether the end of its run is the last, if it lies within a pen's width of one.
    tip: Option<bool>,
}

/// What a sample lies beside: a run, and which end of it, if it is one: whether it is the last; `None` beside nothing.
type Beside = Option<(usize, Option<bool>)>;

/// The samples of all runs taken so far, in cells.
struct Taken {
    cells: Cells<Sample>,
}

impl Taken {
    fn new() -> Self {
        Self {
            cells: Cells::new(PEN_PX),
        }
    }

    /// Which samples of a run lie along something taken, by majority; takes the samples that are drawn and lie beside
    /// nothing.
    ///
    /// A sample beside nothing may be cut away with most of the samples around it. It is not taken: otherwise others
    /// would be cut away for lying beside a line that is not drawn.
    fn doubled(&mut self, run: &Run, index: usize) -> Vec<bool> {
        let (samples, leads) = (samples(run, index), run.kind == Kind::Contour);
        let mut beside: Vec<Beside> = Vec::with_capacity(samples.len());
        for i in 0..samples.len() + SETTLING {
            if let Some(sample) = samples.get(i) {
                let is_beside = |other: &Sample| {
                    let apart = other.run != index || sample.at - other.at > OWN_PX;
                    let [a, b] = [sample.along, other.along];
                    let cos = a[0] * b[0] + a[1] * b[1];
                    other.occluded == sample.occluded && apart && cos.abs() > ALONG_COS
                };
                let nearest = self.nearest(sample.place, BESIDE_PX, is_beside);
                beside.push(nearest.map(|other| (other.run, other.tip)));
            }
            // Later samples of this run are compared with this one.
            let settled = i.checked_sub(SETTLING);
            let is_taken = |i: &usize| beside[*i].is_none() && is_drawn(&beside, *i, leads);
            if let Some(settled) = settled.filter(is_taken) {
                self.add(samples[settled]);
            }
        }
        (0..beside.len())
            .map(|i| is_cut(&beside, i, leads))
            .collect()
    }

    fn add(&mut self, sample: Sample) {
        self.cells.add(sample.place, sample);
    }

    /// Takes all samples of a run.
    fn take(&mut self, run: &Run, index: usize) {
        let samples = samples(run, index);
        samples.into_iter().for_each(|sample| self.add(sample));
    }

    /// Whether the pen that drew what is taken has touched a place of a run.
    fn inks(&self, run: &Run, place: [f64; 2]) -> bool {
        self.nearest(place, PEN_PX, |other| other.occluded == (run.occluders > 0))
            .is_some()
    }

    /// Whether a run that adds no ink leads from an end of something taken to another end, and is too short to run
    /// along anything else.
    fn joins_ends(&self, run: &Run) -> bool {
        let tip = |point: &RunPoint| {
            let is_tip =
                |other: &Sample| other.tip.is_some() && other.occluded == (run.occluders > 0);
            let end = self.nearest(point.place, PEN_PX, is_tip)?;
            Some((end.run, end.tip))
        };
        let [Some(first), Some(last)] =
            [&run.points[0], &run.points[run.points.len() - 1]].map(tip)
        else {
            return false;
        };
        // A pen's width at each end is inked by what ends there; any longer, more lines lie beside it.
        !run.closed && first != last && run.length() < 2.5 * PEN_PX
    }

    /// Whether something taken lies within reach of every sample but one in five.
    fn surrounds(&self, run: &Run, reach: f64) -> bool {
        let beside = |place| {
            self.nearest(place, reach, |other| other.occluded == (run.occluders > 0))
                .is_some()
        };
        let count = run
            .points
            .iter()
            .filter(|point| beside(point.place))
            .count();
        5 * count >= 4 * run.points.len()
    }

    /// The nearest sample within a reach of at most the pen's width; of equally near ones the one taken first in its
    /// cell.
    fn nearest(
        &self,
        place: [f64; 2],
        reach: f64,
        is: impl Fn(&Sample) -> bool,
    ) -> Option<&Sample> {
        let around = self.cells.of(cells_within(place, reach, PEN_PX));
        // Most samples of the cells are too far, which needs no root.
        let most = reach * reach * (1.0 + 1e-9);
        let is_near = |other: &&Sample| {
            let [dx, dy] = [0, 1].map(|i| other.place[i] - place[i]);
            dx * dx + dy * dy <= most
        };
        around
            .filter(is_near)
            .map(|other| (distance(other.place, place), other))
            .filter(|(apart, other)| *apart < reach && is(other))
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .map(|(_, other)| other)
    }
}

/// Unit direction of a run at every point.
fn directions(run: &Run) -> Vec<[f64; 2]> {
    let count = run.points.len();
    (0..count)
        .map(|i| {
            let (a, b) = if run.closed {
                ((i + count - 1) % count, (i + 1) % count)
            } else {
                (i.saturating_sub(1), (i + 1).min(count - 1))
            };
            let (a, b) = (run.points[a].place, run.points[b].place);
            let length = distance(a, b).max(1e-12);
            [(b[0] - a[0]) / length, (b[1] - a[1]) / length]
        })
        .collect()
}

/// Distance of every point from the start.
fn stations(run: &Run) -> Vec<f64> {
    let mut at = 0.0;
    let steps = run.points.windows(2).map(|pair| {
        at += distance(pair[0].place, pair[1].place);
        at
    });
    std::iter::once(0.0).chain(steps).collect()
}

/// The points of run `index` as samples.
fn samples(run: &Run, index: usize) -> Vec<Sample> {
    let (stations, length) = (stations(run), run.length());
    let tip = |at: f64| match run.closed {
        false if at < PEN_PX => Some(false),
        false if length - at < PEN_PX => Some(true),
        _ => None,
    };
    let points = run.points.iter().zip(directions(run)).zip(stations);
    points
        .map(|((point, along), at)| Sample {
            place: point.place,
            along,
            run: index,
            at,
            occluded: run.occluders > 0,
            tip: tip(at),
        })
        .collect()
}

/// Whether most samples around one are beside something, and it holds no lines together.
fn is_cut(beside: &[Beside], index: usize, leads: bool) -> bool {
    let window = &beside[index.saturating_sub(MAJORITY)..(index + MAJORITY + 1).min(beside.len())];
    let count = window.iter().filter(|beside| beside.is_some()).count();
    2 * count > window.len() && !holds_ends(beside, index, leads)
}

/// Whether a sample lies in a part beside nothing that holds lines together: it leads from an end to another end, or,
/// where it `leads`, as contours do, to another run. Without it the outline would have a gap at that end.
fn holds_ends(beside: &[Beside], index: usize, leads: bool) -> bool {
    let before = beside[..=index].iter().rev().find_map(|beside| *beside);
    let after = beside[index..].iter().find_map(|beside| *beside);
    let (None, Some(before), Some(after)) = (beside[index], before, after) else {
        return false;
    };
    match (before.1, after.1) {
        (Some(_), Some(_)) => before != after,
        (None, None) => false,
        _ => leads && before.0 != after.0,
    }
}

/// Whether a sample is one of enough in a row that are not cut away. Those within [`SETTLING`] of it decide.
fn is_drawn(beside: &[Beside], index: usize, leads: bool) -> bool {
    let rows = (index + 1).saturating_sub(LEAST_SAMPLES)..=index;
    rows.map(|from| from..from + LEAST_SAMPLES)
        .filter(|row| row.end <= beside.len())
        .any(|mut row| row.all(|i| !is_cut(beside, i, leads)))
}

/// What is left of a run.
fn parts(run: &Run, doubled: &[bool]) -> Vec<Run> {
    if !doubled.contains(&true) {
        return vec![run.clone()];
    }
    let count = run.points.len();
    // Start a closed run at a double, so that no part runs over its seam.
    let start = if run.closed {
        doubled.iter().position(|d| *d).unwrap_or(0)
    } else {
        0
    };
    let at = |k: usize| (start + k) % count;
    let mut parts: Vec<Run> = Vec::new();
    let mut from = 0;
    while from < count {
        if doubled[at(from)] {
            from += 1;
            continue;
        }
        let to = (from..count).find(|k| doubled[at(*k)]).unwrap_or(count);
        if to - from >= LEAST_SAMPLES {
            let (first, last) = (from.saturating_sub(OVERLAP), (to + OVERLAP).min(count));
            let points = (first..last).map(|k| run.points[at(k)]).collect();
            let is_end_of_run = [first == 0, last == count].map(|is_end| is_end && !run.closed);
            parts.push(Run {
                points,
                closed: false,
                cut: [0, 1].map(|end| run.cut[end] && is_end_of_run[end]),
                beyond: [0, 1].map(|end| run.beyond[end].filter(|_| is_end_of_run[end])),
                ..run.clone_empty()
            });
        }
        from = to;
    }
    parts.retain(|part| part.points.len() > 1);
    for (ordinal, part) in parts.iter_mut().enumerate().skip(1) {
        // Parts of one run must not share its identity.
        part.id = run.id ^ (ordinal as u64) << 44;
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh_lines::merge::{FACING_PX, merge_ends};
    use crate::mesh_lines::run::testing::{run_along, straight};
    use proptest::prelude::*;

    /// A line of samples 1.5 px apart.
    fn line(id: u64, from: [f64; 2], to: [f64; 2]) -> Run {
        let count = (distance(from, to) / 1.5).ceil() as usize;
        let at = |i: usize| {
            let share = i as f64 / count as f64;
            [0, 1].map(|k| from[k] + (to[k] - from[k]) * share)
        };
        run_along(id, &(0..=count).map(at).collect::<Vec<_>>())
    }

    #[test]
    fn of_two_lines_side_by_side_the_longer_stays() {
        let runs = vec![
            line(1, [20.0, 1.5], [80.0, 1.5]),
            line(2, [0.0, 0.0], [100.0, 0.0]),
        ];
        let kept = suppress(runs);
        assert_eq!(kept.iter().map(|run| run.id).collect::<Vec<_>>(), [2]);
    }

    #[test]
    fn lines_that_cross_or_keep_apart_stay_whole() {
        let runs = vec![
            line(1, [0.0, 0.0], [100.0, 0.0]),
            line(2, [50.0, -40.0], [50.0, 40.0]),
            line(3, [0.0, 5.0], [90.0, 5.0]),
        ];
        assert_eq!(suppress(runs.clone()), runs);
    }

    #[test]
    fn only_the_part_beside_another_line_is_cut() {
        // The second runs along the first for 40 px and then leaves it.
        let mut bent = line(2, [0.0, 1.0], [40.0, 1.0]);
        bent.points
            .extend(line(2, [41.0, 2.0], [70.0, 40.0]).points);
        let kept = suppress(vec![line(1, [-50.0, 0.0], [60.0, 0.0]), bent.clone()]);
        assert_eq!(kept.len(), 2);
        assert!(kept[1].length() < 0.75 * bent.length() && kept[1].length() > 40.0);
        let last = kept[1].points[kept[1].points.len() - 1];
        assert_eq!(last.place, bent.points[bent.points.len() - 1].place);
    }

    #[test]
    fn a_line_that_turns_back_on_itself_is_inked_once() {
        let mut hairpin = line(1, [0.0, 0.0], [60.0, 0.0]);
        hairpin
            .points
            .extend(line(1, [60.0, 1.5], [0.0, 1.5]).points);
        let kept = suppress(vec![hairpin]);
        let length: f64 = kept.iter().map(Run::length).sum();
        assert!(length < 90.0, "{length}");
    }

    fn runs_of(lines: &[([f64; 2], f64, f64)]) -> Vec<Run> {
        let made = |(id, (from, angle, length)): (u64, &([f64; 2], f64, f64))| {
            straight(id, *from, *angle, *length)
        };
        (0..).zip(lines).map(made).collect()
    }

    /// What is left are points of the runs in their order; what is gone lies beside what is left.
    ///
    /// A sample is cut away by its own majority or, of too few in a row, with a neighbour that is. So a sample at most
    /// [`SETTLING`] further on, of steps of 1.5 px, lies within [`BESIDE_PX`] of a sample that is left.
    fn check_nothing_is_added_or_lost(lines: &[([f64; 2], f64, f64)]) {
        let runs = runs_of(lines);
        let kept = suppress(runs.clone());
        for run in &runs {
            let own = |part: &&Run| part.id & 0xffff == run.id;
            for part in kept.iter().filter(own) {
                let start = run.points.iter().position(|p| *p == part.points[0]);
                let range = start.expect("a point of the run")..;
                assert!(run.points[range].starts_with(&part.points));
            }
            for point in &run.points {
                let all = kept.iter().flat_map(|part| &part.points);
                let away = all.map(|p| distance(p.place, point.place));
                let nearest = away.fold(f64::MAX, f64::min);
                let most = BESIDE_PX + 1.5 * SETTLING as f64;
                assert!(nearest < most + 1e-9, "{nearest} px");
            }
        }
    }

    #[test]
    fn what_lies_beside_samples_that_are_cut_away_stays() {
        // The end of the first line passes that of the third by two samples, which are too few to stay. The second line
        // goes on beside these two.
        check_nothing_is_added_or_lost(&[
            (
                [29.735959869937215, 23.280680181928368],
                5.248184619947375,
                41.53565443580974,
            ),
            (
                [36.93352022150058, 15.183032509231056],
                5.171881852840715,
                34.30108280904483,
            ),
            (
                [39.247379366346614, 33.682010772693914],
                4.936090851292034,
                42.511884490797264,
            ),
        ]);
    }

    #[test]
    fn a_hair_that_holds_two_ends_together_stays() {
        let ends = [
            line(0, [0.0, 0.0], [40.0, 0.0]),
            line(1, [44.0, -2.0], [80.0, 20.0]),
        ];
        let with = |hair: Run| suppress([&ends[..], &[hair]].concat()).len();
        assert_eq!(with(line(2, [40.0, 0.0], [44.0, -2.0])), 3);
        assert_eq!(with(line(2, [20.0, 2.0], [24.0, 0.0])), 2);
    }

    #[test]
    fn shreds_in_the_ink_of_a_line_go() {
        let with = |shred: Run| suppress(vec![line(1, [0.0, 0.0], [80.0, 0.0]), shred]).len();
        assert_eq!(with(line(2, [40.0, 2.6], [43.5, 2.6])), 1);
        assert_eq!(with(line(2, [40.0, 3.4], [43.5, 3.4])), 2);
        assert_eq!(with(line(2, [40.0, 2.6], [45.0, 2.6])), 2, "it is longer");
    }

    #[test]
    fn a_short_fragment_that_holds_two_ends_together_stays() {
        let ends = [
            line(0, [0.0, 0.0], [40.0, 0.0]),
            line(1, [45.0, 0.0], [80.0, 0.0]),
        ];
        let with =
            |fragment: Run| leave_out_short_fragments([&ends[..], &[fragment]].concat()).len();
        assert_eq!(with(line(2, [40.0, 0.0], [45.0, 0.0])), 3);
        assert_eq!(with(line(2, [20.0, 1.0], [25.0, 1.0])), 2);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        #[test]
        fn nothing_is_added_and_nothing_lost(
            lines in prop::collection::vec((prop::array::uniform2(0.0_f64..50.0), 0.0_f64..6.3, 13.0_f64..60.0), 1..20),
        ) {
            check_nothing_is_added_or_lost(&lines);
        }

        /// Where one line ends and the next begins, a third over both ends holds them together, however short its own
        /// part is.
        #[test]
        fn what_holds_two_ends_together_stays(
            angle in 0.0_f64..6.3, gap in 4.0_f64..20.0, over in prop::array::uniform2(3.0_f64..30.0),
            off in -1.0_f64..1.0,
        ) {
            let [sin, cos] = [angle.sin(), angle.cos()];
            let along = |id: u64, from: f64, to: f64, off: f64| {
                straight(id, [from * cos - off * sin, from * sin + off * cos], angle, to - from)
            };
            let runs = vec![
                along(1, -90.0, 0.0, 0.0),
                along(2, gap, gap + 90.0, 0.0),
                along(3, -over[0], gap + over[1], off),
            ];
            let joined = merge_ends(suppress(runs), FACING_PX);
            prop_assert_eq!(joined.len(), 1);
            prop_assert!((joined[0].length() - gap - 180.0).abs() < 6.0, "{}", joined[0].length());
        }

        /// Where one line ends and another passes before it, a third beside both holds them together: an outline has no
        /// gap at its corner.
        #[test]
        fn what_leads_from_an_end_to_a_line_stays(
            angle in 0.0_f64..6.3, gap in 7.0_f64..10.0, over in 6.0_f64..30.0, along in 6.0_f64..40.0,
            off in -1.0_f64..1.0, turned: bool,
        ) {
            let [sin, cos] = [angle.sin(), angle.cos()];
            let turn = |places: &[[f64; 2]]| -> Vec<[f64; 2]> {
                places.iter().map(|[x, y]| [x * cos - y * sin, x * sin + y * cos]).collect()
            };
            let way = |id: u64, places: &[[f64; 2]]| {
                let steps = turn(places).windows(2).flat_map(|pair| line(id, pair[0], pair[1]).points).collect();
                Run { points: steps, ..line(id, [0.0; 2], [1.0; 2]) }
            };
            let ends = way(0, &[[-90.0, 0.0], [0.0, 0.0]]);
            let passes = way(1, &[[gap, -30.0], [gap, 70.0]]);
            let mut third = way(2, &[[-over, off], [gap + off, off], [gap + off, off + along]]);
            if turned {
                third.reverse();
            }
            let kept = suppress(vec![ends, passes, third]);
            let middle = turn(&[[0.5 * gap, off]])[0];
            let mut inked = kept.iter().flat_map(|run| &run.points).map(|point| distance(point.place, middle));
            prop_assert!(inked.any(|away| away < 1.0), "nothing leads on");
        }

        /// Which lines stay does not depend on their order.
        #[test]
        fn order_does_not_matter(
            lines in prop::collection::vec((prop::array::uniform2(0.0_f64..50.0), 0.0_f64..6.3, 2.0_f64..60.0), 0..20),
            seed: u64,
        ) {
            let runs = runs_of(&lines);
            let mut shuffled = runs.clone();
            npr_mesh::testing::Random::new(seed).shuffle(&mut shuffled);
            let left = |runs| {
                let mut left = suppress(runs);
                left.sort_by_key(|run: &Run| run.id);
                left
            };
            prop_assert_eq!(left(runs), left(shuffled));
        }

        /// A shorter copy beside a line goes, whichever way it runs; not a hidden one, nor one that keeps its distance.
        #[test]
        fn copies_go(angle in 0.0_f64..6.3, length in 20.0_f64..90.0, off in -1.4_f64..1.4, turned: bool) {
            let line = straight(1, [100.0; 2], angle, length);
            let beside = |off: f64| {
                let from = [
                    100.0 - off * angle.sin() + 2.0 * angle.cos(),
                    100.0 + off * angle.cos() + 2.0 * angle.sin(),
                ];
                let mut copy = straight(2, from, angle, length - 4.0);
                if turned {
                    copy.points.reverse();
                }
                copy
            };
            let left = |copy: Run| suppress(vec![copy, line.clone()]).len();
            prop_assert_eq!(left(beside(off)), 1);
            prop_assert_eq!(left(beside(off.signum() * 3.0)), 2);
            prop_assert_eq!(left(Run { occluders: 1, ..beside(off) }), 2);
        }

        /// Only fragments go, each near what stays; one of every object stays, and so do parts cut at corners.
        #[test]
        fn only_short_fragments_near_others_go(
            lines in prop::collection::vec(
                (
                    prop::array::uniform2(0.0_f64..50.0), 0.0_f64..6.3, 2.0_f64..20.0, 0_u32..3,
                    prop::bool::weighted(0.1),
                ),
                0..30,
            ),
        ) {
            let made = |(id, (from, angle, length, object, cut)): (u64, &([f64; 2], f64, f64, u32, bool))| {
                Run { object: *object, cut: [*cut, false], ..straight(id, *from, *angle, *length) }
            };
            let runs: Vec<Run> = (0..).zip(&lines).map(made).collect();
            let kept = leave_out_short_fragments(runs.clone());
            let bare = |run: &Run| {
                let inked: Vec<&RunPoint> = kept.iter().flat_map(|other| &other.points).collect();
                let ink = |place| inked.iter().any(|p| distance(p.place, place) < PEN_PX);
                run.points.iter().filter(|p| !ink(p.place)).count() as f64 / run.points.len() as f64 * run.length()
            };
            let mut left = kept.iter().peekable();
            for run in &runs {
                if left.next_if_eq(&run).is_none() {
                    prop_assert!(run.cut == [false; 2]);
                    prop_assert!(bare(run) < PEN_PX, "{} px", bare(run));
                    prop_assert!(kept.iter().any(|other| other.object == run.object && other.length() >= run.length()));
                }
            }
            prop_assert!(left.next().is_none());
            prop_assert_eq!(leave_out_short_fragments(kept.clone()), kept.clone());
        }
    }
}
