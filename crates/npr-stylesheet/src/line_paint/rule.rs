//! What rules change about where the colour of lines comes from.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{DepthSpace, HueStop, KindColors, LineDepth, LineLight, LinePaint, LineSource};
use crate::Color;

/// What a rule changes about the colour of lines; what is absent stays.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct RulePaint {
    /// Colours for single kinds of its lines.
    pub kinds: KindColors,
    /// Where the colour of its other lines comes from.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub source: Option<LineSource>,
    /// What its colour is multiplied by, in linear light, 0..4.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0, max = 4.0))]
    pub factor: Option<f32>,
    /// Its picture for source `texture`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub image: Option<String>,
    /// How the colour of its lines changes with depth.
    pub depth: RuleLineDepth,
    /// How its lines change with light.
    pub light: RuleLineLight,
    /// Laid over all of its lines; `#0000` for nothing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tint: Option<Color>,
}

/// What a rule changes about the colour of lines over depth; what is absent stays.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct RuleLineDepth {
    /// What `near` and `far` count in.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub space: Option<DepthSpace>,
    /// Where the ramp begins, -1e6..1e6.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = -1e6, max = 1e6))]
    pub near: Option<f32>,
    /// Where it ends, -1e6..1e6, beyond `near`.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = -1e6, max = 1e6))]
    pub far: Option<f32>,
    /// What is laid over lines on the way; `[]` for nothing.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(length(max = 16))]
    pub ramp: Option<Vec<HueStop>>,
}

/// What a rule changes about lines in the light; what is absent stays.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct RuleLineLight {
    /// What is laid over lines from dark to light; `[]` for nothing.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(length(max = 16))]
    pub ramp: Option<Vec<HueStop>>,
    /// Factor on the width in the dark and in full light, 0..4 each.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(inner(inner(range(min = 0.0, max = 4.0))))]
    pub width: Option<[f32; 2]>,
    /// Factor on the opacity in the dark and in full light, 0..1 each.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(inner(inner(range(min = 0.0, max = 1.0))))]
    pub opacity: Option<[f32; 2]>,
    /// How much lines take the colour of the light behind, 0..1.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0, max = 1.0))]
    pub rim: Option<f32>,
}

impl RulePaint {
    /// `paint` with what the rule states in place of what it had.
    pub(crate) fn over(&self, paint: LinePaint) -> LinePaint {
        let (depth, light) = (&self.depth, &self.light);
        LinePaint {
            kinds: self.kinds.over(paint.kinds),
            source: self.source.unwrap_or(paint.source),
            factor: self.factor.unwrap_or(paint.factor),
            image: self.image.clone().unwrap_or(paint.image),
            depth: LineDepth {
                space: depth.space.unwrap_or(paint.depth.space),
                near: depth.near.unwrap_or(paint.depth.near),
                far: depth.far.unwrap_or(paint.depth.far),
                ramp: depth.ramp.clone().unwrap_or(paint.depth.ramp),
            },
            light: LineLight {
                ramp: light.ramp.clone().unwrap_or(paint.light.ramp),
                width: light.width.unwrap_or(paint.light.width),
                opacity: light.opacity.unwrap_or(paint.light.opacity),
                rim: light.rim.unwrap_or(paint.light.rim),
            },
            tint: self.tint.unwrap_or(paint.tint),
        }
    }
}
