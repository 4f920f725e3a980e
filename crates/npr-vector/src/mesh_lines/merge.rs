//! Joins runs whose ends meet: those that go the same way, and those that meet at a corner by themselves.
//!
//! Noise in the orientation of faces breaks one outline into loops that touch; to the eye it is one line. A pen goes
//! on where ends face each other, where they run past each other side by side, and around a corner that nothing else
//! leaves. After a frame of a film what it joined stays joined, and what it left apart stays apart, by a margin.

mod continued;
mod limits;

pub(crate) use continued::continued_ends;
pub use limits::{DEPTH_SHARE, STRAIGHT_COS};

use crate::mesh_lines::corner::start_at_head;
use crate::mesh_lines::joints::{Bond, Bonds, JoiningStep, JointsInView, Tip};
use crate::mesh_lines::near::cell_of;
use crate::mesh_lines::run::{Run, RunPoint, distance};
use limits::Limits;
use std::collections::BTreeMap;

/// Greatest distance of two ends that only noise separates, in pixels: the width of a pen, within which nobody tells
/// lines apart.
pub const TOUCHING_PX: f64 = 3.0;

/// Greatest distance of two ends that meet at a corner, in pixels: half a pen's width of paper between the caps is not
/// seen.
const CORNER_PX: f64 = 4.5;

/// Greatest distance of two ends that face each other across a gap, in pixels.
pub const FACING_PX: f64 = 8.0;

/// Length in pixels under which a run is a dot: the direction of its ends is noise.
pub(crate) const DOT_PX: f64 = 8.0;

/// Cost of a corner: more than that of any two ends that go the same way.
const CORNER_COST: f64 = 10.0;

/// Most ends in one cell as wide as the reach; more stay as they are, since nobody could tell which continues which.
const ENDS_MOST: usize = 128;

/// Length of a run over which its direction at an end is taken, in pixels.
const DIRECTION_PX: f64 = 6.0;

/// Runs with ends up to `reach_px` apart joined in pairs, the best pairs first.
///
/// Both must be of one kind, object, surface and visibility; each end is used once. A run whose two ends fit closes.
/// Of ends that run past each other both lose half of the overlap. Around a corner of up to 120 degrees only those
/// ends are joined whose tips are within 4.5 pixels and that no third one of the kind and object comes as near. The
/// result keeps the order of the runs' first members, and runs the way of the one with the least id, whichever comes
/// first. Ends that were cut at corners stay apart, and so do those of more than 128 in one place. O(n log n).
pub fn merge_ends(runs: Vec<Run>, reach_px: f64) -> Vec<Run> {
    merge_held(runs, reach_px, None)
}

