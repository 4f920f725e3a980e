//! Strokes that hold still from frame to frame: which way they run, where their texture lies, and what they are called
//! is taken over from the frame before [Kalnins et al. 2003].
//!
//! `remembered` keeps samples of a frame's strokes by their place on the surface, and finds them again in the next
//! view. Every sample of a new stroke votes with the remembered one that it is (`votes`): for a way to run, for an
//! identity (`identity`), which also keeps its place in the order (`order`), and for a shift of the texture
//! coordinate (`phase`). Closed strokes start where they did (`seam`). Strokes that are parts of one line do all that
//! together (`parts`).
//!
//! Differs: the paper fits a slope to the votes of a run, too; here a pixel along a stroke stays a pixel of its
//! texture, so that dashes and stamps never stretch. Where parts of one stroke had textures of their own these stay,
//! and change over along some pixels.

mod between;
mod growth;
mod identity;
mod order;
mod parts;
mod phase;
mod remembered;
mod seam;
mod votes;
mod way;

use crate::mesh_lines::{DrawnBetween, Tip};
use crate::project::Projector;
use crate::stroke::Stroke;
use between::drawn_between;
use glam::DVec3;
use identity::settle_ids;
use npr_mesh::half_edge::HalfEdgeMesh;
use rayon::prelude::*;
use remembered::{Known, Line, sampled};
use votes::{LEAST_SHARED, Tally, Vote, tally, votes_of};
use way::{measure, reverse};

/// Frames for which ink that nothing took over is remembered: what is hidden for a moment comes back as it was.
const FRAMES_MOST: u8 = 4;

/// Cosine of the largest angle by which a camera turns from frame to frame; beyond it is another picture.
const TURN_COS: f64 = 0.87;

/// Least share of samples that have to find one of the frame before; with fewer it is another picture.
const LEAST_SHARE: f64 = 0.2;

/// Least number of samples in a row that are remembered beyond a frame.
const LEAST_LEFT: usize = 4;

/// The strokes of a frame, as far as the next one needs them: 32 bytes for every two pixels of line.
///
/// ```
/// # use npr_core::camera::Camera;
/// # use npr_mesh::half_edge::HalfEdgeMesh;
/// # use npr_vector::hold::HeldStrokes;
/// # use npr_vector::project::Projector;
/// # let shape = HalfEdgeMesh::default();
/// # let projector = Projector::new(&Camera::framing([-1.0; 3], [1.0; 3]), [64, 36], ([-1.0; 3], [1.0; 3]));
/// let mut held = HeldStrokes::default();
/// // Once a frame, in the order of the frames:
/// let mut strokes = Vec::new();
/// held.hold(&mut strokes, &shape, &projector);
/// ```
#[derive(Debug, Clone, Default)]
pub struct HeldStrokes {
    lines: Vec<Line>,
    samples: Vec<remembered::Sample>,
    /// Where the camera looked.
    forward: Option<DVec3>,
}

/// What may become of the ends of strokes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ends {
    /// They stay where they were found.
    Stay,
    /// Visible ends in the open of lines that were there grow by 8 pixels a frame at most, unless they grow by more
    /// than 24: an end that is now here and now a little further on would leap all the time.
    Grow,
}

/// The strokes of the frame before, in the view of this one.
#[derive(Debug)]
pub struct StrokesInView {
    known: Known,
}

impl StrokesInView {
    /// What was drawn between two ends of lines, for [`HeldJoints`](crate::mesh_lines::HeldJoints).
    pub fn between(&self, tips: &[Tip; 2]) -> DrawnBetween {
        drawn_between(&self.known, tips)
    }
}

impl HeldStrokes {
    /// What is known of the frame before, in a view of the shape as it is posed now; nothing where the camera jumped.
    /// O(samples).
    pub fn in_view(&mut self, shape: &HalfEdgeMesh, projector: &Projector) -> StrokesInView {
        let forward = projector.forward();
        if self
            .forward
            .is_some_and(|before| before.dot(forward) < TURN_COS)
        {
            *self = Self::default();
        }
        StrokesInView {
            known: Known::new(&self.lines, &self.samples, shape, projector),
        }
    }

    /// Gives the strokes of a frame what they had in the frame before, and remembers them.
    ///
    /// `shape` is the surface in the pose of this frame, whatever pose it had before: its vertices, edges and faces
    /// keep their numbers. A stroke runs the way that most of its samples ran, and has the identity that most of them
    /// had, unless another has more of it; what is new keeps its own, made of mesh edges. `u` is shifted as a whole
    /// where all samples agree, else by parts of 8 pixels and more; that of a part of a line that nobody saw before
    /// goes on from the part beside it. Strokes keep their order, and new ones come behind those that they came behind.
    /// After a cut nothing is taken over: where the camera turns by more than 30 degrees, or fewer than a fifth of the
    /// samples find one of the frame before.
    ///
    /// O(pixels of line), on all threads, with the same result for any number of them.
    pub fn hold(&mut self, strokes: &mut Vec<Stroke>, shape: &HalfEdgeMesh, projector: &Projector) {
        let before = self.in_view(shape, projector);
        self.hold_to(before, strokes, (shape, projector), Ends::Stay);
    }

