//! The table `highlight` of a style: which highlights surfaces have.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::Color;
use crate::overlay::style_table;

/// What a highlight is computed by.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum HighlightModel {
    /// The half vector between light and eye [Blinn 1977]; can be moved and shaped.
    #[default]
    Blinn,
    /// The mirrored view [Phong 1975].
    Phong,
}

/// How a highlight ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Edge {
    /// There is none.
    #[default]
    #[serde(rename = "none")]
    Off,
    /// At once, like a spot of white paint.
    Crisp,
    /// Softly, like an airbrush.
    Soft,
}

style_table! {
/// The highlights of surfaces: a spot, a rim lit from behind, a straight streak. They add up.
pub struct Highlight;

/// What a rule changes about highlights; what is absent stays.
pub struct RuleHighlight {
    /// How the spot ends; default `none`, no spot.
    #[rule = "How the spot ends: `none`, `crisp` or `soft`."]
    pub edge: Edge = Edge::Off,
    /// What the spot is computed by; default `blinn`.
    #[rule = "What the spot is computed by."]
    pub model: HighlightModel = HighlightModel::Blinn,
    /// Colour of spot and streak; default white. Alpha is the strength.
    #[rule = "Colour of spot and streak; alpha is the strength."]
    pub color: Color = Color::WHITE,
    /// Sharpness of the spot, 1..1000; default 50. 200 a pinprick on chrome, 20 a broad sheen.
    #[schemars(range(min = 1.0, max = 1000.0))]
    #[rule = "Sharpness of the spot, 1..1000."]
    pub exponent: f32 = 50.0,
    /// Brightness from which the spot shows, 0..1; default 0.5. Higher makes it smaller. A light whose intensity is not
    /// above it makes no spot.
    #[schemars(range(min = 0.0, max = 1.0))]
    #[rule = "Brightness from which the spot shows, 0..1."]
    pub threshold: f32 = 0.5,
    /// How fast a soft spot rises, 0..8; default 1. 0.5 a haze, 3 a hot middle.
    #[schemars(range(min = 0.0, max = 8.0))]
    #[rule = "How fast a soft spot rises, 0..8."]
    pub gradient: f32 = 1.0,
    /// Moves the spot to the right and up, -1..1; default `[0, 0]`.
    #[schemars(inner(range(min = -1.0, max = 1.0)))]
    #[rule = "Moves the spot to the right and up, -1..1."]
    pub shift: [f32; 2] = [0.0; 2],
    /// Turns the axes of what follows, in degrees, -180..180; default 0.
    #[schemars(range(min = -180.0, max = 180.0))]
    #[rule = "Turns the axes of its shape, in degrees, -180..180."]
    pub turn_deg: f32 = 0.0,
    /// Stretches the spot along its first axis, 0..1; default 0. 0.8 a long gleam.
    #[schemars(range(min = 0.0, max = 1.0))]
    #[rule = "Stretches the spot along its first axis, 0..1."]
    pub stretch: f32 = 0.0,
    /// Splits the spot in two or four: gaps along both axes, 0..1; default `[0, 0]`.
    #[schemars(inner(range(min = 0.0, max = 1.0)))]
    #[rule = "Gaps along both axes that split the spot, 0..1."]
    pub split: [f32; 2] = [0.0; 2],
    /// Makes the spot square, 0..1; default 0. 0.5 a window.
    #[schemars(range(min = 0.0, max = 1.0))]
    #[rule = "Makes the spot square, 0..1."]
    pub square: f32 = 0.0,
}
with {
    /// Light from behind.
    #[rule = "Light from behind on its rims."]
    pub back: Back or RuleBack,
    /// A straight streak.
    #[rule = "Its straight streak."]
    pub streak: Streak or RuleStreak,
}
}

style_table! {
/// A light behind things that brightens their rims.
pub struct Back;

/// What a rule changes about light from behind; what is absent stays.
pub struct RuleBack {
    /// Whether there is one; default false.
    #[rule = "Whether there is one."]
    pub on: bool = false,
    /// Colour of the rim; default white. Alpha is the strength.
    #[rule = "Colour of the rim; alpha is the strength."]
    pub color: Color = Color::WHITE,
    /// Towards the light, in the camera's axes, of any length but 0; default `[0.7, 0.5, -0.6]`, behind on the right.
    #[schemars(inner(range(min = -1e9, max = 1e9)))]
    #[rule = "Towards the light, in the camera's axes."]
    pub direction: [f32; 3] = [0.7, 0.5, -0.6],
    /// Place on its ramp, 0..1, where the rim begins; default 0.72. Lower is broader.
    #[schemars(range(min = 0.0, max = 1.0))]
    #[rule = "Place on its ramp, 0..1, where the rim begins."]
    pub from: f32 = 0.72,
    /// Place on its ramp, 0..1, where it is full; default 0.76. The same as `from` cuts a hard edge.
    #[schemars(range(min = 0.0, max = 1.0))]
    #[rule = "Place on its ramp, 0..1, where it is full."]
    pub to: f32 = 0.76,
}
}

style_table! {
/// A straight streak of gloss with a thin one beside it, as drawn on glass and varnish; no light moves it.
pub struct Streak;

/// What a rule changes about a straight streak; what is absent stays.
pub struct RuleStreak {
    /// Whether there is one; default false.
    #[rule = "Whether there is one."]
    pub on: bool = false,
    /// Angle of the streak in the picture, in degrees, -180..180; default 60. 0 lies flat, 90 stands.
    #[schemars(range(min = -180.0, max = 180.0))]
    #[rule = "Angle of the streak in the picture, in degrees, -180..180."]
    pub angle_deg: f32 = 60.0,
    /// How far from the middle of the model it lies, in radii, -2..2; default -0.2.
    #[schemars(range(min = -2.0, max = 2.0))]
    #[rule = "How far from the middle of the model it lies, in radii, -2..2."]
    pub offset: f32 = -0.2,
    /// Width in radii of the model, 0..2; default 0.12.
    #[schemars(range(min = 0.0, max = 2.0))]
    #[rule = "Width in radii of the model, 0..2."]
    pub width: f32 = 0.12,
    /// How squarely, 0..1, a surface must face the eye to show it; default 0.5. 0 runs it to the rim.
    #[schemars(range(min = 0.0, max = 1.0))]
    #[rule = "How squarely, 0..1, a surface must face the eye to show it."]
    pub facing: f32 = 0.5,
}
}

impl Highlight {
    /// Whether there is any highlight.
    pub fn shows(&self) -> bool {
        self.edge != Edge::Off || self.back.on || self.streak.on
    }
}

impl RuleHighlight {
    /// Whether the rule turns on any highlight.
    pub fn may_show(&self) -> bool {
        let on = [self.back.on, self.streak.on].contains(&Some(true));
        on || self.edge.is_some_and(|edge| edge != Edge::Off)
    }
}
