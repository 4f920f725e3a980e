//! Animations, read as clips; a channel that is broken is left out with a notice.
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::arithmetic_side_effects
)]

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use ::gltf::json::Root;
use ::gltf::json::animation::{
    Animation, Channel as JsonChannel, Interpolation as JsonInterpolation,
    Property as JsonProperty, Sampler,
};
use ::gltf::json::validation::Checked;

use super::accessor::Accessors;
use super::document::NO_NODE;
use super::error::Item;
use super::tree::Tree;
use crate::clip::{Channel, Clip, Interpolation, Property};
use crate::error::SceneError;
use crate::loading::Loading;
use crate::node::Node;

/// Reads the animations of a file that move kept nodes; every one is there, if only with the channels that are sound.
///
/// # Errors
///
/// Keys beyond the memory limit. Whatever is broken has a notice.
pub(crate) fn read(
    accessors: &Accessors,
    tree: &Tree,
    nodes: &[Node],
    loading: &mut Loading,
) -> Result<Vec<Clip>, SceneError> {
    let mut keys = Keys {
        accessors,
        times: BTreeMap::new(),
        values: BTreeMap::new(),
    };
    let mut clips = Vec::new();
    for (index, animation) in accessors.root.animations.iter().enumerate() {
        let note = |fault: String, loading: &mut Loading| {
            let item = Item::new("animation", index);
            loading.notices.add(format!("{item} is broken: {fault}"));
        };

        // Note samplers that no channel could use.
        for (index, sampler) in animation.samplers.iter().enumerate() {
            if let Err(fault) = shape_of(accessors, Item::new("sampler", index), sampler) {
                note(fault, loading);
            }
        }

        // Read the channels that are sound.
        let mut channels: Vec<Channel> = Vec::new();
        let mut moved = BTreeMap::new();
        for (index, source) in animation.channels.iter().enumerate() {
            let item = Item::new("channel", index);
            let channel = match target_of(accessors.root, animation, item, source) {
                Ok(target) => keys.channel(item, &target, (tree, nodes), loading)?,
                Err(fault) => Err(fault),
            };
            match channel {
                Ok(Some(channel)) => match moved.insert((channel.node, channel.property), item) {
                    None => channels.push(channel),
                    Some(first) => {
                        moved.insert((channel.node, channel.property), first);
                        note(format!("{item} moves what {first} moves"), loading);
                    }
                },
                Ok(None) => {}
                Err(fault) => note(fault, loading),
            }
        }
        let name = animation.name.clone().unwrap_or_default();
        loading.allowance.take::<u8>("names", name.len())?;
        loading
            .allowance
            .take::<Channel>("animations", channels.len())?;
        clips.push(Clip { name, channels });
    }
    Ok(clips)
}

/// The nodes whose morph weights any of the clips moves.
pub(crate) fn weighted_nodes(clips: &[Clip]) -> BTreeSet<u32> {
    let channels = clips.iter().flat_map(|clip| &clip.channels);
    let of_weights = channels.filter(|channel| channel.property == Property::Weights);
    of_weights.map(|channel| channel.node).collect()
}

/// What a channel moves, by what.
struct Target<'a> {
    sampler: &'a Sampler,
    sampler_item: Item,
    /// The node, as the file numbers it.
    node: usize,
    property: Property,
    /// How many morphs the mesh of the node has.
    weight_count: usize,
}

