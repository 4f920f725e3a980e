//! Contours that go on across a gap in which nothing is drawn.
//!
//! Where a fold is shallow, as between lips, its contour ends in a cusp and begins anew a little farther on. A pen that
//! comes from one of them to the other is not lifted between.

use crate::mesh_lines::joints::{Bond, JoiningStep, JointsInView};
use crate::mesh_lines::merge::{Meetings, ends_of, join, tips_of};
use crate::mesh_lines::run::Run;
use crate::stroke::Kind;
use glam::DVec2;

/// Widest gap, in pixels.
const BRIDGED_PX: f64 = 20.0;

/// Widest gap as a share of the shorter of both lines: rows of short lines are meant as such.
const BRIDGED_SHARE: f64 = 0.75;

/// Cosine of the largest angle between an end and the gap, and between both ends.
const STRAIGHT_COS: f64 = 0.94;

/// How far other lines stay away from the gap, in pixels: one that comes nearer may hide what is between.
const CLEAR_PX: f64 = 4.0;

/// The limits within which a gap is bridged.
struct Limits {
    /// Factor on the widest gap.
    reach: f64,
    /// As [`BRIDGED_SHARE`].
    share: f64,
    /// As [`STRAIGHT_COS`].
    straight_cos: f64,
    /// As [`CLEAR_PX`].
    clear_px: f64,
}

impl Limits {
    /// The limits for two ends, by what they were in the frame before.
    fn of(bond: Bond) -> Self {
        let [reach, share, straight_cos, clear_px] = match bond {
            Bond::New => [1.0, BRIDGED_SHARE, STRAIGHT_COS, CLEAR_PX],
            Bond::Joined | Bond::Continued => [1.3, 0.9, 0.88, 2.5],
            Bond::Apart => [0.75, 0.6, 0.965, 5.0],
        };
        Self {
            reach,
            share,
            straight_cos,
            clear_px,
        }
    }
}

/// Visible contours joined across gaps of up to 20 pixels, the narrowest first.
///
/// Both ends point at each other within 20 degrees, no other visible line comes within 4 pixels of the gap, and it is
/// at most three quarters as long as the shorter of both lines. Otherwise as
/// [`merge_ends`](super::merge::merge_ends). After a frame that joints hold to these limits have margins.
/// O(n log n + gaps · runs).
pub(crate) fn bridge_gaps(runs: Vec<Run>, held: Option<&mut JointsInView<'_>>) -> Vec<Run> {
    // Find gaps between ends that point at each other.
    let ends = ends_of(&runs);
    let tips = tips_of(&runs, &ends);
    let bonds = held
        .as_ref()
        .map(|held| held.bonds(JoiningStep::Bridged, &runs, &tips));
    let bonds = bonds.unwrap_or_default();
    let meetings = Meetings::new(&runs, &ends, BRIDGED_PX, &bonds);
    let faces = |[a, b]: [usize; 2]| -> Option<Gap> {
        let (end_a, end_b) = (ends[a].as_ref()?, ends[b].as_ref()?);
        let [from, to] = [end_a, end_b].map(|end| DVec2::from(end.place));
        let [out_a, out_b] = [end_a, end_b].map(|end| DVec2::from(end.out));
        let (length, across) = ((to - from).length(), to - from);
        let between = [a, b].map(|end| &runs[end / 2]);
        let is_contour =
            |run: &&Run| run.kind == Kind::Contour && run.occluders == 0 && !run.closed;
        if a / 2 == b / 2 || !between.iter().all(is_contour) {
            return None;
        }
        let limits = Limits::of(meetings.bond([a, b])?);
        let aims = [out_a, -out_b]
            .iter()
            .all(|out| out.dot(across) >= limits.straight_cos * length);
        let is_long = |run: &&Run| length <= limits.share * run.length();
        let is_so = aims
            && length <= limits.reach * BRIDGED_PX
            && -out_a.dot(out_b) >= limits.straight_cos
            && between.iter().all(is_long);
        is_so.then_some(Gap {
            ends: [a, b],
            from,
            to,
            clear_px: limits.clear_px,
        })
    };
    let mut gaps: Vec<Gap> = meetings
        .pairs
        .iter()
        .filter_map(|pair| faces(*pair))
        .collect();

    // Join across those in which nothing else is.
    gaps.sort_by(|a, b| a.length().total_cmp(&b.length()).then(a.ends.cmp(&b.ends)));
    let boxes: Vec<[DVec2; 2]> = match gaps.is_empty() {
        true => Vec::new(),
        false => runs.iter().map(bounds_of).collect(),
    };
    let mut mates = vec![usize::MAX; ends.len()];
    for gap in gaps {
        let [a, b] = gap.ends;
        if mates[a] == usize::MAX && mates[b] == usize::MAX && gap.is_clear(&runs, &boxes) {
            mates[a] = b;
            mates[b] = a;
        }
    }
    if let Some(held) = held {
        held.remember(JoiningStep::Bridged, (&runs, &tips), &mates, &bonds);
    }
    match boxes.is_empty() {
        true => runs,
        false => join(runs, &mates),
    }
}

