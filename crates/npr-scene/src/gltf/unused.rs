//! What a strict reader refuses, though the scene can be drawn without it: told once each, by name.
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::arithmetic_side_effects
)]

use ::gltf::json::accessor::Accessor;
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
