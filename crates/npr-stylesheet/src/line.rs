//! The table `line` of a style: which lines are drawn, and with what.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::overlay::style_table;
use crate::{
    Color, Dash, Hand, Kinds, Length, LineBackground, LineBrush, LinePaint, LineSource, Potrace,
    Width,
};

/// How lines are found and drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
#[schemars(rename = "LineMethod")]
pub enum OutlineMethod {
    /// No lines.
    #[serde(rename = "none")]
    Off,
    /// Strokes of `npr lines`: exact, with hidden lines removed, joined and smoothed. Where no line model of the scene
    /// can be had, `shape` is in their place.
    #[default]
    #[serde(alias = "curves")]
    Strokes,
    /// Found on images, drawn on shapes: edges are chosen by kind and joined roundly.
    Shape,
    /// The same as published: every edge of a front face, square ends [Okuya et al. 2016].
    Okuya,
    /// An image filter alone: one uniform width in mask pixels [Saito and Takahashi 1990].
    Filter,
    /// Back faces pushed out behind the shape: width by curvature, silhouettes only [Matsuo 2010].
    Hull,
    /// The union of `filter` and `hull`.
    #[serde(rename = "filter+hull")]
    FilterHull,
    /// Edges between a front and a back face [Marshall 2001].
    Edges,
    /// The pixels outside of a subject that touch it: one pixel wide, whatever `width` says [Tsuji 2014].
    Rim,
    /// Pixels whose surface lies near its silhouette, by an angle [Gooch et al. 1999].
    Angle,
    /// Strokes made of the pixels of a picture of all lines, as published [Jiang et al. 2022].
    Potrace,
}

impl OutlineMethod {
    /// How a method that draws the strokes of a line drawing finds its lines; `None` for other methods.
    pub const fn source(self) -> Option<LineSource> {
        match self {
            Self::Strokes => Some(LineSource::Edges),
            Self::Potrace => Some(LineSource::Potrace),
            _ => None,
        }
    }
}

/// Angle in degrees from which an edge is a crease, where a style names no other.
pub const CREASE_ANGLE_DEG: f32 = 40.0;

/// What the angle of a crease lies between.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum CreaseFrom {
    /// The file's normals: where shading runs on smoothly across an edge there is no crease, however far its faces
    /// turn. Where the file has no normals, its faces.
    #[default]
    Normals,
    /// The faces, whatever the file's normals: every fold of a coarse mesh.
    Faces,
}

/// How it is found what is seen of the strokes of a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum LineVisibility {
    /// By the shapes, for every place of a line: the best for stills.
    #[default]
    Exact,
    /// By the frame's own pixels, a sample of the line at each: for real time, as a device does it by itself.
    Sampled,
}

/// How cards are drawn: long thin pieces that stand for a blade of grass or a lock of hair.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum CardLines {
    /// As all surfaces are: by their outlines and folds.
    #[default]
    Outline,
    /// Each by one line through its middle, as wide as the card looks. It has no other lines.
    Centre,
    /// All of one material as one mass, whatever it is made of: by lines where its image ends, and none within.
    Tuft,
}