fn target_of<'a>(
    root: &Root,
    animation: &'a Animation,
    item: Item,
    channel: &JsonChannel,
) -> Result<Target<'a>, String> {
    // Find the values of the movement.
    let count = animation.samplers.len();
    let index = channel.sampler.value();
    let sampler_item = Item::new("sampler", index);
    let Some(sampler) = animation.samplers.get(index) else {
        return Err(format!(
            "{item} uses {sampler_item}, but there are only {count}"
        ));
    };

    // Find what they move.
    let (node, count) = (channel.target.node.value(), root.nodes.len());
    if node == NO_NODE as usize {
        return Err(format!("{item} moves no node"));
    }
    if node >= count {
        let node = Item::new("node", node);
        return Err(format!("{item} moves {node}, but there are only {count}"));
    }
    let property = match channel.target.path {
        Checked::Valid(JsonProperty::Translation) => Property::Translation,
        Checked::Valid(JsonProperty::Rotation) => Property::Rotation,
        Checked::Valid(JsonProperty::Scale) => Property::Scale,
        Checked::Valid(JsonProperty::MorphTargetWeights) => Property::Weights,
        Checked::Invalid => {
            return Err(format!("{item} moves something that glTF does not know"));
        }
    };
    Ok(Target {
        sampler,
        sampler_item,
        node,
        property,
        weight_count: weight_count(root, node),
    })
}

/// How many morph targets the mesh of a node has.
fn weight_count(root: &Root, node: usize) -> usize {
    let mesh = root.nodes.get(node).and_then(|node| node.mesh.as_ref());
    let mesh = mesh.and_then(|mesh| root.meshes.get(mesh.value()));
    let primitive = mesh.and_then(|mesh| mesh.primitives.first());
    primitive.map_or(0, |primitive| primitive.targets.iter().flatten().count())
}

/// The lists of a sampler, before they are read.
struct Shape {
    interpolation: Interpolation,
    /// Accessor of the times.
    input: usize,
    /// Accessor of the values.
    output: usize,
    /// How many numbers an element of the values has.
    width: usize,
    time_count: usize,
    value_count: usize,
}

/// What a sampler says of its lists, or what is wrong with it.
fn shape_of(accessors: &Accessors, item: Item, sampler: &Sampler) -> Result<Shape, String> {
    let interpolation = match sampler.interpolation {
        Checked::Valid(JsonInterpolation::Step) => Interpolation::Step,
        Checked::Valid(JsonInterpolation::Linear) => Interpolation::Linear,
        Checked::Valid(JsonInterpolation::CubicSpline) => Interpolation::CubicSpline,
        Checked::Invalid => {
            return Err(format!(
                "{item} has an interpolation that glTF does not know"
            ));
        }
    };
    let (input, output) = (sampler.input.value(), sampler.output.value());
    let told = |fault: super::GltfError| fault.to_string();
    let shape = Shape {
        interpolation,
        input,
        output,
        time_count: accessors.count(input, item).map_err(told)?,
        value_count: accessors.count(output, item).map_err(told)?,
        width: accessors.width(output, item).map_err(told)?,
    };
    if accessors.width(input, item) != Ok(1) {
        return Err(format!("{item} has times that are no single numbers"));
    }
    Ok(shape)
}

/// A list of numbers, or what is wrong with it.
type List = Result<Arc<[f32]>, ListFault>;

/// What is wrong with a list of numbers.
#[derive(Clone)]
enum ListFault {
    /// A whole sentence.
    Told(String),
    /// What a sampler that uses it has.
    OfSampler(&'static str),
}

impl ListFault {
    fn of(self, sampler: Item) -> String {
        match self {
            Self::Told(text) => text,
            Self::OfSampler(what) => format!("{sampler} has {what}"),
        }
    }
}

/// The keys of all clips; every accessor is read and judged once, however many samplers use it.
struct Keys<'a> {
    accessors: &'a Accessors<'a>,
    times: BTreeMap<usize, List>,
    values: BTreeMap<usize, List>,
}

