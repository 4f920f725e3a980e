//! Which ends of lines were joined in the frame before, and which were left apart.
//!
//! Whether two ends are joined is decided by limits, and in films many ends lie near one. So what was joined stays so
//! until it passes the limit by a margin, and what was apart is joined only where it is within by a margin
//! ([`Limits`](super::merge::Limits)). Each step that joins ends remembers what it decided itself: what lies beside a
//! line in the end, as a double does, was not joined to it.

use crate::mesh_lines::anchor::Anchor;
use crate::mesh_lines::near::{Cells, cells_within};
use crate::mesh_lines::run::{Run, distance};
use crate::project::Projector;
use crate::stroke::Kind;
use glam::DVec3;
use npr_core::geometry::NONE;
use npr_mesh::half_edge::HalfEdgeMesh;
use rayon::prelude::*;

/// Distance up to which an end may be one of the frame before, in pixels.
const REACH_PX: f64 = 8.0;

/// Side of the cells that ends are sorted into: what is within reach lies in four of them.
const CELL_PX: f64 = 2.0 * REACH_PX;

/// Least cosine between the directions of both.
const LEAST_COS: f64 = 0.5;

/// How much nearer an end has to be whose direction is across, whose line had another name, and that was not there in
/// the frame before, for each frame; in pixels.
const ACROSS_PX: f64 = 4.0;
const OTHER_NAME_PX: f64 = 0.5;
const OLDER_PX: f64 = 0.5;

/// Least number of ends that are worth a thread of their own.
const LEAST_SHARED: usize = 128;

/// Frames for which joints are remembered whose ends are not there.
const FRAMES_MOST: u8 = 4;

/// Cosine of the largest angle by which a camera turns from frame to frame; beyond it is another picture.
const TURN_COS: f64 = 0.87;

/// Least share of ends that have to find one of the frame before; with fewer it is another picture.
const LEAST_SHARE: f64 = 0.2;

/// The ends of lines of a frame and which of them were joined, as far as the next frame needs them: 64 bytes an end
/// for each of three steps.
#[derive(Debug, Clone, Default)]
pub struct HeldJoints {
    steps: [Vec<HeldEnd>; 3],
    /// Where the camera looked.
    forward: Option<DVec3>,
}

/// A step that joins ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum JoiningStep {
    /// Ends that touch.
    Touching,
    /// Ends that face each other.
    Facing,
    /// Ends of contours on both sides of a gap.
    Bridged,
}

/// An end that was there.
#[derive(Debug, Clone, Copy, PartialEq)]
struct HeldEnd {
    anchor: Anchor,
    /// Unit direction out of its line.
    out: [f32; 2],
    /// Name of its line in its frame.
    id: u64,
    /// Number of the end that it was joined with, or [`NONE`].
    mate: u32,
    kind: Kind,
    is_hidden: bool,
    /// Frames for which it was not there.
    age: u8,
}

const _: () = assert!(size_of::<HeldEnd>() <= 64, "an end takes 64 bytes at most");

/// An end of a line of this frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tip {
    /// In the picture, in pixels.
    pub place: [f64; 2],
    /// On its line, some pixels back from there: where the line is not longer its other end.
    pub back_place: [f64; 2],
    /// Unit direction out of the line.
    pub out: [f64; 2],
    /// What the line is drawn as.
    pub kind: Kind,
    /// Whether something hides it.
    pub is_hidden: bool,
}

/// What was drawn between two places in the frame before.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DrawnBetween {
    /// One line went on from the one to the other.
    Line,
    /// A line ended near one of them.
    End,
    /// Nothing of both.
    Nothing,
}

/// Tells what was drawn between two ends in the frame before.
pub type WasBetween<'a> = &'a dyn Fn(&[Tip; 2]) -> DrawnBetween;

/// The joints of the frame before, in the view of this one.
pub struct JointsInView<'a> {
    held: &'a mut HeldJoints,
    shape: &'a HalfEdgeMesh,
    projector: &'a Projector,
    was_between: WasBetween<'a>,
}

/// What two ends were in the frame before.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Bond {
    /// One of them was not there, and no line ended near; or nobody can tell.
    New,
    /// They were joined.
    Joined,
    /// A line went on between them.
    Continued,
    /// They were there and not joined with each other, or a line ended there.
    Apart,
}

