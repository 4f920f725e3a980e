//! Brushes: images of what draws a stroke, made by formulas or from a picture.
//!
//! An image lies along a stroke, as wide as it, and repeats. Every texel has the height of the nap, which decides how
//! soon it touches the paper, and a share of ink. Heights made by formulas are ranks: a share of the image lies under a
//! height of the same share, so numbers mean the same for every tip.
//!
//! ```
//! use npr_style::brush::Tip;
//!
//! assert!(Tip::Pen.image().is_none(), "a pen draws one even ink");
//! let chalk = Tip::Chalk.image().unwrap();
//! assert_eq!(chalk.length(), 16.0, "the image repeats every sixteen widths");
//! ```

mod image;
mod tips;

pub use image::{BrushError, BrushImage, PICTURE_SIDE_MAX};

/// What strokes are drawn with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema)
)]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "serde", schemars(rename = "BrushTip"))]
pub enum Tip {
    /// A pen: one even ink.
    #[default]
    Pen,
    /// A comic nib: even ink with slightly scratched edges.
    GPen,
    /// A brush full of ink, whose hairs part where it is lifted.
    Brush,
    /// A brush with little ink: streaks of paper show all along.
    DryBrush,
    /// A felt pen: thin ink, stronger at its edges.
    Marker,
    /// A pencil on the grain of paper.
    Pencil,
    /// Charcoal: dark, broad and crumbling.
    Charcoal,
    /// Chalk: bright grains on a rough board.
    Chalk,
    /// An airbrush: no edge at all.
    Airbrush,
    /// Some fine lines beside each other, as of a quick hand.
    Sketch,
}

/// How a tip takes to paper.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Manner {
    /// How deep its nap is, as a share of full pressure.
    pub dry: f32,
    /// How deep the grain of the paper is for it, as a share of full pressure.
    pub grain: f32,
    /// Pressure, as a share of the full one, over which ink grows from none to all.
    pub soft: f32,
}

impl Tip {
    /// All tips.
    pub const ALL: [Self; 10] = [
        Self::Pen,
        Self::GPen,
        Self::Brush,
        Self::DryBrush,
        Self::Marker,
        Self::Pencil,
        Self::Charcoal,
        Self::Chalk,
        Self::Airbrush,
        Self::Sketch,
    ];

    /// How it takes to paper.
    pub fn manner(self) -> Manner {
        let [dry, grain, soft] = match self {
            Self::Pen | Self::Marker => [0.0, 0.0, 0.1],
            Self::GPen => [0.0, 0.15, 0.1],
            Self::Brush => [1.0, 0.1, 0.12],
            Self::DryBrush => [1.35, 0.3, 0.15],
            Self::Pencil => [0.4, 0.75, 0.8],
            Self::Charcoal => [0.8, 0.6, 0.45],
            Self::Chalk => [0.5, 1.0, 0.2],
            Self::Airbrush => [0.0, 0.0, 1.0],
            Self::Sketch => [0.2, 0.5, 0.6],
        };
        Manner { dry, grain, soft }
    }

    /// Its image; `None` for a pen, whose ink is even. The same one every time.
    pub fn image(self) -> Option<BrushImage> {
        tips::image(self)
    }
}