/// As [`merge_ends`], after a frame that joints hold to, if any: there limits have margins ([`Limits`]).
pub(crate) fn merge_held(
    mut runs: Vec<Run>,
    reach_px: f64,
    held: Option<(JoiningStep, &mut JointsInView<'_>)>,
) -> Vec<Run> {
    let ends = ends_of(&runs);
    let tips = tips_of(&runs, &ends);
    let bonds = held
        .as_ref()
        .map(|(step, held)| held.bonds(*step, &runs, &tips));
    let bonds = bonds.unwrap_or_default();
    let mates = mates(&Meetings::new(&runs, &ends, reach_px, &bonds));
    if let Some((step, held)) = held {
        held.remember(step, (&runs, &tips), &mates, &bonds);
    }
    trim(&mut runs, &ends, &mates);
    join(runs, &mates)
}

/// The end that each end is joined with, or [`usize::MAX`]: of all pairs the cheapest first.
fn mates(meetings: &Meetings<'_>) -> Vec<usize> {
    let cost = |[a, b]: &[usize; 2]| Some((meetings.cost([*a, *b])?, *a, *b));
    paired(
        meetings.pairs.iter().filter_map(cost).collect(),
        meetings.ends.len(),
    )
}

/// The partner of each of `count` ends, or [`usize::MAX`]: of pairs with their costs the cheapest first, each end once.
fn paired(mut fits: Vec<(f64, usize, usize)>, count: usize) -> Vec<usize> {
    fits.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    let mut mates = vec![usize::MAX; count];
    for (_, a, b) in fits {
        if mates[a] == usize::MAX && mates[b] == usize::MAX {
            mates[a] = b;
            mates[b] = a;
        }
    }
    mates
}

pub(super) fn ends_of(runs: &[Run]) -> Vec<Option<End>> {
    (0..2 * runs.len()).map(|end| End::new(runs, end)).collect()
}

/// Where ends lie, which way they point, and what they are ends of.
pub(super) fn tips_of(runs: &[Run], ends: &[Option<End>]) -> Vec<Option<Tip>> {
    let tip = |(number, end): (usize, &Option<End>)| {
        let (run, end) = (&runs[number / 2], end.as_ref()?);
        Some(Tip {
            place: end.place,
            back_place: end.back_place,
            out: end.out,
            kind: run.kind,
            is_hidden: run.occluders > 0,
        })
    };
    ends.iter().enumerate().map(tip).collect()
}

/// An end of an open run; end `2 r` is the first point of run `r`, `2 r + 1` its last.
pub(super) struct End {
    pub place: [f64; 2],
    /// On the run, as far back as its direction is taken, or at its other end.
    back_place: [f64; 2],
    depth: f64,
    /// Unit direction out of the run.
    pub out: [f64; 2],
    is_dot: bool,
}

impl End {
    fn new(runs: &[Run], end: usize) -> Option<Self> {
        let run = &runs[end / 2];
        if run.closed || run.cut[end % 2] {
            return None;
        }

        // Look back along the line for its direction.
        let from_end = |i: usize| match end % 2 {
            0 => &run.points[i],
            _ => &run.points[run.points.len() - 1 - i],
        };
        let tip = from_end(0);
        let inner = (1..run.points.len())
            .map(from_end)
            .find(|point| distance(point.place, tip.place) >= DIRECTION_PX)
            .unwrap_or(from_end(run.points.len() - 1));

        // Leave out ends without one.
        let length = distance(inner.place, tip.place);
        let share = (DIRECTION_PX / length).min(1.0);
        (length > 1e-6).then(|| Self {
            place: tip.place,
            back_place: [0, 1].map(|i| tip.place[i] + (inner.place[i] - tip.place[i]) * share),
            depth: tip.depth,
            out: [0, 1].map(|i| (tip.place[i] - inner.place[i]) / length),
            is_dot: run.length() < DOT_PX,
        })
    }
}

/// Pairs of ends of runs up to `reach_px` apart, the lower number first; ends that were cut at corners have no pairs.
///
/// End `2 r` is the first point of run `r`, `2 r + 1` its last.
pub(crate) fn near_ends(runs: &[Run], reach_px: f64) -> Vec<[usize; 2]> {
    near_pairs(&ends_of(runs), reach_px)
}

/// Pairs of ends up to `reach_px` apart, the lower number first.
fn near_pairs(ends: &[Option<End>], reach_px: f64) -> Vec<[usize; 2]> {
    // Sort ends into cells as large as the reach, without those so full that nothing could be told.
    let mut cells: BTreeMap<[i64; 2], Vec<(usize, &End)>> = BTreeMap::new();
    for (index, end) in ends.iter().enumerate() {
        if let Some(end) = end {
            let cell = cells.entry(cell_of(end.place, reach_px)).or_default();
            cell.push((index, end));
        }
    }
    cells.retain(|_, members| members.len() <= ENDS_MOST);

    // Compare each cell with half of those around it, so that every pair is met once.
    let mut pairs = Vec::new();
    for (cell, members) in &cells {
        for step in [[0, 0], [1, 0], [-1, 1], [0, 1], [1, 1]] {
            let others = cells.get(&[0, 1].map(|i| cell[i].saturating_add(step[i])));
            for (a, end_a) in members {
                let fits = |(b, end_b): &&(usize, &End)| {
                    (step != [0, 0] || a < b) && distance(end_a.place, end_b.place) <= reach_px
                };
                let near = others.into_iter().flatten().filter(fits);
                pairs.extend(near.map(|(b, _)| [*a.min(b), *a.max(b)]));
            }
        }
    }
    pairs
}

/// The ends that come near each other.
pub(super) struct Meetings<'a> {
    runs: &'a [Run],
    ends: &'a [Option<End>],
    /// What they were in the frame before.
    bonds: &'a Bonds<'a>,
    reach_px: f64,
    /// Their numbers, the lower one first.
    pub pairs: Vec<[usize; 2]>,
    /// For each end, how many others of its kind and object come as near as the ends of a corner.
    beside: Vec<u32>,
}

