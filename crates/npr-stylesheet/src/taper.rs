//! How lines thin out towards their ends.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::Length;
use crate::overlay::style_table;

/// The ends at which lines thin out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum TaperEnds {
    /// Ends that meet no other line and are not cut off by the picture's border.
    #[default]
    Free,
    /// All ends, also where a line ends on another one or goes on as one of another kind.
    All,
}

style_table! {
/// How lines thin out towards their ends, as under a pen that is set down and lifted.
pub struct Taper;
/// What a rule changes about how lines thin out towards their ends; what is absent stays.
pub struct RuleTaper {
    /// Length over which a line swells from its start; default 0, none. 30 a quick nib, 150 a long brush stroke.
    #[rule = "Length over which a line swells from its start."]
    pub start: Length = Length::ref_px(0.0),
    /// Length over which a line thins out towards its end; default 0, none.
    #[rule = "Length over which a line thins out towards its end."]
    pub end: Length = Length::ref_px(0.0),
    /// Greatest share of a line that each of them takes, 0..0.5; default 0.5. 0.2 leaves short lines a full middle.
    #[schemars(range(min = 0.0, max = 0.5))]
    #[rule = "Greatest share of a line that each of them takes, 0..0.5."]
    pub share: f32 = 0.5,
    /// Share of the width that is left at the tip, 0..1; default 0, a point. 0.3 a blunt nib, 1 no taper.
    #[schemars(range(min = 0.0, max = 1.0))]
    #[rule = "Share of the width that is left at the tip, 0..1."]
    pub tip: f32 = 0.0,
    /// At which ends; default `free`.
    #[rule = "At which ends."]
    pub ends: TaperEnds = TaperEnds::Free,
}
}

impl Taper {
    /// Whether it asks for any taper.
    pub fn is_on(&self) -> bool {
        self.start.value > 0.0 || self.end.value > 0.0
    }
}
