//! Exceptions for single materials, objects and ids.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::beam::{Beam, RuleBeam};
use crate::highlight::{Highlight, RuleHighlight};
use crate::ink::{Ink, RuleInk};
use crate::overlay::Over;
use crate::ramp::Stop;
use crate::{
    Color, LineBackground, LineMethod, LinePaint, RuleBackground, RuleMotion, RulePaint, Style,
    glob, id_map,
};

/// What a rule applies to: all patterns have to match.
///
/// `*` stands for any run of characters and `?` for one; letters match by case.
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
    /// How the part's outline is drawn: `shape`, `hull`, `angle`, `curves`, `potrace` or `none`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub method: Option<LineMethod>,
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
    /// The picture for tones with what the rule states in place of what it had: stops of its own leave none.
    fn ramp_image_over<'a>(&'a self, image: &'a str) -> &'a str {
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

/// What a part is called, for rules.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct PartNames<'a> {
    /// Its material's name.
    pub material: &'a str,
    /// Its object's name.
    pub object: &'a str,
    /// The names of its region of an id map, as [`IdRegion`](crate::IdRegion) has them; none where it belongs to none.
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

/// How one part of the scene looks once every rule has spoken.
#[derive(Debug, Clone, PartialEq)]
pub struct Look<'a> {
    /// Whether it has lines.
    pub line_on: bool,
    /// How its outline is drawn.
    pub line_method: LineMethod,
    /// Colour of its lines.
    pub line_color: Color,
    /// What else decides their colour.
    pub line_paint: LinePaint,
    /// What its line width is multiplied by.
    pub width_factor: f32,
    /// Its angle for method `angle`, in degrees off the silhouette.
    pub angle_threshold_deg: f32,
    /// How its lines mind what lies behind them.
    pub line_background: LineBackground,
    /// The subject that it belongs to, where a rule names one.
    pub subject: Option<&'a str>,
    /// Colour instead of its material's.
    pub shade_color: Option<Color>,
    /// Its tones, sorted.
    pub ramp: &'a [Stop],
    /// The picture that gives its tones instead; empty where none does.
    pub ramp_image: &'a str,
    /// Its ink and hatching.
    pub ink: Ink,
    /// Its highlights.
    pub highlight: Highlight,
    /// How it glows, where it is a beam.
    pub beam: Option<Beam>,
    /// From it to where it came from, in the scene, where a rule says so.
    pub trail: Option<[f32; 3]>,
}

impl<'a> Look<'a> {
    /// The look of a part that no rule applies to.
    pub(crate) fn plain(style: &'a Style) -> Self {
        Self {
            line_on: true,
            line_method: style.line.method,
            line_color: style.line.color,
            line_paint: style.line.paint.clone(),
            width_factor: 1.0,
            angle_threshold_deg: style.line.angle_threshold_deg,
            line_background: style.line.background.clone(),
            subject: None,
            shade_color: None,
            ramp: &style.shade.ramp,
            ramp_image: &style.shade.ramp_image,
            ink: style.ink.clone(),
            highlight: style.highlight.clone(),
            beam: None,
            trail: None,
        }
    }

    /// The look with what `rule` states in place of what it had.
    pub(crate) fn with(self, rule: &'a Rule) -> Self {
        let (line, shade) = (&rule.line, &rule.shade);
        Self {
            line_on: line.on.unwrap_or(self.line_on),
            line_method: line.method.unwrap_or(self.line_method),
            line_color: line.color.unwrap_or(self.line_color),
            line_paint: line.paint.over(self.line_paint),
            width_factor: line.width_factor.unwrap_or(self.width_factor),
            angle_threshold_deg: line.angle_threshold_deg.unwrap_or(self.angle_threshold_deg),
            line_background: line.background.over(self.line_background),
            subject: rule.subject.as_deref().or(self.subject),
            shade_color: shade.color.or(self.shade_color),
            ramp: shade.ramp.as_deref().unwrap_or(self.ramp),
            ramp_image: shade.ramp_image_over(self.ramp_image),
            ink: rule.ink.over(self.ink),
            highlight: rule.highlight.over(self.highlight),
            beam: match &rule.beam {
                Some(beam) => Some(beam.over(self.beam.unwrap_or_default())),
                None => self.beam,
            },
            trail: rule.motion.trail.or(self.trail),
        }
    }
}

impl Style {
    /// How a part looks: the style's own values, then every rule that applies, in order.
    pub fn resolve(&self, part: PartNames<'_>) -> Look<'_> {
        self.rule
            .iter()
            .filter(|rule| rule.applies_to(part))
            .fold(Look::plain(self), Look::with)
    }

    /// The same for a part that belongs to no region of an id map.
    pub fn resolve_for(&self, material: &str, object: &str) -> Look<'_> {
        let ids = &[];
        self.resolve(PartNames {
            material,
            object,
            ids,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rule(material: &str, object: &str, line: RuleLine) -> Rule {
        let matching = Match {
            material: material.to_owned(),
            object: object.to_owned(),
            ..Match::default()
        };
        Rule {
            matching,
            line,
            ..Rule::default()
        }
    }

    #[test]
    fn later_rules_win_and_leave_the_rest() {
        let red = RuleLine {
            color: Some(Color::rgb(255, 0, 0)),
            width_factor: Some(2.0),
            ..RuleLine::default()
        };
        let thin = RuleLine {
            width_factor: Some(0.5),
            ..RuleLine::default()
        };
        let style = Style {
            rule: vec![rule("Skin*", "*", red), rule("*", "Head", thin)],
            ..Style::default()
        };

        let face = style.resolve_for("Skin_face", "Head");
        assert_eq!(
            (face.line_color, face.width_factor),
            (Color::rgb(255, 0, 0), 0.5)
        );
        assert_eq!(style.resolve_for("Skin_arm", "Arm").width_factor, 2.0);
        assert_eq!(style.resolve_for("Cloth", "Arm"), Look::plain(&style));
    }
}
