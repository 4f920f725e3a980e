//! Lights that nodes of the scene carry (`KHR_lights_punctual`).
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::arithmetic_side_effects
)]

use std::convert::Infallible;
use std::f32::consts::{FRAC_PI_2, FRAC_PI_4};

use ::gltf::json::Root;
use ::gltf::json::extensions::scene::khr_lights_punctual::{Light as JsonLight, Type};
use ::gltf::json::scene::Node as JsonNode;
use ::gltf::json::validation::Checked;

use super::tree::Tree;
use crate::light::{Light, LightKind};
use crate::loading::Loading;
use crate::pool::Pool;
use crate::scene::Scene;

/// Reads the lights that kept nodes carry; a broken one is left out with a notice.
pub(crate) fn read(root: &Root, tree: &Tree, scene: &mut Scene, loading: &mut Loading) {
    let mut lights = Pool::default();
    for (_, source, node) in tree.nodes_with_source(root, scene) {
        let Some(index) = light_index(source) else {
            continue;
        };
        let Ok(place) = lights.place(index, || {
            Ok::<_, Infallible>(lights_of(root).get(index).and_then(light))
        });
        node.light = place;
        if place.is_none() {
            loading.notices.add(format!(
                "light {index} is missing or has values out of range and is left out"
            ));
        }
    }
    scene.lights = lights.items;
}

fn light_index(node: &JsonNode) -> Option<usize> {
    let extension = node.extensions.as_ref()?.khr_lights_punctual.as_ref()?;
    Some(extension.light.value())
}

fn lights_of(root: &Root) -> &[JsonLight] {
    let extension = root
        .extensions
        .as_ref()
        .and_then(|extensions| extensions.khr_lights_punctual.as_ref());
    extension.map_or(&[], |extension| &extension.lights)
}

fn light(source: &JsonLight) -> Option<Light> {
    let name = source.name.clone().unwrap_or_default();
    let range = source.range.filter(|range| range.is_finite());
    let light = Light {
        name,
        kind: kind(source)?,
        color: source.color,
        intensity: source.intensity,
        range,
    };
    let numbers = light
        .color
        .into_iter()
        .chain([light.intensity])
        .chain(range);
    numbers
        .into_iter()
        .all(|value| value >= 0.0 && value.is_finite())
        .then_some(light)
}

fn kind(source: &JsonLight) -> Option<LightKind> {
    match source.type_ {
        Checked::Valid(Type::Directional) => Some(LightKind::Directional),
        Checked::Valid(Type::Point) => Some(LightKind::Point),
        Checked::Valid(Type::Spot) => {
            let spot = source.spot.as_ref();
            let inner = spot.map_or(0.0, |spot| spot.inner_cone_angle);
            let outer = spot.map_or(FRAC_PI_4, |spot| spot.outer_cone_angle);
            let is_sound = inner >= 0.0 && inner < outer && outer <= FRAC_PI_2;
            is_sound.then_some(LightKind::Spot { inner, outer })
        }
        Checked::Invalid => None,
    }
}
