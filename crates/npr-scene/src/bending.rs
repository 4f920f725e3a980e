//! Scenes whose bones are bent by name.
//!
//! Rotations of bones are said beside how the figure rests, along the axes of the world: the same numbers bend an arm
//! of any avatar in the same way, however its nodes are turned [VRM 1.0, humanoid]. A figure looks along +Z, and its
//! left is +X.

use crate::bone::Bone;
use crate::matrix::{self, Matrix};
use crate::pose::Pose;
use crate::posture::Posture;
use crate::quaternion::{self, NO_TURN, Quaternion};
use crate::scene::Scene;
use crate::transform::Transform;
use std::collections::BTreeMap;

/// How the nodes of a scene stand at rest, whatever pose it has.
pub(crate) struct RestFrames {
    /// World space from node space.
    pub worlds: Vec<Matrix>,
    /// The turns in them: those of all nodes up to the root, one after the other.
    pub turns: Vec<Quaternion>,
}

impl RestFrames {
    /// O(nodes).
    pub fn of(scene: &Scene) -> Self {
        let mut frames = Self {
            worlds: Vec::with_capacity(scene.nodes.len()),
            turns: Vec::with_capacity(scene.nodes.len()),
        };
        for node in &scene.nodes {
            let (local, turn) = match node.rest {
                Some(rest) => (rest.matrix(), quaternion::unit(rest.rotation)),
                None => (node.local, matrix::turn_of(&node.local)),
            };
            let (world, above) = frames.of_parent(node.parent);
            frames.worlds.push(matrix::multiply(&world, &local));
            frames.turns.push(quaternion::multiply(above, turn));
        }
        frames
    }

    /// World space from the space of a parent, and the turn in it; roots hang on the world.
    pub fn of_parent(&self, parent: Option<u32>) -> (Matrix, Quaternion) {
        let parent = parent.map(|parent| parent as usize);
        parent.map_or((matrix::IDENTITY, NO_TURN), |parent| {
            (self.worlds[parent], self.turns[parent])
        })
    }
}

impl Scene {
    /// The bones of the scene's figure, or else the nodes that are named as bones of VRM or of Mixamo.
    ///
    /// Names of VRM count in any letter case, those of Mixamo with and without `mixamorig:`; of two nodes with one name
    /// the first is the bone. Nodes with a matrix are none, since they cannot be posed. O(nodes).
    pub fn bones(&self) -> BTreeMap<Bone, u32> {
        let figure = self.figure.as_ref().map(|figure| &figure.bones);
        if let Some(bones) = figure.filter(|bones| !bones.is_empty()) {
            return bones.clone();
        }
        let mut bones = BTreeMap::new();
        for (index, node) in (0u32..).zip(&self.nodes) {
            let bone = Bone::of_node(&node.name).filter(|_| node.rest.is_some());
            if let Some(bone) = bone {
                bones.entry(bone).or_insert(index);
            }
        }
        bones
    }

    /// Bends the bones of a pose; what the posture does not name stays. Bones that the scene lacks are passed over.
    pub fn bend(&self, pose: &mut Pose, posture: &Posture) {
        let (bones, frames) = (self.bones(), RestFrames::of(self));
        for (bone, index) in bones {
            // Find where it stands.
            let node = &self.nodes[index as usize];
            let Some(rest) = node.rest else { continue };
            let turn = posture.turns.get(&bone);
            let hips = posture.hips.filter(|_| bone == Bone::HIPS);
            if turn.is_none() && hips.is_none() {
                continue;
            }
            let stand = pose.transforms.entry(index).or_insert(rest);

            // Turn it along the axes of the world, and move it there.
            let (world, above) = frames.of_parent(node.parent);
            if let Some(turn) = turn {
                let below = frames.turns[index as usize];
                let beside =
                    quaternion::multiply(quaternion::inverse(above), quaternion::unit(*turn));
                stand.rotation = quaternion::multiply(beside, below);
            }
            if let (Some(way), Some(back)) = (hips, matrix::inverse(&world)) {
                let [x, y, z] = way.map(f64::from);
                let [a, b, c, _] = back;
                let way = |i: usize| (a[i] * x + b[i] * y + c[i] * z) as f32;
                *stand = Transform {
                    translation: std::array::from_fn(|i| rest.translation[i] + way(i)),
                    ..*stand
                };
            }
        }
    }
}

#[cfg(test)]
mod tests;