/// What the ends of this frame were in the frame before.
#[derive(Clone, Default)]
pub(crate) struct Bonds<'a> {
    tips: Vec<Option<Tip>>,
    /// For each end the number of the one that it was, or [`NONE`]; empty where nothing was before.
    was: Vec<u32>,
    /// For each end of the frame before the one that it is, or [`NONE`].
    is: Vec<u32>,
    /// The ends of the frame before.
    before: Vec<HeldEnd>,
    was_between: Option<WasBetween<'a>>,
    /// Whether what was drawn counts as much as which ends were joined.
    is_by_drawing: bool,
}

impl Bonds<'_> {
    /// What two ends were.
    ///
    /// Where doubles of lines are left, ends beside a line that is drawn are told apart by what they were joined with
    /// alone. Later what was drawn tells as much, as of many ends in one place it is a guess which is which: where both
    /// disagree the ends are new.
    pub fn of(&self, pair: [usize; 2]) -> Bond {
        let by_ends = self.by_ends(pair);
        if by_ends != Bond::New && !self.is_by_drawing {
            return by_ends;
        }
        match (self.by_drawing(pair), by_ends) {
            (Bond::New, _) | (Bond::Continued, Bond::Joined) => by_ends,
            (Bond::Continued, Bond::Apart) | (Bond::Apart, Bond::Joined) => Bond::New,
            (by_drawing, _) => by_drawing,
        }
    }

    /// What two ends were that were both there.
    fn by_ends(&self, [a, b]: [usize; 2]) -> Bond {
        let was = |end: usize| self.was.get(end).copied().filter(|was| *was != NONE);
        match (was(a), was(b)) {
            (Some(a), Some(b)) if self.before[a as usize].mate == b => Bond::Joined,
            (Some(_), Some(_)) => Bond::Apart,
            _ => Bond::New,
        }
    }

    /// What was drawn between two ends.
    fn by_drawing(&self, [a, b]: [usize; 2]) -> Bond {
        let tip = |end: usize| self.tips.get(end).copied().flatten();
        let (Some(was_between), Some(a), Some(b)) = (self.was_between, tip(a), tip(b)) else {
            return Bond::New;
        };
        match was_between(&[a, b]) {
            DrawnBetween::Line => Bond::Continued,
            DrawnBetween::End => Bond::Apart,
            DrawnBetween::Nothing => Bond::New,
        }
    }

    /// Whether nothing was before.
    pub fn is_empty(&self) -> bool {
        self.was_between.is_none()
    }

    /// The pairs of ends that were joined, the lower number first.
    pub fn joined(&self) -> impl Iterator<Item = [usize; 2]> {
        self.is.iter().zip(&self.before).filter_map(|(a, end)| {
            let b = *self.is.get(end.mate as usize)?;
            (*a != NONE && b != NONE && *a < b).then_some([*a as usize, b as usize])
        })
    }
}

impl HeldJoints {
    /// The joints of the frame before, for a view of the shape as it is posed now; none where the camera jumped.
    pub fn in_view<'a>(
        &'a mut self,
        shape: &'a HalfEdgeMesh,
        projector: &'a Projector,
        was_between: WasBetween<'a>,
    ) -> JointsInView<'a> {
        let forward = projector.forward();
        if self
            .forward
            .is_some_and(|before| before.dot(forward) < TURN_COS)
        {
            *self = Self::default();
        }
        self.forward = Some(forward);
        JointsInView {
            held: self,
            shape,
            projector,
            was_between,
        }
    }
}

impl<'a> JointsInView<'a> {
    /// What the ends of some runs were when a step joined those of the frame before; end `2 r` is the first of run
    /// `r`.
    pub(crate) fn bonds(&self, step: JoiningStep, runs: &[Run], tips: &[Option<Tip>]) -> Bonds<'a> {
        let before = &self.held.steps[step as usize];
        if before.is_empty() {
            return Bonds::default();
        }

        // Find what is known in the new view.
        let place_of = |end: &HeldEnd| end.anchor.place(self.shape, self.projector);
        let places: Vec<Option<[f64; 2]>> = before
            .par_iter()
            .with_min_len(LEAST_SHARED)
            .map(place_of)
            .collect();
        let mut near = Cells::with_room(CELL_PX, before.len());
        for (place, number) in places.into_iter().zip(0_u32..) {
            if let Some(place) = place {
                near.add(place, (number, place));
            }
        }

