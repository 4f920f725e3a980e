//! Motions: clips of one humanoid, played by another [VRM animation 1.0].
//!
//! A bone is turned along the axes of the world as it is in the motion, from where each of the two rests, and the way
//! of the hips is as much longer as their height at rest. All of it is linear in the keys, so that clips are carried
//! over key by key, with their interpolation.

use crate::bending::RestFrames;
use crate::bone::Bone;
use crate::clip::{Channel, Clip, Interpolation, Property};
use crate::limits::{Allowance, LimitError, Limits};
use crate::matrix;
use crate::notice::{Notice, Notices};
use crate::quaternion::{self, Quaternion};
use crate::scene::Scene;
use crate::shown::shown;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Least height of hips at rest, in units of the scene, that ways of the hips are measured by.
const LEAST_HEIGHT: f32 = 1e-3;

/// Why a motion cannot be played.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum MotionError {
    /// The scene that is to move has no bones.
    #[error(
        "the scene has no bones: it is no VRM, and no nodes are named as bones of VRM or Mixamo"
    )]
    NoBones,
    /// The motion has no bones.
    #[error(
        "the motion has no bones: it is no VRM, and no nodes are named as bones of VRM or Mixamo"
    )]
    NoBonesInMotion,
    /// The motion has no clips.
    #[error("the motion has no clips")]
    NoClips,
    /// There are too many keys.
    #[error(transparent)]
    Limit(#[from] LimitError),
}

/// The clips of a motion, for another scene.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Motions {
    /// As many as the motion has, in its order; channels that move nothing of the scene are left out.
    pub clips: Vec<Clip>,
    /// What of the motion is not used, each thing once.
    pub notices: Vec<Notice>,
}

impl Scene {
    /// The clips of the scene `motion` for the bones and expressions of this one. O(nodes + keys).
    ///
    /// Of nodes that are no bones nothing is used, nor are moves of other bones than the hips, and factors. Bones are
    /// those of [`Self::bones`], in both.
    ///
    /// # Errors
    ///
    /// [`MotionError`] where one of the two has no bones, the motion has no clips, or its keys exceed the memory limit.
    pub fn clips_of(&self, motion: &Scene, limits: &Limits) -> Result<Motions, MotionError> {
        // Find what moves what.
        let mut notices = Notices::default();
        let passage = Passage::new(self, motion, &mut notices)?;
        if motion.clips.is_empty() {
            return Err(MotionError::NoClips);
        }
        if motion
            .figure
            .as_ref()
            .is_some_and(|figure| figure.has_looks)
        {
            notices.add("where the figure of the motion looks is not used");
        }

        // Carry every clip over.
        let mut allowance = Allowance::new(*limits);
        let mut clips = Vec::with_capacity(motion.clips.len());
        for clip in &motion.clips {
            let mut channels = Vec::new();
            for channel in &clip.channels {
                allowance.take::<f32>("motions", channel.values.len())?;
                let carried = passage.carry(channel);
                let is_sound = |carried: &Channel| carried.values.iter().all(|v| v.is_finite());
                if carried.as_ref().is_some_and(|carried| !is_sound(carried)) {
                    notices.add(format!(
                        "clip '{}' of the motion has values out of range, which are not used",
                        shown(&clip.name)
                    ));
                }
                channels.extend(carried.filter(is_sound));
            }
            clips.push(Clip {
                name: clip.name.clone(),
                channels,
            });
        }
        Ok(Motions {
            clips,
            notices: notices.into_list(),
        })
    }
}

/// What a node of a motion moves.
enum Route {
    /// The turn of a node: what is multiplied with a turn from the left and from the right.
    Turn(u32, [Quaternion; 2]),
    /// The same, and the place of the node.
    Hips(u32, [Quaternion; 2], Option<Way>),
    /// The share of an expression.
    Share(u32),
}

/// The way from places of the one hips to those of the other: three columns of an affine map, and where it begins.
type Way = [[f64; 3]; 4];

/// What each node of a motion moves in another scene.
struct Passage {
    routes: BTreeMap<u32, Route>,
}

impl Passage {
    fn new(scene: &Scene, motion: &Scene, notices: &mut Notices) -> Result<Self, MotionError> {
        // Pair the bones of both.
        let (to, from) = (scene.bones(), motion.bones());
        if to.is_empty() {
            return Err(MotionError::NoBones);
        }
        if from.is_empty() {
            return Err(MotionError::NoBonesInMotion);
        }
        let frames = [RestFrames::of(scene), RestFrames::of(motion)];
        let mut routes = BTreeMap::new();
        for (bone, source) in &from {
            let Some(target) = to.get(bone) else { continue };
            let ends = [(scene, *target), (motion, *source)];
            let turns = turns_between(&frames, ends);
            let route = match *bone {
                Bone::HIPS => Route::Hips(*target, turns, way_between(&frames, ends, notices)),
                _ => Route::Turn(*target, turns),
            };
            routes.insert(*source, route);
        }

        // Pair the expressions.
        let figure = motion.figure.as_ref();
        let shares = figure.map_or(&[][..], |figure| &figure.share_nodes);
        for (name, node) in shares {
            let found = scene.figure.as_ref();
            match found.and_then(|figure| figure.expression(name)) {
                Some(expression) => drop(routes.insert(*node, Route::Share(expression))),
                None => notices.add(format!(
                    "expression '{}' of the motion is none of the scene",
                    shown(name)
                )),
            }
        }
        Ok(Self { routes })
    }