impl<'a> Meetings<'a> {
    pub fn new(
        runs: &'a [Run],
        ends: &'a [Option<End>],
        reach_px: f64,
        bonds: &'a Bonds<'a>,
    ) -> Self {
        // Find what is near, and what was joined.
        let mut pairs = near_pairs(ends, reach_px);
        if !bonds.is_empty() {
            let is_new = |[a, b]: &[usize; 2]| {
                let ends = ends[*a].as_ref().zip(ends[*b].as_ref());
                ends.is_some_and(|(a, b)| distance(a.place, b.place) > reach_px)
                    && runs[a / 2].may_join(&runs[b / 2])
                    && bonds.of([*a, *b]) == Bond::Continued
            };
            let wide = near_pairs(ends, Limits::of(Bond::Joined).reach * reach_px);
            pairs.extend(wide.into_iter().filter(is_new));
            pairs.extend(bonds.joined());
            pairs.sort_unstable();
            pairs.dedup();
        }
        let mut found = Self {
            runs,
            ends,
            bonds,
            reach_px,
            pairs,
            beside: vec![0; ends.len()],
        };

        // Count what meets at a corner.
        for [a, b] in &found.pairs {
            let (run_a, run_b) = (&runs[a / 2], &runs[b / 2]);
            let alike = run_a.kind == run_b.kind && run_a.object == run_b.object;
            let gap = found.gap([*a, *b]);
            if alike && gap.is_some_and(|gap| gap <= CORNER_PX.min(reach_px)) {
                found.beside[*a] += 1;
                found.beside[*b] += 1;
            }
        }
        found
    }

    fn gap(&self, [a, b]: [usize; 2]) -> Option<f64> {
        let (end_a, end_b) = (self.ends[a].as_ref()?, self.ends[b].as_ref()?);
        Some(distance(end_a.place, end_b.place))
    }

    /// What two ends were in the frame before, if their lines are alike, and both lie about as deep.
    pub fn bond(&self, [a, b]: [usize; 2]) -> Option<Bond> {
        let (end_a, end_b) = (self.ends[a].as_ref()?, self.ends[b].as_ref()?);
        let apart = (end_a.depth - end_b.depth).abs();
        let is_within = |bond: Bond| apart <= Limits::of(bond).depth_share * end_a.depth.abs();
        let may_be = is_within(Bond::Joined) && self.runs[a / 2].may_join(&self.runs[b / 2]);
        let bond = may_be.then(|| self.bonds.of([a, b]));
        bond.filter(|bond| is_within(*bond))
    }

    /// How badly two ends fit; `None` where they must not be joined.
    fn cost(&self, [a, b]: [usize; 2]) -> Option<f64> {
        // Leave out what is not alike.
        let run_a = &self.runs[a / 2];
        let (end_a, end_b) = (self.ends[a].as_ref()?, self.ends[b].as_ref()?);
        let same = a / 2 == b / 2;
        if same && run_a.length() < 4.0 * DIRECTION_PX {
            return None;
        }
        let limits = Limits::of(self.bond([a, b])?);

        // Look whether one goes on as the other, or they meet at a corner.
        let gap = self.gap([a, b])?;
        let straight = -dot(end_a.out, end_b.out);
        let is_near = gap <= limits.reach * self.reach_px;
        let cost = gap / TOUCHING_PX + (1.0 - straight) - limits.favour;
        let alone = limits.is_joined || self.beside[a] == 1 && self.beside[b] == 1;
        let at_corner =
            alone && gap <= limits.reach * CORNER_PX && straight >= limits.corner_cos && !same;
        match is_near && go_on(end_a, end_b, &limits) {
            true => Some(cost),
            false => (is_near && at_corner).then_some(CORNER_COST + cost),
        }
    }
}

