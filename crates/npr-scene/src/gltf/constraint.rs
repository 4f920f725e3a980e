//! Nodes that follow others [VRMC_node_constraint 1.0]; what is broken is left out with a notice.
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::arithmetic_side_effects
)]

use ::gltf::json::Root;
use serde_json::Value;

use super::tree::Tree;
use crate::constraint::{Constraint, ConstraintKind, in_order};
use crate::error::SceneError;
use crate::loading::Loading;
use crate::node::Node;
use crate::shown::shown;

/// Name of the extension.
const EXTENSION: &str = "VRMC_node_constraint";

/// Reads the constraints of all nodes of the scene, each behind those that it depends on.
///
/// # Errors
///
/// More than the memory limit. Whatever is broken has a notice.
pub(crate) fn read(
    root: &Root,
    tree: &Tree,
    nodes: &[Node],
    loading: &mut Loading,
) -> Result<Vec<Constraint>, SceneError> {
    // Read one of each node.
    let mut constraints = Vec::new();
    for (index, source) in root.nodes.iter().enumerate() {
        let said = source.extensions.as_ref();
        let Some(said) = said.and_then(|all| all.others.get(EXTENSION)) else {
            continue;
        };
        let Some(place) = tree.place(index) else {
            continue;
        };
        let node = nodes.get(place as usize);
        match constraint(said, place, (tree, nodes, root.nodes.len())) {
            Ok(constraint) => {
                loading.allowance.take::<Constraint>("constraints", 1)?;
                constraints.push(constraint);
            }
            Err(fault) => {
                let name = shown(node.map_or("", |node| &node.name));
                let text = format!("the constraint of node '{name}' is ignored: {fault}");
                loading.notices.add(text);
            }
        }
    }
    if constraints.is_empty() {
        return Ok(constraints);
    }

    // Put them in order.
    let bytes_a_node = "the order of constraints";
    let steps = nodes.len().saturating_add(constraints.len());
    loading.allowance.take::<[usize; 12]>(bytes_a_node, steps)?;
    let (ordered, circular) = in_order(constraints, nodes);
    if let Some(first) = circular.first() {
        let name = nodes.get(first.node as usize);
        let name = shown(name.map_or("", |node| &node.name));
        let text = match circular.len() {
            1 => format!("the constraint of node '{name}' is ignored: it follows itself"),
            count => format!(
                "the constraints of {count} nodes, '{name}' among them, are ignored: they follow each other in circles"
            ),
        };
        loading.notices.add(text);
    }
    Ok(ordered)
}

/// The constraint of a node, or what is wrong with it.
fn constraint(
    said: &Value,
    place: u32,
    (tree, nodes, count): (&Tree, &[Node], usize),
) -> Result<Constraint, String> {
    // Find out how it follows.
    let part = |kind: &str| said.pointer(&format!("/constraint/{kind}"));
    let text = |said: &Value, key| said.get(key).and_then(Value::as_str).map(str::to_owned);
    let (said, kind) = if let Some(said) = part("roll") {
        let axis = text(said, "rollAxis");
        (
            said,
            axis.and_then(|name| axis_of(&name))
                .map(ConstraintKind::Roll),
        )
    } else if let Some(said) = part("aim") {
        let axis = text(said, "aimAxis");
        let axis = axis.and_then(|name| signed_axis_of(&name));
        (said, axis.map(ConstraintKind::Aim))
    } else if let Some(said) = part("rotation") {
        (said, Some(ConstraintKind::Rotation))
    } else {
        return Err("it is none of roll, aim and rotation".to_owned());
    };
    let kind = kind.ok_or("it names no axis")?;

    // Find its source.
    let number = said.get("source").and_then(Value::as_u64);
    let number = number.and_then(|number| usize::try_from(number).ok());
    let number = number.filter(|number| *number < count);
    let number = number.ok_or_else(|| format!("it names no node of the {count} in the file"))?;
    let source = tree.place(number);
    let source = source
        .ok_or_else(|| format!("it follows node {number}, which is not part of the scene"))?;

    // Judge the rest.
    let weight = said.get("weight").map_or(Some(1.0), Value::as_f64);
    let weight = weight.filter(|weight| (0.0..=1.0).contains(weight));
    let weight = weight.ok_or("its weight is no number from 0 to 1")? as f32;
    let rest = nodes.get(place as usize).and_then(|node| node.rest);
    rest.ok_or("the node has a matrix and is not posed")?;
    Ok(Constraint {
        node: place,
        source,
        weight,
        kind,
    })
}

/// The axis `X`, `Y` or `Z`.
fn axis_of(name: &str) -> Option<[f32; 3]> {
    match name {
        "X" => Some([1.0, 0.0, 0.0]),
        "Y" => Some([0.0, 1.0, 0.0]),
        "Z" => Some([0.0, 0.0, 1.0]),
        _ => None,
    }
}

/// An axis with its sign, such as `PositiveX`.
fn signed_axis_of(name: &str) -> Option<[f32; 3]> {
    let positive = name.strip_prefix("Positive").and_then(axis_of);
    let negative = || name.strip_prefix("Negative").and_then(axis_of);
    positive.or_else(|| Some(negative()?.map(|v| -v)))
}
