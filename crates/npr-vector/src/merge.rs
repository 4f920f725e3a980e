//! Joins runs whose ends meet and go the same way.
//!
//! Noise in the orientation of faces breaks one outline into loops that touch; to the eye it is one line.

use crate::corner::start_at_head;
use crate::run::{Run, RunPoint, distance};
use std::collections::BTreeMap;

/// How near two ends must be that only noise keeps apart, in pixels.
pub const TOUCHING_PX: f64 = 2.5;

/// How near two ends must be that face each other across a gap, in pixels.
pub const FACING_PX: f64 = 8.0;

/// Cosine of the largest bend where two runs are joined.
const BEND_COS: f64 = 0.85;

/// Cosine of the largest angle between an end's direction and the gap that it is joined across.
const AIM_COS: f64 = 0.85;

/// Largest difference in depth where two runs are joined, as a share of the depth.
const DEPTH_SHARE: f64 = 0.01;

/// Over how much of a run its direction at an end is taken, in pixels.
const DIRECTION_PX: f64 = 6.0;

/// Runs with ends up to `reach_px` apart joined in pairs, the best pairs first.
///
/// Both must be of one kind, object and visibility; each end is used once. A run whose two ends fit closes. The result keeps the
/// order of the runs' first members, and runs the way of the one with the least id, whichever comes first. Ends that were cut at
/// corners stay apart. O(n log n) for ends that are spread over the picture.
pub fn merge_ends(runs: Vec<Run>, reach_px: f64) -> Vec<Run> {
    let ends = ends_of(&runs);
    let mates = mates(&runs, &ends, reach_px);
    join(runs, &mates)
}

/// The end that each end is joined with, or [`usize::MAX`]: of all pairs the cheapest first.
fn mates(runs: &[Run], ends: &[Option<End>], reach_px: f64) -> Vec<usize> {
    let mut pairs = candidates(runs, ends, reach_px);
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    let mut mates = vec![usize::MAX; ends.len()];
    for (_, a, b) in pairs {
        if mates[a] == usize::MAX && mates[b] == usize::MAX {
            mates[a] = b;
            mates[b] = a;
        }
    }
    mates
}

fn ends_of(runs: &[Run]) -> Vec<Option<End>> {
    (0..2 * runs.len()).map(|end| End::new(runs, end)).collect()
}

/// An end of an open run; end `2 r` is the first point of run `r`, `2 r + 1` its last.
struct End {
    place: [f64; 2],
    depth: f64,
    /// Unit direction out of the run.
    out: [f64; 2],
}

impl End {
    fn new(runs: &[Run], end: usize) -> Option<Self> {
        let run = &runs[end / 2];
        if run.closed || run.cut[end % 2] {
            return None;
        }
        let from_end = |i: usize| match end % 2 {
            0 => &run.points[i],
            _ => &run.points[run.points.len() - 1 - i],
        };
        let tip = from_end(0);
        let inner = (1..run.points.len())
            .map(from_end)
            .find(|point| distance(point.place, tip.place) >= DIRECTION_PX)
            .unwrap_or(from_end(run.points.len() - 1));
        let length = distance(inner.place, tip.place);
        (length > 1e-6).then(|| Self {
            place: tip.place,
            depth: tip.depth,
            out: [0, 1].map(|i| (tip.place[i] - inner.place[i]) / length),
        })
    }
}

fn cell_of(place: [f64; 2], reach_px: f64) -> [i64; 2] {
    place.map(|v| (v / reach_px).floor() as i64)
}

