//! Exceptions for single materials and objects.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::ramp::Stop;
use crate::{Color, Style, glob};

/// What a rule applies to: both patterns have to match.
///
/// `*` stands for any run of characters and `?` for one; letters match by case.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Match {
    /// Pattern for the material's name; default `*`, any.
    pub material: String,
    /// Pattern for the object's name; default `*`, any.
    pub object: String,
}

impl Default for Match {
    fn default() -> Self {
        Self {
            material: "*".to_owned(),
            object: "*".to_owned(),
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
    /// Colour of the part's lines.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub color: Option<Color>,
    /// What the part's line width is multiplied by, 0..10: 0.5 for faces, 1.5 for a hero.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0, max = 10.0))]
    pub width_factor: Option<f32>,
    /// The part's own angle for method `angle`, in degrees, 0..90.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0, max = 90.0))]
    pub angle_threshold_deg: Option<f32>,
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
}

/// An exception for the parts that match; later rules win.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Rule {
    /// What the rule applies to.
    #[serde(rename = "match")]
    pub matching: Match,
    /// What changes about its lines.
    pub line: RuleLine,
    /// What changes about its fill.
    pub shade: RuleShade,
}

impl Rule {
    /// Whether the rule applies to a part.
    pub fn applies_to(&self, material: &str, object: &str) -> bool {
        glob::matches(&self.matching.material, material)
            && glob::matches(&self.matching.object, object)
    }
}

/// How one part of the scene looks once every rule has spoken.
#[derive(Debug, Clone, PartialEq)]
pub struct Look<'a> {
    /// Whether it has lines.
    pub line_on: bool,
    /// Colour of its lines.
    pub line_color: Color,
    /// What its line width is multiplied by.
    pub width_factor: f32,
    /// Its angle for method `angle`, in degrees off the silhouette.
    pub angle_threshold_deg: f32,
    /// Colour instead of its material's.
    pub shade_color: Option<Color>,
    /// Its tones, sorted.
    pub ramp: &'a [Stop],
}

impl<'a> Look<'a> {
    /// The look of a part that no rule applies to.
    fn plain(style: &'a Style) -> Self {
        Self {
            line_on: true,
            line_color: style.line.color,
            width_factor: 1.0,
            angle_threshold_deg: style.line.angle_threshold_deg,
            shade_color: None,
            ramp: &style.shade.ramp,
        }
    }

    /// The look with what `rule` states in place of what it had.
    fn with(self, rule: &'a Rule) -> Self {
        let (line, shade) = (&rule.line, &rule.shade);
        Self {
            line_on: line.on.unwrap_or(self.line_on),
            line_color: line.color.unwrap_or(self.line_color),
            width_factor: line.width_factor.unwrap_or(self.width_factor),
            angle_threshold_deg: line.angle_threshold_deg.unwrap_or(self.angle_threshold_deg),
            shade_color: shade.color.or(self.shade_color),
            ramp: shade.ramp.as_deref().unwrap_or(self.ramp),
        }
    }
}

impl Style {
    /// How a part with these names looks: the style's own values, then every rule that applies, in order.
    pub fn resolve_for(&self, material: &str, object: &str) -> Look<'_> {
        self.rule
            .iter()
            .filter(|rule| rule.applies_to(material, object))
            .fold(Look::plain(self), Look::with)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rule(material: &str, object: &str, line: RuleLine) -> Rule {
        let matching = Match {
            material: material.to_owned(),
            object: object.to_owned(),
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
