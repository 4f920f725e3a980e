//! VRM avatars: glTF files with a humanoid, expressions and toon materials.
//!
//! Geometry and base materials are plain glTF; bones and expressions are read by `figure.rs`, looks by
//! `look_at.rs`, springs by `spring.rs`, toon materials by `toon.rs`.
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::arithmetic_side_effects
)]

use ::gltf::json::Root;
use serde_json::Value;

use crate::clip::{Channel, Property};
use crate::matrix::{self, HALF_TURN_Y};
use crate::scene::Scene;
use crate::transform::{Transform, half_turned_move, half_turned_rotation};

/// Turns a VRM 0.x avatar, which looks along -Z, so that it looks along +Z as VRM 1.0 avatars do.
pub(crate) fn turn_to_front(root: &Root, scene: &mut Scene) {
    if extension(root, "VRM").is_none() || extension(root, "VRMC_vrm").is_some() {
        return;
    }
    for node in scene.nodes.iter_mut().filter(|node| node.parent.is_none()) {
        node.local = matrix::multiply(&HALF_TURN_Y, &node.local);
        node.rest = node.rest.map(Transform::half_turned_y);
    }

    // Turn what clips give these nodes.
    let nodes = &scene.nodes;
    let is_root = |channel: &&mut Channel| {
        let node = nodes.get(channel.node as usize);
        node.is_some_and(|node| node.parent.is_none())
    };
    let channels = scene.clips.iter_mut().flat_map(|clip| &mut clip.channels);
    for channel in channels.filter(is_root) {
        match channel.property {
            Property::Translation => turn_values(channel, half_turned_move),
            Property::Rotation => turn_values(channel, half_turned_rotation),
            Property::Scale | Property::Weights | Property::Share => {}
        }
    }
}

/// Turns every value of a channel.
fn turn_values<const N: usize>(channel: &mut Channel, turn: impl Fn([f32; N]) -> [f32; N]) {
    let (values, _) = channel.values.as_chunks::<N>();
    channel.values = values.iter().flat_map(|value| turn(*value)).collect();
}

/// What an extension of the whole file says.
pub(crate) fn extension<'a>(root: &'a Root, name: &str) -> Option<&'a Value> {
    root.extensions.as_ref()?.others.get(name)
}