impl Keys<'_> {
    /// A channel, none where its node is not part of the scene, or what is wrong with it.
    fn channel(
        &mut self,
        item: Item,
        target: &Target<'_>,
        (tree, nodes): (&Tree, &[Node]),
        loading: &mut Loading,
    ) -> Result<Result<Option<Channel>, String>, SceneError> {
        // Judge whether the values suit what they move.
        let sampler = target.sampler_item;
        let shape = match shape_of(self.accessors, sampler, target.sampler) {
            Ok(shape) => shape,
            Err(fault) => return Ok(Err(fault)),
        };
        if let Some(fault) = value_fault(item, &shape, target) {
            return Ok(Err(fault));
        }
        if shape.time_count == 0 {
            return Ok(Err(format!("{sampler} has no keys")));
        }

        // Find the node among those that are kept.
        let Some(node) = tree.place(target.node) else {
            return Ok(Ok(None));
        };
        let rest = nodes.get(node as usize).and_then(|node| node.rest);
        if target.property != Property::Weights && rest.is_none() {
            let node = Item::new("node", target.node);
            return Ok(Err(format!("{item} moves {node}, which has a matrix")));
        }

        // Read the keys.
        let times = self.times(shape.input, sampler, loading)?;
        let values = self.values(&shape, sampler, loading)?;
        let keys = times.and_then(|times| Ok((times, values?)));
        Ok(match keys {
            Ok((times, values)) => Ok(Some(Channel {
                node,
                property: target.property,
                interpolation: shape.interpolation,
                times,
                values,
            })),
            Err(fault) => Err(fault.of(sampler)),
        })
    }

    fn times(
        &mut self,
        accessor: usize,
        user: Item,
        loading: &mut Loading,
    ) -> Result<List, SceneError> {
        if let Some(known) = self.times.get(&accessor) {
            return Ok(known.clone());
        }
        let read = self.read::<1>(accessor, user, loading)?;
        let times = read.and_then(|times| match time_fault(&times) {
            None => Ok(times),
            Some(fault) => Err(ListFault::OfSampler(fault)),
        });
        self.times.insert(accessor, times.clone());
        Ok(times)
    }

    fn values(
        &mut self,
        shape: &Shape,
        user: Item,
        loading: &mut Loading,
    ) -> Result<List, SceneError> {
        let accessor = shape.output;
        if let Some(known) = self.values.get(&accessor) {
            return Ok(known.clone());
        }
        let read = match shape.width {
            1 => self.read::<1>(accessor, user, loading)?,
            3 => self.read::<3>(accessor, user, loading)?,
            _ => self.read::<4>(accessor, user, loading)?,
        };
        let values = read.and_then(|values| match values.iter().all(|v| v.is_finite()) {
            true => Ok(values),
            false => Err(ListFault::OfSampler("values that are not finite")),
        });
        self.values.insert(accessor, values.clone());
        Ok(values)
    }

    fn read<const N: usize>(
        &self,
        accessor: usize,
        user: Item,
        loading: &mut Loading,
    ) -> Result<List, SceneError> {
        let allowance = &mut loading.allowance;
        match self.accessors.floats::<N>(accessor, user, allowance) {
            Ok(rows) => Ok(Ok(rows.as_flattened().into())),
            Err(fault) if fault.is_limit() => Err(fault),
            Err(fault) => Ok(Err(ListFault::Told(fault.to_string()))),
        }
    }
}

/// What is wrong with the times of keys.
fn time_fault(times: &[f32]) -> Option<&'static str> {
    if !times.iter().all(|time| time.is_finite()) {
        return Some("times that are not finite");
    }
    if times.first().is_some_and(|first| *first < 0.0) {
        return Some("times below 0");
    }
    let ascends = times.is_sorted_by(|before, after| before < after);
    (!ascends).then_some("times that do not ascend")
}

/// Whether a sampler has a value of the right kind for each of its times.
fn value_fault(item: Item, shape: &Shape, target: &Target<'_>) -> Option<String> {
    let (width, per_time) = match target.property {
        Property::Translation | Property::Scale => (3, 1),
        Property::Rotation => (4, 1),
        Property::Weights | Property::Share => (1, target.weight_count),
    };
    if shape.width != width {
        return Some(format!("{item} needs values of {width} numbers"));
    }
    if per_time == 0 {
        let node = Item::new("node", target.node);
        return Some(format!(
            "{item} moves weights of {node}, which has no morphs"
        ));
    }
    let knots = shape.interpolation.knots();
    let wanted = shape
        .time_count
        .saturating_mul(per_time)
        .saturating_mul(knots);
    let count = shape.value_count;
    (count != wanted).then(|| format!("{item} has {count} values where {wanted} are needed"))
}
