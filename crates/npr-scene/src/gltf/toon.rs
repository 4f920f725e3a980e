//! Toon materials: MToon of VRM 1.0, and that of VRM 0.x in the same terms.
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::arithmetic_side_effects
)]

use ::gltf::json::Root;
use ::gltf::json::material::Material as JsonMaterial;
use ::gltf::json::texture::Info;
use npr_core::decoding::guard;
use serde_json::{Map, Value};

use super::texture::{Textures, info_uv_set};
use super::toon_0;
use crate::alpha::AlphaMode;
use crate::error::SceneError;
use crate::laid::TextureUse;
use crate::loading::Loading;
use crate::material::Material;
use crate::posture::numbers;
use crate::shown::shown;
use crate::toon::{OutlineWidth, Toon, ToonOutline, UvFlow};

/// The extension of a material.
const EXTENSION: &str = "VRMC_materials_mtoon";

/// Largest magnitude of a number that is taken as it is.
const MOST: f32 = 1e4;

/// What a file says of a toon material, in the terms of [`EXTENSION`].
pub(crate) struct Said {
    /// The extension.
    mtoon: Map<String, Value>,
    /// What VRM 0.x says beside it.
    pub(crate) beside: Option<toon_0::Beside>,
}

/// What the file says of material `index` as a toon; none where it is not one.
pub(crate) fn said(
    root: &Root,
    (index, source): (usize, &JsonMaterial),
    loading: &mut Loading,
) -> Option<Said> {
    // Ask the material itself.
    let extensions = source.extensions.as_ref();
    let mtoon = extensions.and_then(|extensions| extensions.others.get(EXTENSION)?.as_object());
    if let Some(mtoon) = mtoon {
        let version = mtoon.get("specVersion").and_then(Value::as_str);
        if matches!(version, Some("1.0" | "1.0-beta")) {
            return Some(Said {
                mtoon: mtoon.clone(),
                beside: None,
            });
        }
        let version = shown(version.unwrap_or_default());
        loading.notices.add(format!(
            "toon materials of version '{version}' are not known, and drawn without"
        ));
        return None;
    }

    // Ask the list of VRM 0.x.
    let (mtoon, beside) = toon_0::said(root, index)?;
    Some(Said {
        mtoon,
        beside: Some(beside),
    })
}

/// Reads a toon material whose other values are `material`'s; its images only where `is_used`.
///
/// # Errors
///
/// Images beyond a limit. Images that do not exist are left out with a notice.
pub(crate) fn read(
    said: &Said,
    (source, material): (&JsonMaterial, &Material),
    mut images: Images<'_, '_, '_, '_>,
) -> Result<Toon, SceneError> {
    // Take the values of glTF, or those of VRM 0.x.
    let beside = said.beside.as_ref();
    let emissive_texture = match beside {
        Some(beside) => images.named(beside.emissive_texture.as_ref())?,
        None => images.laid(source.emissive_texture.as_ref())?,
    };
    let alpha = beside.map_or(material.alpha, |beside| beside.alpha);
    let has_normals = beside.is_some_and(|beside| beside.has_normals);
    let notices = &mut images.loading.notices;
    if has_normals || source.normal_texture.is_some() {
        notices.add("normal textures of toon materials are not drawn");
    }
    if alpha == AlphaMode::Blend {
        notices.add("toon materials that blend are cut out");
    }
    let usual = Toon::default();
    let said = &said.mtoon;
    let factor = |key: &str, usual: f32| number(said, key).unwrap_or(usual);
    let share = |key: &str, usual: f32| factor(key, usual).clamp(0.0, 1.0);
    let offset = said.get("renderQueueOffsetNumber").and_then(Value::as_i64);

    // Join them with those of the extension.
    Ok(Toon {
        shade_color: color(said, "shadeColorFactor").unwrap_or(usual.shade_color),
        shade_texture: images.named(said.get("shadeMultiplyTexture"))?,
        shading_shift: factor("shadingShiftFactor", usual.shading_shift),
        shading_shift_texture: images.named(said.get("shadingShiftTexture"))?,
        shading_shift_scale: said
            .get("shadingShiftTexture")
            .and_then(|texture| number(texture.as_object()?, "scale"))
            .unwrap_or(usual.shading_shift_scale),
        shading_toony: share("shadingToonyFactor", usual.shading_toony),
        gi_equalization: share("giEqualizationFactor", usual.gi_equalization),
        matcap_color: color(said, "matcapFactor").unwrap_or(usual.matcap_color),
        matcap_texture: images.unlaid(said.get("matcapTexture"))?,
        rim_color: color(said, "parametricRimColorFactor").unwrap_or(usual.rim_color),
        rim_texture: images.named(said.get("rimMultiplyTexture"))?,
        rim_power: factor("parametricRimFresnelPowerFactor", usual.rim_power).max(1e-5),
        rim_lift: factor("parametricRimLiftFactor", usual.rim_lift),
        rim_lighting_mix: share("rimLightingMixFactor", usual.rim_lighting_mix),
        emissive: beside.map_or(material.emissive, |beside| beside.emissive),
        emissive_texture,
        outline: ToonOutline {
            width: outline_width(said),
            texture: images.named(said.get("outlineWidthMultiplyTexture"))?,
            color: color(said, "outlineColorFactor").unwrap_or(usual.outline.color),
            lighting_mix: share("outlineLightingMixFactor", usual.outline.lighting_mix),
        },
        render_queue_offset: offset.unwrap_or(0).clamp(-9, 9) as i32,
        blends_with_depth: said.get("transparentWithZWrite").and_then(Value::as_bool) == Some(true),
        alpha,
        double_sided: beside.map_or(material.double_sided, |beside| beside.double_sided),
        flow: UvFlow {
            scroll: [
                factor("uvAnimationScrollXSpeedFactor", 0.0),
                factor("uvAnimationScrollYSpeedFactor", 0.0),
            ],
            rotation: factor("uvAnimationRotationSpeedFactor", 0.0),
            mask: images.named(said.get("uvAnimationMaskTexture"))?,
        },
    })
}