/// Pairs of ends that may be joined, with their cost.
fn candidates(runs: &[Run], ends: &[Option<End>], reach_px: f64) -> Vec<(f64, usize, usize)> {
    let mut cells: BTreeMap<[i64; 2], Vec<usize>> = BTreeMap::new();
    for (index, end) in ends.iter().enumerate() {
        if let Some(end) = end {
            cells
                .entry(cell_of(end.place, reach_px))
                .or_default()
                .push(index);
        }
    }
    let mut pairs = Vec::new();
    for (cell, members) in &cells {
        for neighbour in [[0, 0], [1, 0], [-1, 1], [0, 1], [1, 1]] {
            let Some(others) = cells.get(&[cell[0] + neighbour[0], cell[1] + neighbour[1]]) else {
                continue;
            };
            for a in members {
                for b in others {
                    if neighbour == [0, 0] && a >= b {
                        continue;
                    }
                    if let Some(cost) = cost(runs, ends, [*a, *b], reach_px) {
                        pairs.push((cost, *a.min(b), *a.max(b)));
                    }
                }
            }
        }
    }
    pairs
}

/// How badly two ends fit; none where they must not be joined.
fn cost(runs: &[Run], ends: &[Option<End>], [a, b]: [usize; 2], reach_px: f64) -> Option<f64> {
    let (run_a, run_b) = (&runs[a / 2], &runs[b / 2]);
    let (end_a, end_b) = (ends[a].as_ref()?, ends[b].as_ref()?);
    let alike = run_a.kind == run_b.kind
        && run_a.object == run_b.object
        && run_a.surface == run_b.surface
        && (run_a.occluders > 0) == (run_b.occluders > 0);
    let gap = distance(end_a.place, end_b.place);
    let straight = -(end_a.out[0] * end_b.out[0] + end_a.out[1] * end_b.out[1]);
    let near = (end_a.depth - end_b.depth).abs() <= DEPTH_SHARE * end_a.depth.abs();
    let is_stub = a / 2 == b / 2 && run_a.length() < 4.0 * DIRECTION_PX;
    let across = [0, 1].map(|i| (end_b.place[i] - end_a.place[i]) / gap.max(1e-9));
    let aims =
        |out: [f64; 2], sign: f64| sign * (out[0] * across[0] + out[1] * across[1]) >= AIM_COS;
    let facing = gap <= TOUCHING_PX || (aims(end_a.out, 1.0) && aims(end_b.out, -1.0));
    (alike && gap <= reach_px && straight >= BEND_COS && near && facing && !is_stub)
        .then_some(gap / TOUCHING_PX + (1.0 - straight))
}

/// Follows the mates from run to run: from free ends first, then around what closes.
fn join(runs: Vec<Run>, mates: &[usize]) -> Vec<Run> {
    let mut used = vec![false; runs.len()];
    let open = (0..mates.len()).filter(|end| mates[*end] == usize::MAX);
    let starts = open.chain((0..runs.len()).map(|run| 2 * run));
    let mut found: Vec<(usize, Run)> = Vec::new();
    for start in starts {
        if !used[start / 2] {
            found.push(follow(&runs, mates, start, &mut used));
        }
    }
    found.sort_by_key(|(first, _)| *first);
    found.into_iter().map(|(_, run)| run).collect()
}

/// What is joined from an end on, and the first of its members.
fn follow(runs: &[Run], mates: &[usize], start: usize, used: &mut [bool]) -> (usize, Run) {
    let mut end = start;
    let mut whole = oriented(&runs[end / 2], end);
    let mut first = end / 2;
    // The entry of the run whose way the whole goes, by its id.
    let mut leader = (whole.id, end);
    used[end / 2] = true;
    loop {
        let mate = mates[end ^ 1];
        if mate == usize::MAX {
            break;
        }
        if used[mate / 2] {
            whole.closed = true;
            break;
        }
        used[mate / 2] = true;
        first = first.min(mate / 2);
        leader = leader.min((runs[mate / 2].id, mate));
        extend(&mut whole, &oriented(&runs[mate / 2], mate));
        end = mate;
    }
    if leader.1 % 2 == 1 {
        reverse(&mut whole);
    }
    start_at_head(&mut whole);
    (first, whole)
}

