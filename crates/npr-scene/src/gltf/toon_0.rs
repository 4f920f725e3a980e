//! Toon materials of VRM 0.x in the terms of VRM 1.0, as three-vrm converts them.
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing
)]

use ::gltf::json::Root;
use npr_core::math;
use serde_json::{Map, Value, json};

use super::vrm::extension;
use crate::alpha::AlphaMode;
use crate::posture::numbers;

/// The shader of toon materials.
const SHADER: &str = "VRM/MToon";

/// Exponent by which colours become linear light.
const GAMMA: f32 = 2.2;

/// Width of an outline in hundredths: metres, or halves of the picture's height.
const HUNDREDTH: f32 = 0.01;

/// What VRM 0.x says of a toon material that VRM 1.0 leaves to glTF.
pub(crate) struct Beside {
    pub(crate) base_color: [f32; 4],
    /// The texture of the base colour, as glTF describes textures.
    pub(crate) base_color_texture: Option<Value>,
    pub(crate) emissive: [f32; 3],
    pub(crate) emissive_texture: Option<Value>,
    pub(crate) alpha: AlphaMode,
    pub(crate) double_sided: bool,
    /// Whether it has a normal texture.
    pub(crate) has_normals: bool,
}

/// What a file of VRM 0.x says of material `index`; none where it is no toon.
pub(crate) fn said(root: &Root, index: usize) -> Option<(Map<String, Value>, Beside)> {
    let list = extension(root, "VRM")?.get("materialProperties")?;
    let said = Properties(list.as_array()?.get(index)?);
    let is_toon = said.0.get("shader").and_then(Value::as_str) == Some(SHADER);
    is_toon.then(|| (said.mtoon(), said.beside()))
}

/// An entry of the list of materials: tables of numbers, of vectors, of textures and of switches.
struct Properties<'a>(&'a Value);

impl Properties<'_> {
    fn number(&self, key: &str, usual: f32) -> f32 {
        let said = self.0.get("floatProperties").and_then(|all| all.get(key));
        said.and_then(Value::as_f64).map_or(usual, |v| v as f32)
    }

    fn is_on(&self, key: &str) -> bool {
        let said = self.0.get("keywordMap").and_then(|all| all.get(key));
        said.and_then(Value::as_bool).unwrap_or(false)
    }

    fn vector(&self, key: &str) -> Option<[f32; 4]> {
        numbers(self.0.get("vectorProperties")?.get(key)?)
    }

    /// A colour in linear light; alpha stays as it is.
    fn color(&self, key: &str, usual: [f32; 4]) -> [f32; 4] {
        let [r, g, b, a] = self.vector(key).unwrap_or(usual);
        let [r, g, b] = [r, g, b].map(|v| math::powf(v.max(0.0), GAMMA));
        [r, g, b, a]
    }

    fn rgb(&self, key: &str, usual: [f32; 3]) -> [f32; 3] {
        let [r, g, b] = usual;
        let [r, g, b, _] = self.color(key, [r, g, b, 1.0]);
        [r, g, b]
    }

    /// A texture as glTF describes it, laid on the surface as `_MainTex` is; offsets count from below here.
    fn texture(&self, key: &str) -> Option<Value> {
        let index = self.0.get("textureProperties")?.get(key)?.as_u64()?;
        let Some([x, y, width, height]) = self.vector("_MainTex") else {
            return Some(json!({ "index": index }));
        };
        let transform = json!({ "offset": [x, 1.0 - height - y], "scale": [width, height] });
        Some(json!({ "index": index, "extensions": { "KHR_texture_transform": transform } }))
    }

    fn mtoon(&self) -> Map<String, Value> {
        // Move the border as far as it was moved, and widen it to the other side alone.
        let shift = self.number("_ShadeShift", 0.0);
        let toony = self.number("_ShadeToony", 0.9);
        let toony = math::mix(toony, 1.0, 0.5 + 0.5 * shift);
        let shift = -shift - (1.0 - toony);

        // Measure the outline by the whole height of the picture.
        let width = HUNDREDTH * self.number("_OutlineWidth", 0.0);
        let (mode, width) = match self.number("_OutlineWidthMode", 0.0) {
            1.0 => ("worldCoordinates", width),
            2.0 => ("screenCoordinates", 0.5 * width),
            _ => ("none", 0.0),
        };
        let is_mixed = self.number("_OutlineColorMode", 0.0) == 1.0;
        let mix = match is_mixed {
            true => self.number("_OutlineLightingMix", 1.0),
            false => 0.0,
        };

        // Write all of it down.
        let sphere = self.0.pointer("/textureProperties/_SphereAdd");
        let matcap = sphere.and_then(Value::as_u64);
        let said = json!({
            "transparentWithZWrite": self.is_on("_ALPHABLEND_ON") && self.number("_ZWrite", 0.0) == 1.0,
            "shadeColorFactor": self.rgb("_ShadeColor", [0.97, 0.81, 0.86]),
            "shadeMultiplyTexture": self.texture("_ShadeTexture"),
            "shadingShiftFactor": shift,
            "shadingToonyFactor": toony,
            "giEqualizationFactor": 1.0 - self.number("_IndirectLightIntensity", 0.1),
            "matcapTexture": matcap.map(|index| json!({ "index": index })),
            "rimLightingMixFactor": self.number("_RimLightingMix", 0.0),
            "rimMultiplyTexture": self.texture("_RimTexture"),
            "parametricRimColorFactor": self.rgb("_RimColor", [0.0; 3]),
            "parametricRimFresnelPowerFactor": self.number("_RimFresnelPower", 1.0),
            "parametricRimLiftFactor": self.number("_RimLift", 0.0),
            "outlineWidthMode": mode,
            "outlineWidthFactor": width,
            "outlineWidthMultiplyTexture": self.texture("_OutlineWidthTexture"),
            "outlineColorFactor": self.rgb("_OutlineColor", [0.0; 3]),
            "outlineLightingMixFactor": mix,
            "uvAnimationMaskTexture": self.texture("_UvAnimMaskTexture"),
            "uvAnimationScrollXSpeedFactor": self.number("_UvAnimScrollX", 0.0),
            "uvAnimationScrollYSpeedFactor": -self.number("_UvAnimScrollY", 0.0),
            "uvAnimationRotationSpeedFactor": self.number("_UvAnimRotation", 0.0),
        });
        match said {
            Value::Object(said) => said,
            _ => Map::new(),
        }
    }

    fn beside(&self) -> Beside {
        let alpha = match (self.is_on("_ALPHABLEND_ON"), self.is_on("_ALPHATEST_ON")) {
            (true, _) => AlphaMode::Blend,
            (false, true) => AlphaMode::Mask(self.number("_Cutoff", 0.5).clamp(0.0, 1.0)),
            (false, false) => AlphaMode::Opaque,
        };
        Beside {
            base_color: self.color("_Color", [1.0; 4]).map(|v| v.clamp(0.0, 1.0)),
            base_color_texture: self.texture("_MainTex"),
            emissive: self.rgb("_EmissionColor", [0.0; 3]),
            emissive_texture: self.texture("_EmissionMap"),
            alpha,
            double_sided: self.number("_CullMode", 2.0) == 0.0,
            has_normals: self.texture("_BumpMap").is_some(),
        }
    }
}