/// The images of one material.
pub(crate) struct Images<'a, 'b, 'l, 'r> {
    pub(crate) textures: &'a mut Textures<'b>,
    pub(crate) loading: &'l mut Loading<'r>,
    /// Number of the material.
    pub(crate) material: u32,
    /// Whether any part has the material.
    pub(crate) is_used: bool,
    /// The set of coordinates that its base colour lies by.
    pub(crate) uv_set: u32,
}

impl Images<'_, '_, '_, '_> {
    /// The image that the extension describes, laid on the surface.
    pub(crate) fn named(&mut self, said: Option<&Value>) -> Result<Option<TextureUse>, SceneError> {
        let info = self.info(said);
        self.laid(info.as_ref())
    }

    /// The image that the extension describes, looked up without coordinates.
    fn unlaid(&mut self, said: Option<&Value>) -> Result<Option<TextureUse>, SceneError> {
        match self.info(said) {
            Some(info) => self.read(&info),
            None => Ok(None),
        }
    }

    /// An image laid on the surface by the coordinates of the base colour; none where it has others.
    fn laid(&mut self, info: Option<&Info>) -> Result<Option<TextureUse>, SceneError> {
        let Some(info) = info else { return Ok(None) };
        if info_uv_set(info) != self.uv_set {
            self.loading.notices.add(
                "images of toon materials by other coordinates than the base colour are left out",
            );
            return Ok(None);
        }
        self.read(info)
    }

    fn read(&mut self, info: &Info) -> Result<Option<TextureUse>, SceneError> {
        if !self.is_used {
            return Ok(None);
        }
        match self.textures.read(info, self.material, self.loading) {
            Err(fault) if !fault.is_limit() => {
                self.loading
                    .notices
                    .add(format!("an image of a toon material is left out: {fault}"));
                Ok(None)
            }
            other => other,
        }
    }

    /// What the extension says of a texture; none where that is absent or broken.
    fn info(&mut self, said: Option<&Value>) -> Option<Info> {
        let said = said.filter(|said| !said.is_null())?;
        let parsed = guard(|| serde_json::from_value(said.clone()).ok());
        let info = parsed.ok().flatten();
        if info.is_none() {
            self.loading
                .notices
                .add("an image of a toon material is not described as glTF asks, and left out");
        }
        info
    }
}

fn outline_width(said: &Map<String, Value>) -> Option<OutlineWidth> {
    let mode = said.get("outlineWidthMode").and_then(Value::as_str);
    let width = number(said, "outlineWidthFactor").filter(|width| *width > 0.0)?;
    match mode {
        Some("worldCoordinates") => Some(OutlineWidth::World(width)),
        Some("screenCoordinates") => Some(OutlineWidth::Screen(width)),
        _ => None,
    }
}

/// A number, held within [`MOST`].
fn number(said: &Map<String, Value>, key: &str) -> Option<f32> {
    let number = said.get(key)?.as_f64()? as f32;
    Some(number.clamp(-MOST, MOST))
}

/// A colour without negative channels.
fn color(said: &Map<String, Value>, key: &str) -> Option<[f32; 3]> {
    let color: [f32; 3] = numbers(said.get(key)?)?;
    Some(color.map(|channel| channel.clamp(0.0, MOST)))
}
