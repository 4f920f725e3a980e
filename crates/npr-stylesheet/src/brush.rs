//! What strokes are drawn with, and on what paper.

use npr_style::brush::{Manner, Tip};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::Length;
use crate::overlay::style_table;

/// How the image of a brush lies along a stroke.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum BrushMapping {
    /// By its length: the image repeats, and begins anywhere.
    #[default]
    Length,
    /// Once over the whole stroke, from its start to its end.
    Once,
    /// As stamps, set down one after the other.
    Stamps,
}

style_table! {
/// How stamps lie along strokes; for mapping `stamps`.
pub struct Stamp;
/// What a rule changes about how stamps lie along strokes; what is absent stays.
pub struct RuleStamp {
    /// Distance between stamps, in widths of the style's line, 0.02..50; default 0.25. 0.1 an airbrush, 1.5 a row of
    /// beads.
    #[schemars(range(min = 0.02, max = 50.0))]
    #[rule = "Distance between stamps, in widths of the style's line, 0.02..50."]
    pub spacing: f32 = 0.25,
    /// Size of a stamp, in widths of the stroke, 0.05..50; default 1. 4 leaves on a twig.
    #[schemars(range(min = 0.05, max = 50.0))]
    #[rule = "Size of a stamp, in widths of the stroke, 0.05..50."]
    pub size: f32 = 1.0,
    /// Greatest share by which one is larger or smaller than others, 0..1; default 0.2. 0 a machine.
    #[schemars(range(min = 0.0, max = 1.0))]
    #[rule = "Greatest share by which one stamp is larger or smaller than others, 0..1."]
    pub jitter: f32 = 0.2,
    /// Angle of all stamps in degrees, -180..180; default 0.
    #[schemars(range(min = -180.0, max = 180.0))]
    #[rule = "Angle of all stamps in degrees, -180..180."]
    pub angle_deg: f32 = 0.0,
    /// Greatest angle in degrees by which one is turned against others, 0..180; default 180, any way. 0 all alike.
    #[schemars(range(min = 0.0, max = 180.0))]
    #[rule = "Greatest angle in degrees by which one stamp is turned against others, 0..180."]
    pub turn_deg: f32 = 180.0,
    /// Whether stamps turn with the stroke; default true. Off holds a calligraphic nib at its angle.
    #[rule = "Whether stamps turn with the stroke."]
    pub rake: bool = true,
    /// Greatest distance from the stroke, in its widths, 0..50; default 0. 0.3 crumbles, 2 is grass beside a path.
    #[schemars(range(min = 0.0, max = 50.0))]
    #[rule = "Greatest distance of stamps from the stroke, in its widths, 0..50."]
    pub scatter: f32 = 0.0,
}
}

style_table! {
/// What strokes are drawn with: a tip, or the image of a brush.
///
/// Every place of a brush has a height of its nap. A brush touches the paper where its nap, the paper's grain and the
/// pressure together reach it; the pressure is full where a stroke is widest, and falls towards its tapers.
pub struct LineBrush;
/// What a rule changes about what strokes are drawn with; what is absent stays.
pub struct RuleLineBrush {
    /// What draws; default `pen`, one even ink.
    #[rule = "What draws the part's strokes."]
    pub tip: Tip = Tip::Pen,
    /// Path of a picture to draw with in place of the tip's image; default none. It lies along the stroke: its grey is
    /// the height of the nap, its alpha how much ink there is.
    #[rule = "Path of a picture to draw the part's strokes with; empty for the tip after all."]
    pub image: String = String::new(),
    /// How the image lies along a stroke; default `length`.
    #[rule = "How the image lies along a stroke."]
    pub mapping: BrushMapping = BrushMapping::Length,
    /// How much longer the image is than in its own proportions, 0.05..50; default 1. 4 draws streaks out, 0.5 crumbles
    /// them.
    #[schemars(range(min = 0.05, max = 50.0))]
    #[rule = "How much longer the image is than in its own proportions, 0.05..50."]
    pub stretch: f32 = 1.0,
    /// How much of the nap stays off the paper, 0..2; default the tip's own. 0 drips with ink, 1 parts where the
    /// pressure falls, 2 is nearly dry.
    #[schemars(range(min = 0.0, max = 2.0))]
    #[rule = "How much of the nap stays off the paper, 0..2."]
    pub dry: Option<f32> = None,
    /// How much the grain of the paper shows, 0..2; default the tip's own. 0 smooth board, 1 drawing paper, 1.5 rough.
    #[schemars(range(min = 0.0, max = 2.0))]
    #[rule = "How much the grain of the paper shows, 0..2."]
    pub grain: Option<f32> = None,
    /// How softly ink begins, 0.02..2; default the tip's own. 0.05 ink, 0.4 graphite.
    #[schemars(range(min = 0.02, max = 2.0))]
    #[rule = "How softly ink begins, 0.02..2."]
    pub soft: Option<f32> = None,
}
with {
    /// How stamps lie along strokes; for mapping `stamps`.
    #[rule = "How stamps lie along the part's strokes; for mapping `stamps`."]
    pub stamp: Stamp or RuleStamp,
}
}

impl LineBrush {
    /// How it takes to paper: as the tip does, where no key says otherwise.
    pub fn manner(&self) -> Manner {
        let of_tip = match self.image.is_empty() {
            true => self.tip.manner(),
            false => OF_IMAGES,
        };
        Manner {
            dry: self.dry.unwrap_or(of_tip.dry),
            grain: self.grain.unwrap_or(of_tip.grain),
            soft: self.soft.unwrap_or(of_tip.soft),
        }
    }

    /// Whether it draws one even ink, whatever the other keys say.
    pub fn is_pen(&self) -> bool {
        self.image.is_empty() && self.tip == Tip::Pen
    }
}

/// How a brush takes to paper whose image is a picture.
const OF_IMAGES: Manner = Manner {
    dry: 0.9,
    grain: 0.3,
    soft: 0.15,
};

style_table! {
/// The paper of the picture.
pub struct Paper {
    /// Size of its grain; default 2.2 at a height of 1080. 1.5 fine drawing paper, 4 rough watercolour paper, 8 canvas.
    pub size: Length = Length::ref_px(2.2),
}
}