/// Whether one end continues the other: they touch, point at each other, or have run past each other side by side.
fn go_on(a: &End, b: &End, limits: &Limits) -> bool {
    let gap = distance(a.place, b.place);
    let straight = -dot(a.out, b.out);
    let touching_px = limits.reach * TOUCHING_PX;
    if gap <= touching_px && (a.is_dot || b.is_dot) {
        return straight >= limits.dot_cos;
    }
    let across = [0, 1].map(|i| b.place[i] - a.place[i]);
    let ahead = [dot(across, a.out), -dot(across, b.out)];
    let aim = ahead
        .iter()
        .all(|ahead| *ahead >= limits.straight_cos * gap);
    // How far each lies beside the line of the other.
    let beside = |ahead: &f64| *ahead <= 0.0 && gap * gap - ahead * ahead <= touching_px.powi(2);
    let facing = gap <= touching_px || aim || ahead.iter().all(beside);
    facing && straight >= limits.straight_cos
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// Takes half of the overlap off ends that have run past their mates.
fn trim(runs: &mut [Run], ends: &[Option<End>], mates: &[usize]) {
    for (end, mate) in mates.iter().enumerate() {
        let other = ends.get(*mate).and_then(Option::as_ref);
        let (Some(own), Some(other)) = (&ends[end], other) else {
            continue;
        };
        let across = [0, 1].map(|i| other.place[i] - own.place[i]);
        let along = [0, 1].map(|i| own.out[i] - other.out[i]);
        if -dot(own.out, other.out) < STRAIGHT_COS || dot(across, along) >= 0.0 {
            continue;
        }
        let middle = [0, 1].map(|i| (own.place[i] + other.place[i]) / 2.0);
        let is_past =
            |point: &&RunPoint| dot([0, 1].map(|i| point.place[i] - middle[i]), along) > 0.0;
        let points = &mut runs[end / 2].points;
        // A run keeps two points.
        let most = points.len().saturating_sub(2);
        if end % 2 == 0 {
            let past = points.iter().take(most).take_while(is_past).count();
            points.drain(..past);
        } else {
            let past = points.iter().rev().take(most).take_while(is_past).count();
            points.truncate(points.len() - past);
        }
    }
}

/// Follows the mates from run to run: from free ends first, then around what closes.
pub(super) fn join(runs: Vec<Run>, mates: &[usize]) -> Vec<Run> {
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

/// The run joined from an end on, and the first of its members.
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
            rest_end(&mut whole);
            let (last, first) = (whole.points.len() - 1, whole.points[0]);
            whole.points[last].leaps = !meets(&whole.points[last], &first);
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
        whole.reverse();
    }
    start_at_head(&mut whole);
    (first, whole)
}

/// The run as travelled from an end.
fn oriented(run: &Run, end: usize) -> Run {
    let mut run = run.clone();
    if end % 2 == 1 {
        run.reverse();
    }
    run
}

/// Whether two points are one, in the picture and in the world.
fn meets(a: &RunPoint, b: &RunPoint) -> bool {
    let near = 1e-6 * a.world.abs().max_element().max(a.depth.abs());
    distance(a.place, b.place) < 1e-6 && a.world.distance(b.world) <= near
}

/// Makes the end of a line lie on what its last piece lies on.
fn rest_end(run: &mut Run) {
    let last = run.points.len() - 1;
    run.points[last].location = run.location_at(last);
    run.points[last].leaps = false;
}