/// A gap between two ends of runs.
struct Gap {
    ends: [usize; 2],
    from: DVec2,
    to: DVec2,
    /// How far other lines stay away from it, in pixels.
    clear_px: f64,
}

impl Gap {
    fn length(&self) -> f64 {
        self.from.distance(self.to)
    }

    /// Whether no visible run comes near it but those that it lies between.
    fn is_clear(&self, runs: &[Run], boxes: &[[DVec2; 2]]) -> bool {
        let [low, high] = [
            self.from.min(self.to) - self.clear_px,
            self.from.max(self.to) + self.clear_px,
        ];
        let others = runs
            .iter()
            .zip(boxes)
            .enumerate()
            .filter(|(number, (run, reach))| {
                let is_own = self.ends.iter().any(|end| end / 2 == *number);
                let overlaps = reach[0].cmple(high).all() && reach[1].cmpge(low).all();
                !is_own && run.occluders == 0 && overlaps
            });
        others.into_iter().all(|(_, (run, _))| {
            let back = run.points.first().filter(|_| run.closed);
            let next = run.points.iter().skip(1).chain(back);
            let mut pieces = run.points.iter().zip(next);
            pieces.all(|(a, b)| {
                self.distance_to(DVec2::from(a.place), DVec2::from(b.place)) > self.clear_px
            })
        })
    }

    /// Distance from a straight piece of line.
    fn distance_to(&self, a: DVec2, b: DVec2) -> f64 {
        let side = |a: DVec2, b: DVec2, p: DVec2| (b - a).perp_dot(p - a);
        let crosses = side(a, b, self.from) * side(a, b, self.to) < 0.0
            && side(self.from, self.to, a) * side(self.from, self.to, b) < 0.0;
        let ends = [
            distance(self.from, a, b),
            distance(self.to, a, b),
            distance(a, self.from, self.to),
            distance(b, self.from, self.to),
        ];
        match crosses {
            true => 0.0,
            false => ends.into_iter().fold(f64::MAX, f64::min),
        }
    }
}

/// Distance of a place from a straight piece of line.
fn distance(place: DVec2, a: DVec2, b: DVec2) -> f64 {
    let along = b - a;
    let share = (place - a).dot(along) / along.length_squared().max(1e-30);
    place.distance(a + along * share.clamp(0.0, 1.0))
}

/// The least and the greatest coordinates of a run.
fn bounds_of(run: &Run) -> [DVec2; 2] {
    let places = run.points.iter().map(|point| DVec2::from(point.place));
    places.fold([DVec2::MAX, DVec2::MIN], |[low, high], place| {
        [low.min(place), high.max(place)]
    })
}

#[cfg(test)]
mod tests;
