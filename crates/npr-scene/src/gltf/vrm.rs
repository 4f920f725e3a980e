//! VRM avatars: glTF files with a humanoid, expressions and toon materials.
//!
//! Geometry and base materials are plain glTF. Of the rest only what is wrong with it is read so far,
//! so that a broken avatar is told apart from a sound one.
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::arithmetic_side_effects
)]

use ::gltf::json::{Index, Root};
use serde_json::Value;

use crate::clip::{Channel, Property};
use crate::loading::Loading;
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
            Property::Scale | Property::Weights => {}
        }
    }
}

/// Turns every value of a channel.
fn turn_values<const N: usize>(channel: &mut Channel, turn: impl Fn([f32; N]) -> [f32; N]) {
    let (values, _) = channel.values.as_chunks::<N>();
    channel.values = values.iter().flat_map(|value| turn(*value)).collect();
}

/// Says which data of an avatar is ignored, and what is wrong with it.
pub(crate) fn note_what_is_ignored(root: &Root, loading: &mut Loading) {
    // Say what of an avatar's behaviour is not drawn.
    if extension(root, "VRM").is_some() {
        loading
            .notices
            .add("humanoid, expressions and toon materials of VRM 0.x are ignored");
    }
    let Some(vrm) = extension(root, "VRMC_vrm") else {
        return;
    };
    loading
        .notices
        .add("humanoid, expressions and toon materials of VRM 1.0 are ignored");

    // Note bones that name no node.
    match vrm
        .pointer("/humanoid/humanBones")
        .and_then(Value::as_object)
    {
        None => loading
            .notices
            .add("the avatar has no humanoid, which VRM 1.0 requires"),
        Some(bones) => bones
            .iter()
            .for_each(|(name, bone)| note_bone(root, name, bone, loading)),
    }

    // Note expressions that bind a missing morph.
    let expressions = ["/expressions/preset", "/expressions/custom"];
    let groups = expressions
        .iter()
        .filter_map(|path| vrm.pointer(path)?.as_object());
    groups
        .flatten()
        .for_each(|(name, expression)| note_expression(root, name, expression, loading));
}

fn extension<'a>(root: &'a Root, name: &str) -> Option<&'a Value> {
    root.extensions.as_ref()?.others.get(name)
}

fn note_bone(root: &Root, name: &str, bone: &Value, loading: &mut Loading) {
    let count = root.nodes.len();
    let node = bone.get("node").and_then(Value::as_u64);
    if node.is_none_or(|node| node >= count as u64) {
        let name = crate::shown::shown(name);
        loading.notices.add(format!(
            "bone '{name}' of the avatar names no node of the {count} in the file"
        ));
    }
}

fn note_expression(root: &Root, name: &str, expression: &Value, loading: &mut Loading) {
    let binds = expression.get("morphTargetBinds").and_then(Value::as_array);
    let is_broken = |bind: &Value| bind_target(root, bind).is_none();
    if binds.into_iter().flatten().any(is_broken) {
        let name = crate::shown::shown(name);
        loading.notices.add(format!(
            "expression '{name}' of the avatar binds a morph target that does not exist"
        ));
    }
}

/// The morph target that a bind of an expression names, where it exists.
fn bind_target(root: &Root, bind: &Value) -> Option<usize> {
    let number = |key| {
        bind.get(key)
            .and_then(Value::as_u64)
            .and_then(|value| usize::try_from(value).ok())
    };
    let mesh = root
        .nodes
        .get(number("node")?)?
        .mesh
        .as_ref()
        .map(Index::value)?;
    let target = number("index")?;
    let primitive = root.meshes.get(mesh)?.primitives.first()?;
    (target < primitive.targets.as_ref()?.len()).then_some(target)
}
