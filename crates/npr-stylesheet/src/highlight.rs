//! Which highlights surfaces have.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::Color;

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

/// The highlights of surfaces: a spot, a rim lit from behind, a straight streak. They add up.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Highlight {
    /// How the spot ends; default `none`, no spot.
    pub edge: Edge,
    /// What the spot is computed by; default `blinn`.
    pub model: HighlightModel,
    /// Colour of spot and streak; default white. Alpha is the strength.
    pub color: Color,
    /// Sharpness of the spot, 1..1000; default 50. 200 a pinprick on chrome, 20 a broad sheen.
    #[schemars(range(min = 1.0, max = 1000.0))]
    pub exponent: f32,
    /// Brightness from which the spot shows, 0..1; default 0.5. Higher makes it smaller. A light whose intensity is not
    /// above it makes no spot.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub threshold: f32,
    /// How fast a soft spot rises, 0..8; default 1. 0.5 a haze, 3 a hot middle.
    #[schemars(range(min = 0.0, max = 8.0))]
    pub gradient: f32,
    /// Moves the spot to the right and up, -1..1; default `[0, 0]`.
    #[schemars(inner(range(min = -1.0, max = 1.0)))]
    pub shift: [f32; 2],
    /// Turns the axes of what follows, in degrees, -180..180; default 0.
    #[schemars(range(min = -180.0, max = 180.0))]
    pub turn_deg: f32,
    /// Stretches the spot along its first axis, 0..1; default 0. 0.8 a long gleam.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub stretch: f32,
    /// Splits the spot in two or four: gaps along both axes, 0..1; default `[0, 0]`.
    #[schemars(inner(range(min = 0.0, max = 1.0)))]
    pub split: [f32; 2],
    /// Makes the spot square, 0..1; default 0. 0.5 a window.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub square: f32,
    /// Light from behind.
    pub back: Back,
    /// A straight streak.
    pub streak: Streak,
}

/// A light behind things that brightens their rims.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Back {
    /// Whether there is one; default false.
    pub on: bool,
    /// Colour of the rim; default white. Alpha is the strength.
    pub color: Color,
    /// Towards the light, in the camera's axes, of any length but 0; default `[0.7, 0.5, -0.6]`, behind on the right.
    #[schemars(inner(range(min = -1e9, max = 1e9)))]
    pub direction: [f32; 3],
    /// Place on its ramp, 0..1, where the rim begins; default 0.72. Lower is broader.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub from: f32,
    /// Place on its ramp, 0..1, where it is full; default 0.76. The same as `from` cuts a hard edge.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub to: f32,
}

/// A straight streak of gloss with a thin one beside it, as drawn on glass and varnish; no light moves it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Streak {
    /// Whether there is one; default false.
    pub on: bool,
    /// Angle of the streak in the picture, in degrees, -180..180; default 60. 0 lies flat, 90 stands.
    #[schemars(range(min = -180.0, max = 180.0))]
    pub angle_deg: f32,
    /// How far from the middle of the model it lies, in radii, -2..2; default -0.2.
    #[schemars(range(min = -2.0, max = 2.0))]
    pub offset: f32,
    /// Width in radii of the model, 0..2; default 0.12.
    #[schemars(range(min = 0.0, max = 2.0))]
    pub width: f32,
    /// How squarely, 0..1, a surface must face the eye to show it; default 0.5. 0 runs it to the rim.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub facing: f32,
}

impl Highlight {
    /// Whether there is any highlight.
    pub fn shows(&self) -> bool {
        self.edge != Edge::Off || self.back.on || self.streak.on
    }
}

impl Default for Highlight {
    fn default() -> Self {
        Self {
            edge: Edge::Off,
            model: HighlightModel::Blinn,
            color: Color::WHITE,
            exponent: 50.0,
            threshold: 0.5,
            gradient: 1.0,
            shift: [0.0; 2],
            turn_deg: 0.0,
            stretch: 0.0,
            split: [0.0; 2],
            square: 0.0,
            back: Back::default(),
            streak: Streak::default(),
        }
    }
}

impl Default for Back {
    fn default() -> Self {
        Self {
            on: false,
            color: Color::WHITE,
            direction: [0.7, 0.5, -0.6],
            from: 0.72,
            to: 0.76,
        }
    }
}

impl Default for Streak {
    fn default() -> Self {
        Self {
            on: false,
            angle_deg: 60.0,
            offset: -0.2,
            width: 0.12,
            facing: 0.5,
        }
    }
}