/// Extends a line by another, across the gap between them where there is one.
fn extend(run: &mut Run, more: &Run) {
    rest_end(run);
    let last = run.points.len() - 1;
    let skip = usize::from(meets(&run.points[last], &more.points[0]));
    match more.points.first().filter(|_| skip > 0) {
        Some(first) => {
            (run.points[last].location, run.points[last].leaps) = (first.location, first.leaps)
        }
        None => run.points[last].leaps = true,
    }
    run.points.extend_from_slice(&more.points[skip..]);
    run.id = run.id.min(more.id);
    run.occluders = run.occluders.min(more.occluders);
    run.cut[1] = more.cut[1];
    run.beyond[1] = more.beyond[1];
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh_lines::run::testing::{ring, run_along, straight};
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
    fn a_way_back_another_object_or_another_kind_keeps_ends_apart() {
        let one = run_along(1, &[[0.0, 0.0], [20.0, 0.0]]);
        let turned = run_along(2, &[[20.0, 0.0], [5.0, 10.0]]);
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

    #[test]
    fn dots_that_touch_are_one_line_and_others_dots() {
        let dot = |id: u64, x: f64| run_along(id, &[[x, 0.0], [x + 2.0, 2.0]]);
        let row = |step: f64| (0..3).map(|i| dot(i, step * i as f64)).collect();
        assert_eq!(merge_ends(row(3.0), FACING_PX).len(), 1);
        assert_eq!(merge_ends(row(7.0), FACING_PX).len(), 3);
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
                let depth = if far { 1.05 } else { 1.0 };
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
            let bonds = Bonds::default();
            let meetings = Meetings::new(&runs, &ends, reach, &bonds);
            let mates = mates(&meetings);
            let cost_of = |a: usize, b: usize| match b {
                usize::MAX => f64::INFINITY,
                _ if meetings.gap([a, b]).is_none_or(|gap| gap > reach) => f64::NAN,
                _ => meetings.cost([a.min(b), a.max(b)]).unwrap_or(f64::NAN),
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
            for (a, b) in mates(&Meetings::new(&runs, &ends, reach, &Bonds::default())).into_iter().enumerate() {
                if b == usize::MAX {
                    continue;
                }
                let (one, other) = (&runs[a / 2], &runs[b / 2]);
                prop_assert_eq!((one.kind, one.object, one.occluders), (other.kind, other.object, other.occluders));
                let tip = |end: usize| {
                    let points = &runs[end / 2].points;
                    points[(end % 2) * (points.len() - 1)]
                };
                prop_assert!((tip(a).depth - tip(b).depth).abs() < 0.031);
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
        fn a_broken_line_is_mended(
            angle in 0.0_f64..6.3, parts in prop::array::uniform2(4.0_f64..90.0), gap in 0.0_f64..2.4, turned: bool,
            apart in 1.04_f64..9.0,
        ) {
            let one = straight(1, [100.0; 2], angle, parts[0]);
            let from = [angle.cos(), angle.sin()].map(|v| 100.0 + v * (parts[0] + gap));
            let mut other = straight(2, from, angle, parts[1]);
            if turned {
                other.reverse();
            }
            let joined = merge_ends(vec![one.clone(), other.clone()], TOUCHING_PX);
            prop_assert_eq!(joined.len(), 1);
            prop_assert!((joined[0].length() - parts[0] - parts[1] - gap).abs() < 1e-3);
            prop_assert_eq!(joined[0].points[0], one.points[0], "it goes the way of the first");
            other.points.iter_mut().for_each(|point| point.depth = apart);
            prop_assert_eq!(merge_ends(vec![one, other], TOUCHING_PX).len(), 2);
        }

        /// Ends that have run past each other by up to the reach become one line without a way back.
        #[test]
        fn ends_beside_each_other_are_one_line(
            angle in 0.0_f64..6.3, off in -2.4_f64..2.4, over in 0.0_f64..7.0, turned: bool,
        ) {
            let [sin, cos] = [angle.sin(), angle.cos()];
            let one = straight(1, [100.0; 2], angle, 40.0);
            let along = 40.0 - over;
            let from = [100.0 + along * cos - off * sin, 100.0 + along * sin + off * cos];
            let mut other = straight(2, from, angle, 40.0);
            if turned {
                other.reverse();
            }
            let joined = merge_ends(vec![one, other], FACING_PX);
            prop_assert_eq!(joined.len(), 1);
            let stations: Vec<f64> = joined[0].points.iter().map(|p| dot(p.place, [cos, sin])).collect();
            prop_assert!(stations.is_sorted_by(|a, b| *a < b + 1e-6), "{:?}", stations);
            prop_assert!((joined[0].length() - 80.0 + over).abs() < 3.0);
        }

        /// A pen goes around a corner that two lines share, not around one of three, nor back.
        #[test]
        fn corners_of_two_lines_are_turned(angle in 0.0_f64..6.3, turn in -3.1_f64..3.1, length in 9.0_f64..60.0) {
            let from = [100.0 + length * angle.cos(), 100.0 + length * angle.sin()];
            let one = straight(1, [100.0; 2], angle, length);
            let other = straight(2, from, angle + turn, length);
            let count = |runs: &[&Run]| merge_ends(runs.iter().map(|run| (*run).clone()).collect(), TOUCHING_PX).len();
            let turns = turn.abs() < 2.0;
            if (turn.abs() - 2.094).abs() > 0.01 {
                prop_assert_eq!(count(&[&one, &other]), if turn.abs() < 2.094 { 1 } else { 2 });
            }
            // A third one, straight away from the corner between both.
            let third = straight(3, from, angle + turn / 2.0 + std::f64::consts::FRAC_PI_2, length);
            if turns && turn.abs() > 1.2 {
                prop_assert_eq!(count(&[&one, &other, &third]), 3);
            }
        }

        /// Any numbers may come, and whatever is left has points.
        #[test]
        fn any_places_may_be_joined(
            places in prop::collection::vec(prop::collection::vec(any::<[f64; 2]>(), 2..5), 0..9), far: bool,
        ) {
            let runs: Vec<Run> = (0..).zip(&places).map(|(id, places)| run_along(id, places)).collect();
            let joined = merge_ends(runs, if far { FACING_PX } else { TOUCHING_PX });
            prop_assert!(joined.iter().all(|run| run.points.len() >= 2));
        }
    }
}