    /// As [`HeldStrokes::hold`], where the frame before is [in view](Self::in_view) already.
    pub fn hold_to(
        &mut self,
        before: StrokesInView,
        strokes: &mut Vec<Stroke>,
        (shape, projector): (&HalfEdgeMesh, &Projector),
        ends: Ends,
    ) {
        // See what the strokes were.
        let StrokesInView { mut known } = before;
        let mut tallies: Vec<Tally> = strokes
            .par_iter()
            .map(|stroke| tally(&known, stroke))
            .collect();
        let [found, all] = tallies.iter().fold([0; 2], |[found, all], tally| {
            [found + tally.vote_count, all + tally.sample_count]
        });
        if (found as f64) < LEAST_SHARE * all as f64 {
            known = Known::default();
            *self = Self::default();
            tallies
                .iter_mut()
                .for_each(|tally| *tally = Tally::default());
        }

        // Let ends grow.
        if ends == Ends::Grow && !self.lines.is_empty() {
            for number in growth::slow_growth(strokes, &known) {
                measure(&mut strokes[number].points);
                tallies[number] = tally(&known, &strokes[number]);
            }
        }

        // Turn strokes as they ran, start rings where they started, and shift the textures.
        let of_strokes = strokes.par_iter_mut().zip(&mut tallies);
        let taken: Vec<Vec<Vote>> = of_strokes
            .map(|(stroke, tally)| {
                if tally.vote_count == 0 {
                    return Vec::new();
                }
                if tally.is_reversed {
                    reverse(stroke);
                }
                let mut is_other = tally.is_reversed;
                if let (true, Some(line)) = (stroke.closed, tally.main_line())
                    && seam::start_at(stroke, known.start_of(line))
                {
                    measure(&mut stroke.points);
                    is_other = true;
                }
                let (places, votes) = match is_other {
                    true => votes_of(&known, stroke),
                    false => std::mem::take(&mut tally.votes),
                };
                phase::shift(stroke, &places, &votes, &known);
                votes.into_iter().flatten().collect()
            })
            .collect();
        parts::settle(strokes, &tallies, &self.lines);
        settle_ids(strokes, &tallies, &self.lines);
        order::keep(strokes, &self.lines);

        // Remember them, and what of the frames before nothing took over.
        let left = self.left_over(taken.iter().flatten());
        *self = left;
        let samples_of = |stroke: &Stroke| -> Vec<remembered::Sample> {
            let places = sampled(stroke).into_par_iter();
            let shared = places.with_min_len(LEAST_SHARED);
            shared
                .map(|place| place.remembered(shape, projector))
                .collect()
        };
        let samples: Vec<_> = strokes.par_iter().map(samples_of).collect();
        for ((stroke, samples), rank) in strokes.iter().zip(samples).zip(0..) {
            self.remember((stroke, rank), samples);
        }
        self.forward = Some(projector.forward());
    }

    /// The parts of remembered lines that no vote took over, one frame older.
    fn left_over<'a>(&self, taken: impl Iterator<Item = &'a Vote>) -> Self {
        // Mark what was taken, and what lies right beside it.
        let mut is_taken = vec![false; self.samples.len()];
        for vote in taken {
            let (from, to) = (vote.sample.saturating_sub(1), vote.sample + 2);
            let around = from as usize..(to as usize).min(is_taken.len());
            is_taken[around].fill(true);
        }

        // Keep long enough rows of the rest.
        let mut left = Self::default();
        for line in self.lines.iter().filter(|line| line.age < FRAMES_MOST) {
            let mut from = line.range().start;
            for row in is_taken[line.range()].chunk_by(|a, b| a == b) {
                let samples = from..from + row.len();
                from = samples.end;
                if !row[0] && row.len() >= LEAST_LEFT {
                    let older = Line {
                        age: line.age + 1,
                        ..*line
                    };
                    left.add(older, self.samples[samples].iter().copied());
                }
            }
        }
        left
    }

    /// Remembers a stroke by samples along it.
    fn remember(&mut self, (stroke, rank): (&Stroke, u32), samples: Vec<remembered::Sample>) {
        let line = Line {
            id: stroke.id,
            whole_id: stroke.line(),
            kind: stroke.kind,
            is_hidden: !stroke.is_visible(),
            around_px: if stroke.closed {
                stroke.length() as f32
            } else {
                0.0
            },
            age: 0,
            rank,
            samples: [0; 2],
        };
        self.add(line, samples.into_iter());
    }

    fn add(&mut self, line: Line, samples: impl Iterator<Item = remembered::Sample>) {
        let from = self.samples.len() as u32;
        self.samples.extend(samples);
        let to = self.samples.len() as u32;
        self.lines.push(Line {
            samples: [from, to],
            ..line
        });
    }
}

#[cfg(test)]
mod tests;