    /// What a channel of the motion is in the other scene.
    fn carry(&self, channel: &Channel) -> Option<Channel> {
        let (node, property, values): (u32, Property, Arc<[f32]>) =
            match (self.routes.get(&channel.node)?, channel.property) {
                (Route::Turn(node, turns) | Route::Hips(node, turns, _), Property::Rotation) => {
                    let (turned, _) = channel.values.as_chunks::<4>();
                    let turned = turned.iter().flat_map(|q| between(*turns, *q));
                    (*node, Property::Rotation, turned.collect())
                }
                (Route::Hips(node, _, Some(way)), Property::Translation) => {
                    let (places, _) = channel.values.as_chunks::<3>();
                    let knots = channel.interpolation.knots();
                    let is_place = |i: usize| {
                        channel.interpolation != Interpolation::CubicSpline || i % knots == 1
                    };
                    let places = places.iter().enumerate();
                    let carried = places.flat_map(|(i, place)| carried(way, *place, is_place(i)));
                    (*node, Property::Translation, carried.collect())
                }
                (Route::Share(expression), Property::Translation) => {
                    let (places, _) = channel.values.as_chunks::<3>();
                    let shares = places.iter().map(|[x, _, _]| *x);
                    (*expression, Property::Share, shares.collect())
                }
                _ => return None,
            };
        Some(Channel {
            node,
            property,
            interpolation: channel.interpolation,
            times: channel.times.clone(),
            values,
        })
    }
}

fn between([left, right]: [Quaternion; 2], q: Quaternion) -> Quaternion {
    quaternion::multiply(quaternion::multiply(left, q), right)
}

/// What makes a turn of one node, beside its parent, that of another: turns along the axes of the world are the same.
fn turns_between(
    [frames_to, frames_from]: &[RestFrames; 2],
    [(scene, to), (motion, from)]: [(&Scene, u32); 2],
) -> [Quaternion; 2] {
    let (_, above_to) = frames_to.of_parent(scene.nodes[to as usize].parent);
    let (_, above_from) = frames_from.of_parent(motion.nodes[from as usize].parent);
    let left = quaternion::multiply(quaternion::inverse(above_to), above_from);
    let back = quaternion::inverse(frames_from.turns[from as usize]);
    [
        left,
        quaternion::multiply(back, frames_to.turns[to as usize]),
    ]
}

/// What makes a place of one hips, beside their parent, that of another: places in the world are in proportion to the
/// heights of both at rest. None where that is no proportion.
fn way_between(
    [frames_to, frames_from]: &[RestFrames; 2],
    [(scene, to), (motion, from)]: [(&Scene, u32); 2],
    notices: &mut Notices,
) -> Option<Way> {
    // Find how much longer the way is.
    let height = |frames: &RestFrames, node: u32| frames.worlds[node as usize][3][1];
    let [high, low] = [height(frames_to, to), height(frames_from, from)];
    let (world_to, _) = frames_to.of_parent(scene.nodes[to as usize].parent);
    let back = matrix::inverse(&world_to);
    let Some(back) = back.filter(|_| high > LEAST_HEIGHT && low > LEAST_HEIGHT) else {
        notices.add("the way of the hips is not used, since they rest at the ground");
        return None;
    };
    let longer = f64::from(high) / f64::from(low);

    // Go to the world, along that way, and back.
    let (world_from, _) = frames_from.of_parent(motion.nodes[from as usize].parent);
    let [a, b, c, d] = world_from.map(|[x, y, z, _]| [x, y, z].map(|v| f64::from(v) * longer));
    let linear = |[x, y, z]: [f64; 3]| -> [f64; 3] {
        std::array::from_fn(|i| back[0][i] * x + back[1][i] * y + back[2][i] * z)
    };
    let start = linear(d);
    let start = std::array::from_fn(|i| start[i] + back[3][i]);
    Some([linear(a), linear(b), linear(c), start])
}

/// A place after a way, or a speed, which does not begin anywhere.
fn carried(way: &Way, place: [f32; 3], is_place: bool) -> [f32; 3] {
    let [x, y, z] = place.map(f64::from);
    let [a, b, c, start] = way;
    std::array::from_fn(|i| {
        let start = if is_place { start[i] } else { 0.0 };
        (a[i] * x + b[i] * y + c[i] * z + start) as f32
    })
}

#[cfg(test)]
mod tests;