/// The run as travelled from an end.
fn oriented(run: &Run, end: usize) -> Run {
    let mut run = run.clone();
    if end % 2 == 1 {
        reverse(&mut run);
    }
    run
}

fn reverse(run: &mut Run) {
    run.points.reverse();
    run.cut.reverse();
}

fn extend(run: &mut Run, more: &Run) {
    let touches = |a: &RunPoint, b: &RunPoint| distance(a.place, b.place) < 1e-6;
    let skip = usize::from(
        run.points
            .last()
            .is_some_and(|last| touches(last, &more.points[0])),
    );
    run.points.extend_from_slice(&more.points[skip..]);
    run.id = run.id.min(more.id);
    run.occluders = run.occluders.min(more.occluders);
    run.cut[1] = more.cut[1];
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::testing::{ring, run_along, straight};
    use crate::stroke::Kind;
    use proptest::prelude::*;

    #[test]
    fn ends_that_go_on_are_joined() {
        let runs = vec![
            run_along(1, &[[0.0, 0.0], [20.0, 0.0]]),
            run_along(2, &[[22.0, 0.5], [40.0, 0.0]]),
        ];
        let joined = merge_ends(runs, TOUCHING_PX);
        assert_eq!(joined.len(), 1);
        assert_eq!((joined[0].id, joined[0].points.len()), (1, 4));
    }

    #[test]
    fn a_corner_another_object_or_another_kind_keeps_ends_apart() {
        let one = run_along(1, &[[0.0, 0.0], [20.0, 0.0]]);
        let turned = run_along(2, &[[20.0, 0.0], [20.0, 20.0]]);
        let straight = run_along(3, &[[20.0, 0.0], [40.0, 0.0]]);
        let object = Run {
            object: 7,
            ..straight.clone()
        };
        let kind = Run {
            kind: Kind::Crease,
            ..straight.clone()
        };
        for other in [turned, object, kind] {
            assert_eq!(merge_ends(vec![one.clone(), other], TOUCHING_PX).len(), 2);
        }
        assert_eq!(merge_ends(vec![one, straight], TOUCHING_PX).len(), 1);
    }

    #[test]
    fn the_two_ends_of_a_ring_close_it() {
        let open = Run {
            closed: false,
            ..ring(1, 60.0, 200)
        };
        let joined = merge_ends(vec![open], TOUCHING_PX);
        assert!(joined[0].closed);
    }

    #[test]
    fn across_a_gap_ends_must_face_each_other() {
        let one = run_along(1, &[[0.0, 0.0], [20.0, 0.0]]);
        let facing = run_along(2, &[[26.0, 0.0], [50.0, 0.0]]);
        let beside = run_along(3, &[[20.0, 6.0], [50.0, 6.0]]);
        assert_eq!(merge_ends(vec![one.clone(), facing], FACING_PX).len(), 1);
        assert_eq!(merge_ends(vec![one, beside], FACING_PX).len(), 2);
    }

    #[test]
    fn ends_cut_at_a_corner_stay_apart() {
        let mut one = run_along(1, &[[0.0, 0.0], [20.0, 0.0]]);
        let other = run_along(2, &[[20.0, 0.0], [40.0, 1.0]]);
        one.cut = [false, true];
        assert_eq!(merge_ends(vec![one, other], TOUCHING_PX).len(), 2);
    }

    /// Straight runs that crowd in a small picture, of two kinds, objects, visibilities and depths.
    fn crowd() -> impl Strategy<Value = Vec<Run>> {
        let place = prop::array::uniform2(0.0_f64..60.0);
        let run = (place, 0.0_f64..6.3, 7.0_f64..40.0, any::<[bool; 4]>());
        prop::collection::vec(run, 0..40).prop_map(|runs| {
            let made = |(id, run): (u64, ([f64; 2], f64, f64, [bool; 4]))| {
                let (from, angle, length, [kind, object, hidden, far]) = run;
                let mut run = straight(id, from, angle, length);
                run.kind = if kind { Kind::Contour } else { Kind::Crease };
                run.object = u32::from(object);
                run.occluders = u32::from(hidden);
                let depth = if far { 1.02 } else { 1.0 };
                run.points.iter_mut().for_each(|point| point.depth = depth);
                run
            };
            (0..).zip(runs).map(made).collect()
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        /// No two ends are left that both fit each other better than what they got: tried on every pair.
        #[test]
        fn mates_choose_each_other(runs in crowd(), far: bool) {
            let reach = if far { FACING_PX } else { TOUCHING_PX };
            let ends = ends_of(&runs);
            let mates = mates(&runs, &ends, reach);
            let cost_of = |a: usize, b: usize| match b {
                usize::MAX => f64::INFINITY,
                _ => cost(&runs, &ends, [a.min(b), a.max(b)], reach).unwrap_or(f64::NAN),
            };
            for a in 0..ends.len() {
                let own = cost_of(a, mates[a]);
                prop_assert!(!own.is_nan() && (mates[a] == usize::MAX || mates[mates[a]] == a));
                for (b, mate) in mates.iter().enumerate().skip(a + 1) {
                    let both = cost_of(a, b);
                    prop_assert!(!(both < own && both < cost_of(b, *mate)), "{} and {}", a, b);
                }
            }
        }

        /// Only ends of one kind, object, visibility and depth are joined, and none that are far apart.
        #[test]
        fn what_differs_is_never_joined(runs in crowd(), far: bool) {
            let reach = if far { FACING_PX } else { TOUCHING_PX };
            let ends = ends_of(&runs);
            for (a, b) in mates(&runs, &ends, reach).into_iter().enumerate() {
                if b == usize::MAX {
                    continue;
                }
                let (one, other) = (&runs[a / 2], &runs[b / 2]);
                prop_assert_eq!((one.kind, one.object, one.occluders), (other.kind, other.object, other.occluders));
                let tip = |end: usize| {
                    let points = &runs[end / 2].points;
                    points[(end % 2) * (points.len() - 1)]
                };
                prop_assert!((tip(a).depth - tip(b).depth).abs() < 0.011);
                prop_assert!(distance(tip(a).place, tip(b).place) <= reach);
            }
        }

        /// The result hangs on the runs, not on their order.
        #[test]
        fn order_does_not_matter(runs in crowd(), seed: u64) {
            let mut shuffled = runs.clone();
            npr_mesh::testing::Random::new(seed).shuffle(&mut shuffled);
            let joined = |runs| {
                let mut joined = merge_ends(runs, FACING_PX);
                joined.sort_by_key(|run| run.id);
                joined
            };
            prop_assert_eq!(joined(runs), joined(shuffled));
        }

        /// A straight line broken in two is one again; not so where the halves lie at different depths.
        #[test]
        fn a_broken_line_is_mended(angle in 0.0_f64..6.3, parts in prop::array::uniform2(4.0_f64..90.0), gap in 0.0_f64..2.4, turned: bool, apart in 1.02_f64..9.0) {
            let one = straight(1, [100.0; 2], angle, parts[0]);
            let from = [angle.cos(), angle.sin()].map(|v| 100.0 + v * (parts[0] + gap));
            let mut other = straight(2, from, angle, parts[1]);
            if turned {
                reverse(&mut other);
            }
            let joined = merge_ends(vec![one.clone(), other.clone()], TOUCHING_PX);
            prop_assert_eq!(joined.len(), 1);
            prop_assert!((joined[0].length() - parts[0] - parts[1] - gap).abs() < 1e-3);
            prop_assert_eq!(joined[0].points[0], one.points[0], "it goes the way of the first");
            other.points.iter_mut().for_each(|point| point.depth = apart);
            prop_assert_eq!(merge_ends(vec![one, other], TOUCHING_PX).len(), 2);
        }
    }
}