        // Compare each end with those around it.
        let fits_of = |(number, tip): (usize, &Option<Tip>)| -> Vec<(f64, usize, u32)> {
            let Some(tip) = tip else { return Vec::new() };
            let id = runs[number / 2].id;
            let fit = |(other, place): &(u32, [f64; 2])| {
                let end = &before[*other as usize];
                let cos = tip.out[0] * f64::from(end.out[0]) + tip.out[1] * f64::from(end.out[1]);
                let away = distance(*place, tip.place);
                let is_alike = (end.kind, end.is_hidden) == (tip.kind, tip.is_hidden);
                let cost = away
                    + ACROSS_PX * (1.0 - cos)
                    + OTHER_NAME_PX * f64::from(u8::from(end.id != id))
                    + OLDER_PX * f64::from(end.age);
                (is_alike && cos >= LEAST_COS && away <= REACH_PX).then_some((cost, number, *other))
            };
            let around = near.of(cells_within(tip.place, REACH_PX, CELL_PX));
            around.filter_map(fit).collect()
        };
        let of_tips = tips.par_iter().enumerate().with_min_len(LEAST_SHARED);
        let mut fits: Vec<(f64, usize, u32)> = of_tips.flat_map_iter(fits_of).collect();

        // Take the best ones, each end once.
        fits.par_sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
        let mut found = Bonds {
            tips: tips.to_vec(),
            was: vec![NONE; tips.len()],
            is: vec![NONE; before.len()],
            before: before.clone(),
            was_between: Some(self.was_between),
            is_by_drawing: step != JoiningStep::Touching,
        };
        for (_, number, other) in fits {
            let (was, is) = (&mut found.was[number], &mut found.is[other as usize]);
            if *was == NONE && *is == NONE {
                (*was, *is) = (other, number as u32);
            }
        }

        // Forget all of another picture.
        let all = tips.iter().flatten().count();
        let known = found.was.iter().filter(|was| **was != NONE).count();
        match (known as f64) < LEAST_SHARE * all as f64 {
            true => Bonds::default(),
            false => found,
        }
    }

    /// Remembers which ends a step joined, `usize::MAX` for none, and joints whose ends are not there.
    pub(crate) fn remember(
        &mut self,
        step: JoiningStep,
        (runs, tips): (&[Run], &[Option<Tip>]),
        mates: &[usize],
        bonds: &Bonds<'_>,
    ) {
        // Number the ends.
        let mut numbers = vec![NONE; tips.len()];
        let mut count = 0;
        for (number, tip) in numbers.iter_mut().zip(tips) {
            if tip.is_some() {
                *number = count;
                count += 1;
            }
        }

        // Keep what was decided.
        let mut ends: Vec<HeldEnd> = Vec::with_capacity(count as usize);
        for (number, tip) in tips.iter().enumerate() {
            let Some(tip) = tip else { continue };
            let run = &runs[number / 2];
            let index = (number % 2) * (run.points.len() - 1);
            let place = (tip.place, run.points[index].world);
            ends.push(HeldEnd {
                anchor: Anchor::new(place, run.location_at(index), self.shape, self.projector),
                out: tip.out.map(|v| v as f32),
                id: run.id,
                mate: numbers.get(mates[number]).copied().unwrap_or(NONE),
                kind: tip.kind,
                is_hidden: tip.is_hidden,
                age: 0,
            });
        }

        // Keep joints that are not there for some frames.
        let before = &bonds.before;
        let is_gone = |number: usize| bonds.is.get(number) == Some(&NONE);
        for (number, end) in before.iter().enumerate() {
            let mate = end.mate as usize;
            if number < mate && end.mate != NONE && is_gone(number) && is_gone(mate) {
                let pair = [end, &before[mate]];
                if pair.iter().all(|end| end.age < FRAMES_MOST) {
                    let first = ends.len() as u32;
                    for (end, mate) in pair.into_iter().zip([first + 1, first]) {
                        ends.push(HeldEnd {
                            mate,
                            age: end.age + 1,
                            ..*end
                        });
                    }
                }
            }
        }
        self.held.steps[step as usize] = ends;
    }
}

#[cfg(test)]
mod tests;
