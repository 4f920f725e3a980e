//! Materials: base colour, and the few other values a drawing may use.
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::arithmetic_side_effects
)]

use std::collections::BTreeSet;

use ::gltf::json::material::{AlphaMode as JsonAlphaMode, Material as JsonMaterial};
use ::gltf::json::mesh::Primitive;
use ::gltf::json::texture::Info;
use ::gltf::json::validation::Checked;
use ::gltf::json::{Index, Root};
use npr_core::decoding::guard;
use serde_json::Value;

use super::accessor::Accessors;
use super::texture::{Textures, info_uv_set};
use super::toon;
use crate::alpha::AlphaMode;
use crate::error::SceneError;
use crate::loading::Loading;
use crate::material::Material;
use crate::scene::Scene;

/// Reads all materials, and the base colour images of those that parts use.
///
/// # Errors
///
/// A texture or image that does not exist, or images beyond a limit.
pub(crate) fn read(
    accessors: &Accessors,
    scene: &mut Scene,
    loading: &mut Loading,
) -> Result<(), SceneError> {
    let parts = scene.meshes.iter().flat_map(|mesh| &mesh.parts);
    let used: BTreeSet<u32> = parts.filter_map(|part| part.material).collect();
    let mut textures = Textures::new(accessors);
    for (index, source) in (0u32..).zip(&accessors.root.materials) {
        let mut material = surface(source);
        let is_used = used.contains(&index);
        if is_used && let Some(info) = base_color_info(source) {
            material.base_color_texture = textures.read(info, index, loading)?;
        }

        // Read how it is drawn as a toon. VRM 0.x says some of it beside glTF, which counts where glTF says nothing.
        if let Some(said) = toon::said(accessors.root, (index as usize, source), loading) {
            let mut images = toon::Images {
                textures: &mut textures,
                loading,
                material: index,
                is_used,
                uv_set: base_uv_set(source),
            };
            if let Some(beside) = &said.beside {
                if material.base_color == [1.0; 4] {
                    material.base_color = beside.base_color;
                }
                if base_color_info(source).is_none() {
                    material.base_color_texture =
                        images.named(beside.base_color_texture.as_ref())?;
                }
            }
            material.toon = Some(Box::new(toon::read(&said, (source, &material), images)?));
        }
        scene.materials.push(material);
    }
    scene.images = textures.into_images();
    Ok(())
}

/// Which set of texture coordinates the base colour of `primitive` uses.
pub(crate) fn uv_set(root: &Root, primitive: &Primitive) -> u32 {
    let index = primitive.material.as_ref().map(Index::value);
    let material = index.and_then(|index| root.materials.get(index));
    material.map_or(0, base_uv_set)
}

fn base_uv_set(material: &JsonMaterial) -> u32 {
    base_color_info(material).map_or(0, info_uv_set)
}

fn base_color_info(material: &JsonMaterial) -> Option<&Info> {
    let extensions = material.extensions.as_ref();
    match extensions.and_then(|extensions| extensions.pbr_specular_glossiness.as_ref()) {
        Some(specular) => specular.diffuse_texture.as_ref(),
        None => material.pbr_metallic_roughness.base_color_texture.as_ref(),
    }
}

fn surface(source: &JsonMaterial) -> Material {
    let extensions = source.extensions.as_ref();
    let pbr = &source.pbr_metallic_roughness;
    // Factors are then the most that the texture, which is not read, can say; most files leave them at 1.
    let textured = pbr.metallic_roughness_texture.is_some();
    let left_open = if textured { 0.5 } else { 1.0 };
    let mut material = Material {
        name: source.name.clone().unwrap_or_default(),
        base_color: pbr.base_color_factor.0.map(factor),
        base_color_texture: None,
        metallic: left_open * factor(pbr.metallic_factor.0),
        roughness: left_open * factor(pbr.roughness_factor.0),
        emissive: emissive(source),
        double_sided: source.double_sided,
        alpha: alpha(source),
        unlit: extensions.is_some_and(|extensions| extensions.unlit.is_some()),
        marked: asks_for_lines(source),
        toon: None,
    };
    if let Some(specular) =
        extensions.and_then(|extensions| extensions.pbr_specular_glossiness.as_ref())
    {
        material.base_color = specular.diffuse_factor.0.map(factor);
        material.metallic = 0.0;
        material.roughness = 1.0 - factor(specular.glossiness_factor.0);
    }
    material
}

/// Whether the extras say `{"npr": {"lines": true}}`; what else they say is somebody else's.
fn asks_for_lines(source: &JsonMaterial) -> bool {
    let extras = source.extras.as_ref();
    let parsed = |text| guard(|| serde_json::from_str::<Value>(text));
    let said = extras.and_then(|extras| parsed(extras.get()).ok()?.ok());
    let lines = said.as_ref().and_then(|said| said.pointer("/npr/lines"));
    lines.and_then(Value::as_bool).unwrap_or(false)
}

fn emissive(source: &JsonMaterial) -> [f32; 3] {
    let extension = source
        .extensions
        .as_ref()
        .and_then(|extensions| extensions.emissive_strength.as_ref());
    let strength = extension.map_or(1.0, |extension| extension.emissive_strength.0);
    let strength = if strength.is_finite() {
        strength.max(0.0)
    } else {
        1.0
    };
    source
        .emissive_factor
        .0
        .map(|value| factor(value) * strength)
}

fn alpha(source: &JsonMaterial) -> AlphaMode {
    match source.alpha_mode {
        Checked::Valid(JsonAlphaMode::Mask) => {
            AlphaMode::Mask(source.alpha_cutoff.map_or(0.5, |cutoff| factor(cutoff.0)))
        }
        Checked::Valid(JsonAlphaMode::Blend) => AlphaMode::Blend,
        Checked::Valid(JsonAlphaMode::Opaque) | Checked::Invalid => AlphaMode::Opaque,
    }
}

/// `value` within 0..1; JSON has no NaN, and an overflow to infinity becomes 1.
fn factor(value: f32) -> f32 {
    value.clamp(0.0, 1.0)
}
