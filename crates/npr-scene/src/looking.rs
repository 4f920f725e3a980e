//! Where figures look [VRM 1.0, lookAt].
//!
//! From a point between the eyes, which the head carries, to a point of the world. What that makes of two angles turns
//! the bones of the eyes, or is shares of the expressions that look.

use crate::bending::RestFrames;
use crate::bone::Bone;
use crate::expression;
use crate::look_at::Eyes;
use crate::matrix;
use crate::pose::Pose;
use crate::posture::Posture;
use crate::quaternion::{self, Quaternion};
use crate::scene::Scene;
use crate::standing::Standing;
use npr_core::math;

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
