//! Poses: how a scene stands at a moment of a clip, or as anybody else puts it.
//!
//! A [`Pose`] holds what differs from the scene at rest: the empty one is the rest pose. [`Scene::pose_at`] takes one
//! from a clip, [`Scene::set_pose`] puts the scene into one: nodes get their places, and with them joints, cameras
//! and lights; morphs get their weights. Meshes, skins and all numbering stay, so what was prepared of the scene can
//! follow.

use crate::clip::{Clip, Property};
use crate::matrix::{self, Matrix};
use crate::morph::Morphed;
use crate::reach;
use crate::scene::Scene;
use crate::shown::shown;
use crate::transform::Transform;
use std::borrow::Cow;
use std::collections::BTreeMap;

/// How a scene stands where it does not rest.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Pose {
    /// Places of nodes beside their parents, by node. Nodes without a [rest](crate::Node::rest) stay where they are.
    pub transforms: BTreeMap<u32, Transform>,
    /// Weights of the morphs of nodes' meshes, by node; missing ones at the end count as 0. Of nodes that share a
    /// mesh the last one counts; nodes whose weights a clip of the file moves share none.
    pub weights: BTreeMap<u32, Vec<f32>>,
    /// Shares of expressions of the scene's figure, 0 to 1, by number. Where there are any, expressions alone decide
    /// on the morphs that any of them binds, and `weights` on the others.
    pub shares: BTreeMap<u32, f32>,
    /// The point of the world that the scene's figure looks at; without one its eyes stay as they are. Expressions
    /// that look and have no share get one.
    pub look_at: Option<[f32; 3]>,
    /// Turns of nodes beside their parents, by node, as quaternions, which count last: those of
    /// [springs](crate::Swinging).
    pub swings: BTreeMap<u32, [f32; 4]>,
}

/// Why a scene cannot be put into a pose.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PoseError {
    /// A transform is out of range, or carries a mesh out of range.
    #[error("the pose carries node '{}' out of range", shown(node))]
    OutOfRange {
        /// Name of the node.
        node: String,
    },
    /// Weights carry the vertices of a mesh out of range.
    #[error("the morph weights of mesh '{}' carry it out of range", shown(mesh))]
    MorphOutOfRange {
        /// Name of the mesh.
        mesh: String,
    },
}

impl Scene {
    /// The pose of this scene at a time of a clip, in seconds. O(channels x log keys).
    ///
    /// Nodes that the clip does not move rest. Before the first key of a channel its first value holds, after the last
    /// one the last.
    pub fn pose_at(&self, clip: &Clip, time_s: f32) -> Pose {
        let mut pose = Pose::default();
        for channel in &clip.channels {
            let value = || channel.value_at(time_s);
            match channel.property {
                Property::Weights => drop(pose.weights.insert(channel.node, value())),
                Property::Share => pose
                    .shares
                    .extend(value().first().map(|share| (channel.node, *share))),
                Property::Translation | Property::Rotation | Property::Scale => {
                    let rest = self.nodes.get(channel.node as usize);
                    let rest = rest.and_then(|node| node.rest).unwrap_or_default();
                    let transform = pose.transforms.entry(channel.node).or_insert(rest);
                    channel.apply(time_s, transform);
                }
            }
        }
        pose
    }

    /// Puts the scene into a pose; what the pose does not name rests, or follows what it is constrained to. The same
    /// pose gives the same scene, bit for bit, whatever pose it had before.
    ///
    /// O(nodes + vertices of meshes with other morph weights x morphs + vertices).
    ///
    /// # Errors
    ///
    /// [`PoseError`] where something would stand beyond [`POSITION_LIMIT`](crate::POSITION_LIMIT); the scene then
    /// stays as it is.
    pub fn set_pose(&mut self, pose: &Pose) -> Result<(), PoseError> {
        let pose = &self.followed(pose);
        let mut morphs = self.morphs_of(pose)?;
        let before: Vec<[Matrix; 2]> = self
            .nodes
            .iter()
            .map(|node| [node.local, node.world_from_node])
            .collect();
        self.swap_morphs(&mut morphs);
        self.place_nodes(pose);
        let Some(node) = self.out_of_range(&before) else {
            return Ok(());
        };

        // Go back.
        self.swap_morphs(&mut morphs);
        for (node, [local, world]) in self.nodes.iter_mut().zip(before) {
            (node.local, node.world_from_node) = (local, world);
        }
        Err(PoseError::OutOfRange { node })
    }

