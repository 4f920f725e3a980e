//! What a strict reader refuses, though the scene can be drawn without it: told once each, by name.
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::arithmetic_side_effects
)]

use ::gltf::json::Root;
use ::gltf::json::accessor::Accessor;
use ::gltf::json::animation::{Animation, Channel, Interpolation, Property, Sampler};
use ::gltf::json::validation::Checked;
use serde_json::Value;

use super::accessor::{Accessors, type_width};
use super::error::Item;
use crate::loading::Loading;

/// Notes every broken part of a file that was not needed. What was needed has been read by now: it is sound or has a
/// notice of its own.
pub(crate) fn note(accessors: &Accessors, loading: &mut Loading) {
    // Note lists that could not be read.
    let root = accessors.root;
    for (index, accessor) in root.accessors.iter().enumerate() {
        note_bounds(Item::new("accessor", index), accessor, loading);
        note_fault(accessors.check(index).err(), loading);
    }

    // Note views beyond their buffers.
    for view in 0..root.buffer_views.len() {
        let item = Item::new("buffer view", view);
        note_fault(accessors.buffers.view(root, view, item).err(), loading);
    }

    // Note skins that bend nothing.
    for (index, skin) in root.skins.iter().enumerate() {
        if skin.joints.is_empty() {
            let item = Item::new("skin", index);
            note_fault(Some(format!("{item} has no joints")), loading);
        }
    }

    // Note animations that could not be played.
    for (index, animation) in root.animations.iter().enumerate() {
        if let Some(fault) = animation_fault(accessors, animation) {
            let item = Item::new("animation", index);
            loading.notices.add(format!("{item} is broken: {fault}"));
        }
    }
}

/// Notes a fault of something that is not drawn, unless something that would have been drawn was left out for it.
fn note_fault(fault: Option<impl ToString>, loading: &mut Loading) {
    if let Some(fault) = fault.map(|fault| fault.to_string())
        && !loading.notices.tell_of(&fault)
    {
        let text = format!("{fault}; nothing that is drawn uses it");
        loading.notices.add(text);
    }
}

/// Notes a lowest or highest value that is no number. Bounds are taken from the elements themselves.
fn note_bounds(item: Item, accessor: &Accessor, loading: &mut Loading) {
    let width = type_width(accessor);
    for (name, bound) in [("min", &accessor.min), ("max", &accessor.max)] {
        let numbers = bound.as_ref().map(|bound| bound.as_array());
        let is_sound = |numbers: &Vec<Value>| {
            let are_numbers = numbers.iter().all(Value::is_number);
            are_numbers && (numbers.len() == width || width == 0)
        };
        if numbers.is_some_and(|numbers| !numbers.is_some_and(is_sound)) {
            loading.notices.add(format!(
                "{item} has a {name} that is no number for each component; it is not used"
            ));
        }
    }
}

/// The first thing that is wrong with an animation.
fn animation_fault(accessors: &Accessors, animation: &Animation) -> Option<String> {
    let samplers = animation.samplers.iter().enumerate();
    let mut faults = samplers.filter_map(|(index, sampler)| {
        sampler_fault(accessors, Item::new("sampler", index), sampler)
    });
    faults.next().or_else(|| {
        let channels = animation.channels.iter().enumerate();
        let mut faults = channels.filter_map(|(index, channel)| {
            channel_fault(accessors, animation, Item::new("channel", index), channel)
        });
        faults.next()
    })
}

fn sampler_fault(accessors: &Accessors, item: Item, sampler: &Sampler) -> Option<String> {
    if matches!(sampler.interpolation, Checked::Invalid) {
        return Some(format!(
            "{item} has an interpolation that glTF does not know"
        ));
    }
    let (input, output) = (sampler.input.value(), sampler.output.value());
    for index in [input, output] {
        if let Err(fault) = accessors.count(index, item) {
            return Some(fault.to_string());
        }
    }
    let is_of_times = accessors.width(input, item) == Ok(1);
    (!is_of_times).then(|| format!("{item} has times that are no single numbers"))
}

fn channel_fault(
    accessors: &Accessors,
    animation: &Animation,
    item: Item,
    channel: &Channel,
) -> Option<String> {
    // Find the values of the movement.
    let count = animation.samplers.len();
    let sampler = channel.sampler.value();
    let Some(values) = animation.samplers.get(sampler) else {
        let sampler = Item::new("sampler", sampler);
        return Some(format!("{item} uses {sampler}, but there are only {count}"));
    };

    // Find what they move.
    let (node, count) = (channel.target.node.value(), accessors.root.nodes.len());
    if node >= count {
        let node = Item::new("node", node);
        return Some(format!("{item} moves {node}, but there are only {count}"));
    }
    let Checked::Valid(moved) = channel.target.path else {
        return Some(format!("{item} moves something that glTF does not know"));
    };

    // Judge whether the values suit it.
    value_fault(
        accessors,
        item,
        values,
        moved,
        weight_count(accessors.root, node),
    )
}

/// Whether a sampler has a value of the right kind for each of its times.
fn value_fault(
    accessors: &Accessors,
    item: Item,
    sampler: &Sampler,
    moved: Property,
    weight_count: usize,
) -> Option<String> {
    let (width, per_time) = match moved {
        Property::Translation | Property::Scale => (3, 1),
        Property::Rotation => (4, 1),
        Property::MorphTargetWeights => (1, weight_count),
    };
    let output = sampler.output.value();
    if accessors.width(output, item) != Ok(width) {
        return Some(format!("{item} needs values of {width} numbers"));
    }
    // A cubic spline has a tangent before and behind each value.
    let knots = match sampler.interpolation {
        Checked::Valid(Interpolation::CubicSpline) => 3,
        _ => 1,
    };
    let times = accessors.count(sampler.input.value(), item).ok()?;
    let wanted = times.saturating_mul(per_time).saturating_mul(knots);
    let count = accessors.count(output, item).ok()?;
    (count != wanted).then(|| format!("{item} has {count} values where {wanted} are needed"))
}

/// How many morph targets the mesh of a node has.
fn weight_count(root: &Root, node: usize) -> usize {
    let mesh = root.nodes.get(node).and_then(|node| node.mesh.as_ref());
    let mesh = mesh.and_then(|mesh| root.meshes.get(mesh.value()));
    let primitive = mesh.and_then(|mesh| mesh.primitives.first());
    primitive.map_or(0, |primitive| primitive.targets.iter().flatten().count())
}
