//! Hatching: strokes, dots and grain that keep their size on screen, as tiles of numbers.
//!
//! A tile is a square that repeats in both directions, with strokes along v. It holds no ink but, for
//! every texel, the *hatch luminance* S of 0..1: 0 where a stroke begins, 1 where its surroundings fill
//! up last. Shading adds the light L and cuts at one half, `F = S + 2 (L - 0.5)` [Suzuki 2004, eq. 3.3],
//! so strokes grow from pointed ends and hairlines, as light falls, into solid ink.
//!
//! # Drawings
//!
//! Strokes must neither shrink nor crowd as the camera leaves. A tile is therefore a list of *drawings*,
//! three to each doubling of the distance. Each has the cube root of two fewer strokes per side than the
//! one before and draws them as much larger, so on screen both look alike. Level `l` of the tile
//! has half the texels per side of the level before; its four channels are drawings `3 l` to `3 l + 3`,
//! and [`hatch_luminance`] blends the two next to the wanted size. Tonal art maps [Praun et al. 2001] nest
//! their strokes the same way, in size and in tone; here tone is a threshold.
//!
//! # What stays true
//!
//! - *Nested*: a drawing holds no stroke, dot or gap that the drawing before lacks. Going away, strokes
//!   thin out one third of an octave after the other; those that stay keep their place. Only their wobble
//!   and pressure, which have a size on screen, drift by less than a stroke's width.
//! - *Continuous*: the last channel of a level is the first of the next, so nothing pops.
//! - *Linear*: in each drawing S is a rank, so the part of the tile that a threshold inks is the threshold:
//!   the ink share of light L is `1.5 - 2 L`. The blend keeps it, see [`hatch_luminance`].
//! - *Symmetric*: a half turn, `(u, v) -> (-u, -v)`, maps the tile onto itself, so charts of a surface
//!   may be glued turned.
//!
//! All of it is data made once; a frame looks up four texels per layer, whatever the pattern.

mod dots;
mod drawing;
mod lines;
pub(crate) mod noise;
mod picture;
mod points;
mod rank;
#[cfg(test)]
mod tests;
mod tile;
mod tone;

use crate::Length;

pub use picture::{PICTURE_SIDE_MAX, Picture, from_image};
pub use tile::{HatchError, HatchTile, SIDE_MAX, SIDE_MIN, levels};
pub use tone::{
    HatchSample, cross_layers, cross_luminance, detail, edge_gradient, first_of_two,
    hatch_luminance, ink_coverage, level_at, sample, second_layer_start, second_of_two, sharpen,
    tone_value,
};

/// What shadows are drawn with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema)
)]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Pattern {
    /// Pen strokes side by side.
    #[default]
    Parallel,
    /// Pen strokes, and from `cross_at` on a second layer across them.
    Cross,
    /// Dots set by hand, evenly but in no order.
    Stipple,
    /// A printer's screen: dots in rows, upright and at 45 degrees by turns with the distance.
    Dots,
    /// Shaky strokes that catch on the grain of the paper.
    Pencil,
    /// Long swelling strokes with drawn-out tips.
    Brush,
}

impl Pattern {
    /// Layers that shading evaluates: the second with u and v exchanged, see [`cross_luminance`].
    pub fn layer_count(self) -> u32 {
        match self {
            Self::Cross => 2,
            _ => 1,
        }
    }
}

/// How surfaces are hatched.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema)
)]
#[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
pub struct Hatch {
    /// What shadows are drawn with; default `parallel`.
    pub pattern: Pattern,
    /// A picture that is drawn with instead: a scanned pen, a screen tone, cloth; default empty, none. It repeats;
    /// its dark parts become strokes, and only the order of its greys counts. At `spacing` 8 one of its pixels covers
    /// about a pixel of the frame. Pattern `cross` lays it over itself, turned. At most 4096 pixels a side; powers of
    /// two stay sharp.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "String::is_empty"))]
    pub image: String,
    /// Distance between strokes or dots on screen; default 8 pixels at frame height 1080. 4 a fine
    /// engraving, 8 a comic page, 16 a poster.
    pub spacing: Length,
    /// Length of a stroke in spacings, 1..200; default 16. 3 dashes, 16 pen strokes, 200 ruled lines.
    #[cfg_attr(feature = "serde", schemars(range(min = 1.0, max = 200.0)))]
    pub length: f32,
    /// How far strokes stray from straight and even, 0..1; default 0.35. 0 a ruler, 0.35 a steady hand,
    /// 1 a moving train.
    #[cfg_attr(feature = "serde", schemars(range(min = 0.0, max = 1.0)))]
    pub wobble: f32,
    /// Part of a stroke that its tips take up, 0..1; default 0.7. 0 a felt pen's blunt ends, 1 a dip
    /// pen flicked off the paper.
    #[cfg_attr(feature = "serde", schemars(range(min = 0.0, max = 1.0)))]
    pub taper: f32,
    /// How much strokes and dots differ in weight, 0..1; default 0.4. 0 a machine, 1 a nervous brush.
    #[cfg_attr(feature = "serde", schemars(range(min = 0.0, max = 1.0)))]
    pub variation: f32,
    /// Steepness of a stroke's edge, 0.1..10; default 1. Above 1 strokes are of one width and stop at
    /// a tone; below 1 they reach further into light and shade.
    #[cfg_attr(feature = "serde", schemars(range(min = 0.1, max = 10.0)))]
    pub gain: f32,
    /// Direction of strokes against that of the surface, in degrees, -180..180; default 0. 45 for
    /// strokes around a limb, as on a screw.
    #[cfg_attr(feature = "serde", schemars(range(min = -180.0, max = 180.0)))]
    pub angle_deg: f32,
    /// For pattern `cross`: the light, 0..1, below which the second layer begins; default 0.5, half ink.
    #[cfg_attr(feature = "serde", schemars(range(min = 0.0, max = 1.0)))]
    pub cross_at: f32,
    /// How much the grain of the paper shows in strokes, 0..2; default 0, smooth. 0.6 drawing paper, 1.2 rough.
    #[cfg_attr(feature = "serde", schemars(range(min = 0.0, max = 2.0)))]
    pub grain: f32,
    /// Which of many drawings in the same hand, 0..4294967295; default 0.
    #[cfg_attr(feature = "serde", schemars(range(max = 4294967295u32)))]
    pub seed: u32,
}

impl Default for Hatch {
    fn default() -> Self {
        Self {
            pattern: Pattern::Parallel,
            image: String::new(),
            spacing: Length::ref_px(8.0),
            length: 16.0,
            wobble: 0.35,
            taper: 0.7,
            variation: 0.4,
            gain: 1.0,
            angle_deg: 0.0,
            cross_at: 0.5,
            grain: 0.0,
            seed: 0,
        }
    }
}

impl Hatch {
    /// The same with everything reset that shading alone needs: two hatches of one tile are equal then.
    pub fn of_tile(&self) -> Self {
        if !self.image.is_empty() {
            return Self {
                image: self.image.clone(),
                ..Self::default()
            };
        }
        Self {
            pattern: self.pattern,
            length: self.length,
            wobble: self.wobble,
            taper: self.taper,
            variation: self.variation,
            seed: self.seed,
            ..Self::default()
        }
    }
}