    /// A pose with what follows from it: where eyes look, then the turns that constraints give, and then those of
    /// springs.
    pub(crate) fn followed<'a>(&self, pose: &'a Pose) -> Cow<'a, Pose> {
        let mut pose = Cow::Borrowed(pose);
        if pose.look_at.is_some() {
            self.look(pose.to_mut());
        }
        if !self.constraints.is_empty() {
            self.constrain(pose.to_mut());
        }
        if !pose.swings.is_empty() {
            let Pose {
                transforms, swings, ..
            } = pose.to_mut();
            for (node, turn) in swings {
                let rest = self.nodes.get(*node as usize).and_then(|node| node.rest);
                let stand = transforms.entry(*node).or_insert(rest.unwrap_or_default());
                stand.rotation = *turn;
            }
        }
        pose
    }

    /// The vertices of all parts whose morphs get other weights.
    fn morphs_of(&self, pose: &Pose) -> Result<Vec<NewMorphs>, PoseError> {
        // Find the weights that meshes are given.
        let weights = self.expressed(&pose.shares, &pose.weights);
        let mut given: BTreeMap<u32, &[f32]> = BTreeMap::new();
        for (node, weights) in &weights {
            let mesh = self.nodes.get(*node as usize).and_then(|node| node.mesh);
            given.extend(mesh.map(|mesh| (mesh, weights.as_slice())));
        }

        // Morph the parts that have others.
        let mut morphs = Vec::new();
        for (mesh_index, mesh) in (0u32..).zip(&self.meshes) {
            for (part_index, part) in mesh.parts.iter().enumerate() {
                let weights = match given.get(&mesh_index) {
                    Some(weights) => weights.to_vec(),
                    None => part.rest_weights(),
                };
                if part.unmorphed.is_none() || part.has_weights(&weights) {
                    continue;
                }
                let vertices = part.morphed(&weights);
                morphs.push(NewMorphs {
                    place: [mesh_index as usize, part_index],
                    vertices: vertices.ok_or_else(|| PoseError::MorphOutOfRange {
                        mesh: mesh.name.clone(),
                    })?,
                    weights,
                });
            }
        }
        Ok(morphs)
    }

    fn swap_morphs(&mut self, morphs: &mut [NewMorphs]) {
        for NewMorphs {
            place: [mesh, part],
            vertices,
            weights,
        } in morphs
        {
            let part = &mut self.meshes[*mesh].parts[*part];
            let before = part
                .morphs
                .iter()
                .map(|morph| morph.applied_weight)
                .collect();
            part.swap_morphed(vertices, weights);
            *weights = before;
        }
    }

    /// Moves nodes, and all that hangs on them, to where the pose has them.
    fn place_nodes(&mut self, pose: &Pose) {
        let mut is_moved = vec![false; self.nodes.len()];
        for index in 0..self.nodes.len() {
            // Find its place beside its parent.
            let node = &self.nodes[index];
            let local = node.local_in(pose.transforms.get(&(index as u32)));

            // Carry it with its parent.
            let parent = node.parent.map(|parent| parent as usize);
            let stays = bits(&local) == bits(&node.local);
            if stays && !parent.is_some_and(|parent| is_moved[parent]) {
                continue;
            }
            is_moved[index] = true;
            let world = match parent {
                Some(parent) => matrix::multiply(&self.nodes[parent].world_from_node, &local),
                None => local,
            };
            let node = &mut self.nodes[index];
            (node.local, node.world_from_node) = (local, world);
        }
    }

    /// The name of the first node that stands out of range, or carries its mesh there; those that have not moved from
    /// where they were `before` do not.
    fn out_of_range(&self, before: &[[Matrix; 2]]) -> Option<String> {
        let nodes = || self.nodes.iter().zip(before);
        let mut unsound = nodes().filter(|(node, [_, before])| {
            bits(&node.world_from_node) != bits(before) && !matrix::is_sound(&node.world_from_node)
        });
        if let Some((node, _)) = unsound.next() {
            return Some(node.name.clone());
        }
        let carried = reach::carried_out_of_range(self);
        carried.first().map(|node| self.nodes[*node].name.clone())
    }
}

/// A matrix as bits: nothing is equal but the same, so that no pose depends on the one before.
fn bits(matrix: &Matrix) -> [[u32; 4]; 4] {
    matrix.map(|column| column.map(f32::to_bits))
}

/// The vertices of a part under other weights, or those that it had before.
struct NewMorphs {
    /// The numbers of mesh and part.
    place: [usize; 2],
    vertices: Morphed,
    weights: Vec<f32>,
}

#[cfg(test)]
mod tests;