style_table! {
/// Which lines are drawn, and with what.
pub struct Line {
    /// How lines are found and drawn; default `strokes`. The others are there for comparison.
    pub method: OutlineMethod = OutlineMethod::Strokes,
    /// Colour of the ink; default dark brown. A dark tone of the picture's main hue looks softer.
    pub color: Color = Color::rgb(0x2b, 0x1a, 0x12),
    /// How much the ink covers, 0..1; default 1. 0.3 a hard pencil, 1 ink.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub opacity: f32 = 1.0,
    /// What else decides their colour: kind, surface, light, depth.
    pub paint: LinePaint = LinePaint::default(),
    /// Angle in degrees from which an edge is a crease, 0..180; default 40. 20 draws every bevel, 80 only corners.
    /// `crease_from` says between what.
    #[schemars(range(min = 0.0, max = 180.0))]
    pub crease_angle_deg: f32 = CREASE_ANGLE_DEG,
    /// What that angle lies between; default `normals`, so that smooth shading hides the folds of a coarse mesh.
    pub crease_from: CreaseFrom = CreaseFrom::default(),
    /// By how much less an edge may fold where a crease goes on along it to another line, in degrees, 0..180; default
    /// 15. 0 breaks folds of scans and of soft shading into dashes; 25 draws facets. Of method `strokes`, and of
    /// drawings as curves.
    #[schemars(range(min = 0.0, max = 180.0))]
    pub crease_slack_deg: f32 = 15.0,
    /// Angle in degrees between faces from which an edge is a crease however smoothly its normals run on, 0..180;
    /// default 75. 180 trusts the file's normals alone, 60 draws the bends of coarse limbs. Of `crease_from` normals,
    /// of method `strokes`, and of drawings as curves.
    #[schemars(range(min = 0.0, max = 180.0))]
    pub crease_hard_deg: f32 = 75.0,
    /// Width of the widest rounding that is drawn as a crease, as a share of the scene's radius, 0..0.2; default 0.015.
    /// 0 leaves rounded and chamfered edges to the tones, 0.05 draws soft ones too. Only between flat sides. Of method
    /// `strokes` with exact sights, and of drawings as curves.
    #[schemars(range(min = 0.0, max = 0.2))]
    pub crease_round: f32 = 0.015,
    /// Length under which a crease is left out that ends in the open, where no other line meets it; default 48. 0
    /// draws all, 20 leaves out stubs, 100 all but long folds. Of methods `strokes` and `potrace`, and of drawings as
    /// curves.
    pub crease_least: Length = Length::ref_px(48.0),
    /// The same of lines of all kinds but marked ones, which are meant; default 24. 0 draws all, 12 clears scans of
    /// most shreds, 40 costs faces their small lines.
    pub least: Length = Length::ref_px(24.0),
    /// How it is found what is seen of strokes; default `exact`. `sampled` lets a device find it by itself, and
    /// leaves lines side by side and short ones as they are. Dashes, overshoot, stamps, method `potrace`, layers and
    /// tiles need `exact`.
    pub visibility: LineVisibility = LineVisibility::default(),
    /// How cards are drawn, pieces of hair and grass at least four times as long as wide; default `outline`. `centre`
    /// draws each by one line, from its root to its tip, as wide as it looks but no thinner than the thinnest line of
    /// the style; `width_factor` of a rule makes such lines finer. `tuft` draws the outline of all of them together. Of
    /// methods `strokes` and `potrace`, and of drawings as curves; `tuft` not of those that find lines on pixels.
    pub cards: CardLines = CardLines::default(),
    /// Angle, in degrees, from which a stroke is cut where it turns sharply in the picture, 10..180; default 180,
    /// never. 60 draws a box in strokes along its sides, each with the brush's own ends. Of drawings as curves only.
    #[schemars(range(min = 10.0, max = 180.0))]
    pub split_angle_deg: f32 = 180.0,
    /// For method `angle`: how far from its silhouette, in degrees, a surface is inked, 0..90; default 15. Larger is
    /// thicker, up to six line widths; flat faces are not inked.
    #[schemars(range(min = 0.0, max = 90.0))]
    pub angle_threshold_deg: f32 = 15.0,
    /// For method `angle`: how softly the ink ends, as a part of that band, 0..1; default 0.1. 0 a cut edge, 1 an
    /// airbrush.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub angle_softness: f32 = 0.1,
    /// What all lengths of strokes are multiplied by, 0.05..20: their widths, tapers and dashes, and how a hand sways;
    /// default 1. 0.5 for a small print, 2 for a poster; `width.base` alone makes lines thicker and no longer.
    #[schemars(range(min = 0.05, max = 20.0))]
    pub scale: f32 = 1.0,
    /// Length of the longest stroke: longer lines are drawn in several equal ones, at least 4 px long; default 0, any.
    /// 60 a careful sketch, 200 an arm's reach. Of methods `strokes` and `potrace`, and of drawings as curves.
    pub longest: Length = Length::ref_px(0.0),
    /// Points of the scene at rest at which the pen is lifted, 64 at most: the line nearest to each in the picture ends
    /// there, within 3 % of the height, and thins out as `width.taper` says. A point moves with the surface as the
    /// nearest vertex does, so that a film needs no more of them than a still. Of methods `strokes` with exact sights
    /// and `potrace`, and of drawings as curves.
    #[schemars(length(max = 64), inner(inner(range(min = -1e9, max = 1e9))))]
    pub guides: Vec<[f32; 3]> = Vec::new(),
    /// The kinds of line that are drawn.
    pub kinds: Kinds = Kinds::default(),
    /// The constants of method `potrace`.
    pub potrace: Potrace = Potrace::default(),
    /// How wide lines are.
    pub width: Width = Width::default(),
    /// What strokes are drawn with.
    pub brush: LineBrush = LineBrush::default(),
    /// How a hand draws them; of methods `strokes` and `potrace`, and of drawings as curves.
    pub hand: Hand = Hand::default(),
    /// How they are cut into dashes; of the same methods.
    pub dash: Dash = Dash::default(),
    /// How their colour minds what lies behind them.
    pub background: LineBackground = LineBackground::default(),
}
}

impl Line {
    /// A length of strokes at their scale.
    pub fn scaled(&self, length: Length) -> Length {
        Length {
            value: length.value * self.scale,
            ..length
        }
    }
}
