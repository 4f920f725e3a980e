//! The rules of a style: exceptions for single materials, objects and ids.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::ramp::Stop;
use crate::{
    CardLines, Color, OutlineMethod, RuleBackground, RuleBeam, RuleDash, RuleHand, RuleHighlight,
    RuleInk, RuleLineBrush, RuleMotion, RulePaint, RuleWidth, glob, id_map,
};

/// What a rule applies to: all patterns have to match.
///
/// `*` stands for any run of characters and `?` for one; letters match by case. `|` parts patterns of which one has to
/// match: `Hair*|Brow*`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Match {
    /// Pattern for the material's name; default `*`, any.
    pub material: String,
    /// Pattern for the object's name; default `*`, any.
    pub object: String,
    /// Pattern for the name of a region of an `id_map`, or its colour as `#rrggbb`; default `*`, any and none. `?*`
    /// takes all regions, and an empty text what belongs to none.
    pub id: String,
}

impl Default for Match {
    fn default() -> Self {
        Self {
            material: "*".to_owned(),
            object: "*".to_owned(),
            id: "*".to_owned(),
        }
    }
}

/// What a rule changes about lines; what is absent stays.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct RuleLine {
    /// Whether the part has lines at all. Off suits eyes, glass and ground planes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub on: Option<bool>,
    /// How the part's outline is drawn: `strokes`, `shape`, `hull`, `angle`, `potrace` or `none`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub method: Option<OutlineMethod>,
    /// How the part's cards are drawn: `outline`, `centre`, which suits grass and hair, or `tuft`, their outline alone.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cards: Option<CardLines>,
    /// Colour of the part's lines.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub color: Option<Color>,
    /// What else decides their colour.
    pub paint: RulePaint,
    /// What the part's line width is multiplied by, 0..10: 0.5 for faces, 1.5 for a hero.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0, max = 10.0))]
    pub width_factor: Option<f32>,
    /// The part's own angle for method `angle`, in degrees, 0..90.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0, max = 90.0))]
    pub angle_threshold_deg: Option<f32>,
    /// How its lines mind what lies behind them.
    pub background: RuleBackground,
    /// How their width changes along them.
    pub width: RuleWidth,
    /// What its strokes are drawn with.
    pub brush: RuleLineBrush,
    /// How a hand draws them.
    pub hand: RuleHand,
    /// How they are cut into dashes.
    pub dash: RuleDash,
}

/// What a rule changes about the fill; what is absent stays.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct RuleShade {
    /// Colour instead of the material's.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub color: Option<Color>,
    /// Tones instead of the style's, 1 to 8, sorted by `at`.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(length(min = 1, max = 8))]
    pub ramp: Option<Vec<Stop>>,
    /// A picture whose middle row gives its tones; empty for `ramp` after all. Stops beside it give way.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ramp_image: Option<String>,
}

impl RuleShade {
    /// The picture for tones of a part that had `image`: the rule's own where it states one, none where it states stops
    /// instead, and otherwise `image`.
    pub(crate) fn ramp_image_over<'a>(&'a self, image: &'a str) -> &'a str {
        let of_stops = self.ramp.as_ref().map(|_| "");
        self.ramp_image.as_deref().or(of_stops).unwrap_or(image)
    }
}

/// An exception for the parts that match; later rules win.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Rule {
    /// What the rule applies to.
    #[serde(rename = "match")]
    pub matching: Match,
    /// The subject that the part belongs to, whose outline minds the background; default what
    /// `line.background.subjects` says. Parts of one name are one subject; `background` is part of none, as suits
    /// ground and walls.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub subject: Option<String>,
    /// What changes about its lines.
    pub line: RuleLine,
    /// What changes about its fill.
    pub shade: RuleShade,
    /// What changes about its ink and hatching.
    pub ink: RuleInk,
    /// What changes about its highlights.
    pub highlight: RuleHighlight,
    /// Whether it moves, and leaves speed lines.
    pub motion: RuleMotion,
    /// Makes it a beam of light instead of a surface.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub beam: Option<RuleBeam>,
}

/// The names of a part, which rules match.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct PartNames<'a> {
    /// Its material's name.
    pub material: &'a str,
    /// Its object's name.
    pub object: &'a str,
    /// The names of its region of an id map, as [`IdRegion`](crate::IdRegion) has them; empty where it belongs to no
    /// region.
    pub ids: &'a [String],
}

impl Rule {
    /// Whether the rule applies to a part.
    pub fn applies_to(&self, part: PartNames<'_>) -> bool {
        glob::matches(&self.matching.material, part.material)
            && glob::matches(&self.matching.object, part.object)
            && id_map::matches(&self.matching.id, part.ids)
    }
}
