//! Which ends of lines were joined in the frame before, and which were left apart.
//!
//! Whether two ends are joined is decided by limits, and in films many ends lie near one. So what was joined stays so
//! until it passes the limit by a margin, and what was apart is joined only where it is within by a margin
//! ([`Limits`](super::merge::Limits)). Each step that joins ends remembers what it decided itself: what lies beside a
//! line in the end, as a double does, was not joined to it.

use crate::mesh_lines::anchor::Anchor;
use crate::mesh_lines::near::{Cells, cell_of, cells_around};
use crate::mesh_lines::run::{Run, distance};
use crate::project::Projector;
use crate::stroke::Kind;
use glam::DVec3;
use npr_core::geometry::NONE;
use npr_mesh::half_edge::HalfEdgeMesh;

/// Distance up to which an end may be one of the frame before, in pixels.
const REACH_PX: f64 = 8.0;

/// Least cosine between the directions of both.
const LEAST_COS: f64 = 0.5;

/// How much nearer an end has to be whose direction is across, whose line had another name, and that was not there in
/// the frame before, for each frame; in pixels.
const ACROSS_PX: f64 = 4.0;
const OTHER_NAME_PX: f64 = 0.5;
const OLDER_PX: f64 = 0.5;

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

/// An end of this frame.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Tip {
    /// In the picture, in pixels.
    pub place: [f64; 2],
    /// Unit direction out of the run.
    pub out: [f64; 2],
}

/// The joints of the frame before, in the view of this one.
pub(crate) struct JointsInView<'a> {
    pub held: &'a mut HeldJoints,
    pub shape: &'a HalfEdgeMesh,
    pub projector: &'a Projector,
}

/// What two ends were in the frame before.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Bond {
    /// One of them was not there.
    New,
    /// They were joined.
    Joined,
    /// They were there and not joined with each other.
    Apart,
}

/// What the ends of this frame were in the frame before.
#[derive(Debug, Clone, Default)]
pub(crate) struct Bonds {
    /// For each end the number of the one that it was, or [`NONE`]; empty where nothing was before.
    was: Vec<u32>,
    /// For each end of the frame before the one that it is, or [`NONE`].
    is: Vec<u32>,
    /// For each end of the frame before the one that it was joined with, or [`NONE`].
    mates: Vec<u32>,
}

impl Bonds {
    /// What two ends were.
    pub fn of(&self, [a, b]: [usize; 2]) -> Bond {
        let was = |end: usize| self.was.get(end).copied().filter(|was| *was != NONE);
        match (was(a), was(b)) {
            (Some(a), Some(b)) if self.mates[a as usize] == b => Bond::Joined,
            (Some(_), Some(_)) => Bond::Apart,
            _ => Bond::New,
        }
    }

    /// Whether nothing was before.
    pub fn is_empty(&self) -> bool {
        self.was.is_empty()
    }

    /// The pairs of ends that were joined, the lower number first.
    pub fn joined(&self) -> impl Iterator<Item = [usize; 2]> {
        let pairs = self.is.iter().zip(&self.mates).filter_map(|(a, mate)| {
            let b = *self.is.get(*mate as usize)?;
            (*a != NONE && b != NONE && *a < b).then_some([*a as usize, b as usize])
        });
        pairs
    }
}

impl HeldJoints {
    /// The joints of the frame before, for a view of the shape as it is posed now; none where the camera jumped.
    pub(crate) fn in_view<'a>(
        &'a mut self,
        shape: &'a HalfEdgeMesh,
        projector: &'a Projector,
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
        }
    }
}

impl JointsInView<'_> {
    /// What the ends of some runs were when a step joined those of the frame before; end `2 r` is the first of run `r`.
    pub fn bonds(&self, step: JoiningStep, runs: &[Run], tips: &[Option<Tip>]) -> Bonds {
        let before = &self.held.steps[step as usize];
        if before.is_empty() {
            return Bonds::default();
        }

        // Find what is known in the new view.
        let mut near = Cells::new(REACH_PX);
        for (end, number) in before.iter().zip(0_u32..) {
            if let Some(place) = end.anchor.place(self.shape, self.projector) {
                near.add(place, (number, place));
            }
        }

        // Compare each end with those around it.
        let mut fits: Vec<(f64, usize, u32)> = Vec::new();
        for (number, tip) in tips.iter().enumerate() {
            let Some(tip) = tip else { continue };
            let run = &runs[number / 2];
            for (other, place) in near.of(cells_around(cell_of(tip.place, REACH_PX))) {
                let end = &before[*other as usize];
                let cos = tip.out[0] * f64::from(end.out[0]) + tip.out[1] * f64::from(end.out[1]);
                let away = distance(*place, tip.place);
                let is_alike = end.kind == run.kind && end.is_hidden == (run.occluders > 0);
                if is_alike && cos >= LEAST_COS && away <= REACH_PX {
                    let cost = away
                        + ACROSS_PX * (1.0 - cos)
                        + OTHER_NAME_PX * f64::from(u8::from(end.id != run.id))
                        + OLDER_PX * f64::from(end.age);
                    fits.push((cost, number, *other));
                }
            }
        }

        // Take the best ones, each end once.
        fits.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
        let mut found = Bonds {
            was: vec![NONE; tips.len()],
            is: vec![NONE; before.len()],
            mates: before.iter().map(|end| end.mate).collect(),
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
    pub fn remember(
        &mut self,
        step: JoiningStep,
        (runs, tips): (&[Run], &[Option<Tip>]),
        mates: &[usize],
        bonds: &Bonds,
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
            let index = if number % 2 == 0 {
                0
            } else {
                run.points.len() - 1
            };
            let place = (tip.place, run.points[index].world);
            ends.push(HeldEnd {
                anchor: Anchor::new(place, run.location_at(index), self.shape, self.projector),
                out: tip.out.map(|v| v as f32),
                id: run.id,
                mate: numbers.get(mates[number]).copied().unwrap_or(NONE),
                kind: run.kind,
                is_hidden: run.occluders > 0,
                age: 0,
            });
        }

        // Keep joints that are not there for some frames.
        let before = std::mem::take(&mut self.held.steps[step as usize]);
        let is_gone = |number: usize| bonds.is.get(number) == Some(&NONE);
        for (number, end) in before.iter().enumerate() {
            let mate = end.mate as usize;
            if number < mate && end.mate != NONE && is_gone(number) && is_gone(mate) {
                let pair = [end, &before[mate]];
                if pair.iter().all(|end| end.age < FRAMES_MOST) {
                    let first = ends.len() as u32;
                    for (end, mate) in pair.into_iter().zip([first + 1, first]) {
                        let age = end.age + 1;
                        ends.push(HeldEnd { mate, age, ..*end });
                    }
                }
            }
        }
        self.held.steps[step as usize] = ends;
    }
}

#[cfg(test)]
mod tests;
