//! Where figures look [VRM 1.0, lookAt].
//!
//! From a point between the eyes, which the head carries, to a point of the world. What that makes of two angles turns
//! the bones of the eyes, or is shares of the expressions that look.

use crate::bending::RestFrames;
use crate::bone::Bone;
use crate::expression;
use crate::figure::Figure;
use crate::matrix;
use crate::pose::Pose;
use crate::posture::Posture;
use crate::quaternion::{self, Quaternion};
use crate::scene::Scene;
use crate::standing::Standing;
use npr_core::math;

/// How a figure looks somewhere.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct LookAt {
    /// What moves.
    pub eyes: Eyes,
    /// The point that it looks from, in the space of the bone of its head.
    pub offset: [f32; 3],
    /// How far an eye turns towards the nose.
    pub inner: RangeMap,
    /// How far an eye turns away from the nose, and what expressions do to either side.
    pub outer: RangeMap,
    /// How far it looks down.
    pub down: RangeMap,
    /// How far it looks up.
    pub up: RangeMap,
}

/// What moves where a figure looks somewhere.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Eyes {
    /// The bones `leftEye` and `rightEye`; ranges give degrees.
    #[default]
    Bones,
    /// The expressions `lookUp`, `lookDown`, `lookLeft` and `lookRight`; ranges give shares.
    Expressions,
}

/// What an angle of the look becomes.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RangeMap {
    /// The angle from which it does not grow any more, in degrees, above 0.
    pub most_deg: f32,
    /// What it is there: degrees or a share.
    pub output: f32,
    /// How it grows up to there, both from 0 to 1, where it does not grow evenly: keys in rising order, each its time, its
    /// value, and the slopes before and behind it [Unity, AnimationCurve].
    pub curve: Vec<[f32; 4]>,
}

impl RangeMap {
    /// What becomes of an angle of no sign, in degrees; 0 of none.
    ///
    /// Differs: VRM 0.x does not take away where its curve begins, so a look just left of straight ahead could lie far
    /// from one just right of it.
    pub fn at(&self, angle_deg: f32) -> f32 {
        let share = angle_deg.min(self.most_deg) / self.most_deg;
        (self.grown(share) - self.grown(0.0)) * self.output
    }

    /// The curve at a time: a cubic Hermite spline between keys, constant beyond them.
    fn grown(&self, time: f32) -> f32 {
        let after = self.curve.partition_point(|key| key[0] <= time);
        let (before, after) = match (after.checked_sub(1), self.curve.get(after)) {
            (None, None) => return time,
            (None, Some(first)) => return first[1],
            (Some(before), None) => return self.curve[before][1],
            (Some(before), Some(after)) => (self.curve[before], after),
        };
        let span = after[0] - before[0];
        let t = (time - before[0]) / span;
        let (t2, t3) = (t * t, t * t * t);
        (2.0 * t3 - 3.0 * t2 + 1.0) * before[1]
            + (t3 - 2.0 * t2 + t) * span * before[3]
            + (3.0 * t2 - 2.0 * t3) * after[1]
            + (t3 - t2) * span * after[2]
    }
}

impl Figure {
    /// Whether it can look somewhere: it has a head, and what moves.
    pub fn can_look(&self) -> bool {
        let has = |bone| self.bones.contains_key(&bone);
        let moves = |look: &LookAt| match look.eyes {
            Eyes::Bones => has(Bone::LEFT_EYE) || has(Bone::RIGHT_EYE),
            Eyes::Expressions => self.looks().iter().any(Option::is_some),
        };
        has(Bone::HEAD) && self.look_at.as_ref().is_some_and(moves)
    }

    /// The expressions that look up, down, left and right, by number.
    pub fn looks(&self) -> [Option<u32>; 4] {
        ["lookUp", "lookDown", "lookLeft", "lookRight"].map(|name| {
            let mut names = (0u32..).zip(&self.expressions);
            names.find_map(|(number, face)| (face.name == name).then_some(number))
        })
    }
}

impl Scene {
    /// Lets the figure of a pose look where it says; other figures stay as they are. Eyes that a clip turns look too;
    /// expressions that have a share keep it. O(nodes).
    pub(crate) fn look(&self, pose: &mut Pose) {
        // Find the angles.
        let figure = self.figure.as_ref().filter(|figure| figure.can_look());
        let (Some(figure), Some(target)) = (figure, pose.look_at) else {
            return;
        };
        let Some(look) = &figure.look_at else { return };
        let Some(head) = figure.bones.get(&Bone::HEAD) else {
            return;
        };
        let [yaw, pitch] = self.angles_deg(*head, look.offset, target, pose);
        let tilt = match pitch > 0.0 {
            true => look.down.at(pitch),
            false => -look.up.at(-pitch),
        };

        // Move what shows it.
        match look.eyes {
            Eyes::Bones => {
                let left = expression::left_of_looks(&figure.expressions, &pose.shares);
                let (inner, outer) = (look.inner.at(yaw.abs()), look.outer.at(yaw.abs()));
                let [at_left, at_right] = match yaw > 0.0 {
                    true => [outer, inner],
                    false => [-inner, -outer],
                };
                let turn = |pan: f32| gaze(pan * left, tilt * left);
                let turns = [
                    (Bone::LEFT_EYE, turn(at_left)),
                    (Bone::RIGHT_EYE, turn(at_right)),
                ];
                let posture = Posture {
                    turns: turns.into(),
                    hips: None,
                };
                self.bend(pose, &posture);
            }
            Eyes::Expressions => {
                let aside = look.outer.at(yaw.abs());
                let (left, right) = if yaw > 0.0 {
                    (aside, 0.0)
                } else {
                    (0.0, aside)
                };
                let shares = [(-tilt).max(0.0), tilt.max(0.0), left, right];
                for (number, share) in figure.looks().into_iter().zip(shares) {
                    let Some(number) = number else { continue };
                    pose.shares.entry(number).or_insert(share.clamp(0.0, 1.0));
                }
            }
        }
    }

    /// How far to the left and how far down a point lies for a head in a pose, in degrees: 0 and 0 straight ahead.
    fn angles_deg(&self, head: u32, offset: [f32; 3], target: [f32; 3], pose: &Pose) -> [f32; 2] {
        let world = Standing::new(self).world(head, pose);
        let eye = matrix::transform_point(&world, offset);
        let way = std::array::from_fn(|i| target[i] - eye[i]);

        // Turn it as the head is turned back to where it rests.
        let rest = RestFrames::of(self).turns[head as usize];
        let back = quaternion::multiply(rest, quaternion::inverse(matrix::turn_of(&world)));
        let [x, y, z] = quaternion::turned(back, way);
        let level = (x * x + z * z).sqrt();
        [math::atan2(x, z), math::atan2(-y, level)].map(f32::to_degrees)
    }
}

/// The turn of an eye to its left and down, by degrees.
fn gaze(pan_deg: f32, tilt_deg: f32) -> Quaternion {
    let half = |degrees: f32| 0.5 * degrees.to_radians();
    let of = |angle: f32| (math::sin(angle), math::cos(angle));
    let ((pan, pan_w), (tilt, tilt_w)) = (of(half(pan_deg)), of(half(tilt_deg)));
    quaternion::multiply([0.0, pan, 0.0, pan_w], [tilt, 0.0, 0.0, tilt_w])
}

#[cfg(test)]
mod tests;
