//! The table `shade` of a style: how surfaces are filled.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::overlay::style_table;
use crate::ramp::Stop;
use crate::{Color, Length};
use npr_style::ramp::Level;

/// Where the colour of a surface comes from and whether light changes it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ShadeMode {
    /// The material's colour, lit in the tones of the ramp.
    #[default]
    Ramp,
    /// The material's colour as it is; the ramp is not used.
    Flat,
    /// The paper's colour instead of the material's, lit in the tones of the ramp. With a single
    /// stop of light 1 only lines remain.
    Paper,
}

style_table! {
/// How surfaces are filled.
pub struct Shade {
    /// Where colour comes from; default `ramp`. `flat` for coloured outlines, `paper` for pure line art.
    pub mode: ShadeMode = ShadeMode::Ramp,
    /// Width of the step between two tones as a part of the ramp, 0..0.5; default 0. 0 a cut-out edge as
    /// in cel animation, 0.05 a felt pen, 0.4 an airbrush.
    #[schemars(range(min = 0.0, max = 0.5))]
    pub softness: f32 = 0.0,
    /// How far normals are averaged before tones are cut, as a share of the scene's radius, 0..0.5; default 0.02. 0
    /// shows the grain of scans in the edges of tones, 0.1 only large forms. Less where surfaces bend tightly, and
    /// never over hard edges. The layer of normals has these.
    #[schemars(range(min = 0.0, max = 0.5))]
    pub calm: f32 = 0.02,
    /// Narrowest piece of a tone that is drawn, in reference pixels or a length with a unit; default 0. At 2 strips of
    /// shade along folds and specks of light that are narrower take the tone around them; at 5 masses are calm and
    /// their corners round. At most 6.5 pixels of the picture. For hard steps alone: `softness` 0, and no `ramp_image`;
    /// the end of `ink.tone` "ink" is one too, unless `ink.paint` darkens it.
    pub least: Length = Length::ref_px(0.0),
    /// Colour of the paper that mode `paper` fills surfaces with; default white.
    pub paper: Color = Color::WHITE,
    /// Whether textures colour the material; default true. Off gives calm, even parts.
    pub use_textures: bool = true,
    /// Whether vertex colours tint the material; default true. Turn off where they hold widths.
    pub use_vertex_colors: bool = true,
    /// Strength of the material's colour, 0..2; default 1. 0 grey, 0.5 a faded print, 1.4 poster paint.
    #[schemars(range(min = 0.0, max = 2.0))]
    pub saturation: f32 = 1.0,
    /// The tones, 1 to 8, sorted by `at`; default three: shade, colour, highlight.
    /// Two look like cel animation, one like a plain fill.
    #[schemars(length(min = 1, max = 8))]
    pub ramp: Vec<Stop> = vec![
            Stop {
                at: 0.0,
                light: 0.55,
                tint: Some(Color::rgb(0xd6, 0xd0, 0xff)),
            },
            Stop::plain(0.52, 1.0),
            Stop::plain(0.95, 1.15),
        ],
    /// A picture whose middle row gives the tones in place of `ramp`, from what faces away on the left to what faces
    /// the light on the right; default empty, none. Its sRGB colours count as light, so white leaves the surface as
    /// it is. Steps are as hard as its pixels, or as soft as `softness`; gradients may have any shape.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub ramp_image: String = String::new(),
}
}

/// The stops as [`ramp_light`](npr_style::ramp::ramp_light) takes them.
pub fn levels(stops: &[Stop]) -> Vec<Level> {
    stops.iter().map(Stop::level).collect()
}
