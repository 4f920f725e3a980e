//! Exceptions for single materials, objects and ids.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::beam::{Beam, RuleBeam};
use crate::highlight::{Back, Edge, Highlight, HighlightModel, Streak};
use crate::ink::{Follow, Ink, Mapping, StrokeSpace, Tone};
use crate::ramp::Stop;
use crate::{
    Color, Length, LineBackground, LineMethod, LinePaint, RuleBackground, RuleMotion, RulePaint,
    Style, glob, id_map,
};
use crate::{Hatch, Pattern};

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

/// What a rule changes about ink and hatching; what is absent stays.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct RuleInk {
    /// What the shade is drawn with.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tone: Option<Tone>,
    /// Colour of ink and strokes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub color: Option<Color>,
    /// Place on the ramp, 0..1, up to which the shade ramp is black.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0, max = 1.0))]
    pub dark_at: Option<f32>,
    /// Place on the ramp, 0..1, from which it is white.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0, max = 1.0))]
    pub light_at: Option<f32>,
    /// How much its colour darkens its shade, 0..1.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0, max = 1.0))]
    pub paint: Option<f32>,
    /// What strokes are fixed to.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mapping: Option<Mapping>,
    /// What strokes on the surface run along; without a `direction` beside it the style's own gives way.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub follow: Option<Follow>,
    /// A direction that strokes on the surface follow.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(inner(inner(range(min = -1e9, max = 1e9))))]
    pub direction: Option<[f32; 3]>,
    /// What the direction is fixed to.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub direction_space: Option<StrokeSpace>,
    /// Its strokes.
    pub hatch: RuleHatch,
}

/// What a rule changes about strokes; what is absent stays.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct RuleHatch {
    /// What shadows are drawn with.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pattern: Option<Pattern>,
    /// A picture that shadows are drawn with; empty for `pattern` after all. A pattern beside it gives way.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub image: Option<String>,
    /// Distance between strokes or dots on screen.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spacing: Option<Length>,
    /// Length of a stroke in spacings, 1..200.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1.0, max = 200.0))]
    pub length: Option<f32>,
    /// Direction of strokes against that of the surface, in degrees, -180..180.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = -180.0, max = 180.0))]
    pub angle_deg: Option<f32>,
}

impl RuleHatch {
    /// `hatch` with what the rule states in place of what it had.
    fn over(&self, hatch: Hatch) -> Hatch {
        Hatch {
            pattern: self.pattern.unwrap_or(hatch.pattern),
            image: self.image.clone().unwrap_or(match self.pattern {
                Some(_) => String::new(),
                None => hatch.image,
            }),
            spacing: self.spacing.unwrap_or(hatch.spacing),
            length: self.length.unwrap_or(hatch.length),
            angle_deg: self.angle_deg.unwrap_or(hatch.angle_deg),
            ..hatch
        }
    }
}

impl RuleInk {
    /// `ink` with what the rule states in place of what it had.
    fn over(&self, ink: Ink) -> Ink {
        Ink {
            tone: self.tone.unwrap_or(ink.tone),
            color: self.color.unwrap_or(ink.color),
            dark_at: self.dark_at.unwrap_or(ink.dark_at),
            light_at: self.light_at.unwrap_or(ink.light_at),
            paint: self.paint.unwrap_or(ink.paint),
            mapping: self.mapping.unwrap_or(ink.mapping),
            follow: self.follow.unwrap_or(ink.follow),
            direction: self
                .direction
                .or(ink.direction.filter(|_| self.follow.is_none())),
            direction_space: self.direction_space.unwrap_or(ink.direction_space),
            hatch: self.hatch.over(ink.hatch),
            ..ink
        }
    }
}

/// What a rule changes about highlights; what is absent stays.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct RuleHighlight {
    /// How the spot ends: `none`, `crisp` or `soft`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub edge: Option<Edge>,
    /// What the spot is computed by.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub model: Option<HighlightModel>,
    /// Colour of spot and streak; alpha is the strength.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub color: Option<Color>,
    /// Sharpness of the spot, 1..1000.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1.0, max = 1000.0))]
    pub exponent: Option<f32>,
    /// Brightness from which the spot shows, 0..1.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0, max = 1.0))]
    pub threshold: Option<f32>,
    /// How fast a soft spot rises, 0..8.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0, max = 8.0))]
    pub gradient: Option<f32>,
    /// Moves the spot to the right and up, -1..1.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(inner(inner(range(min = -1.0, max = 1.0))))]
    pub shift: Option<[f32; 2]>,
    /// Turns the axes of its shape, in degrees, -180..180.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = -180.0, max = 180.0))]
    pub turn_deg: Option<f32>,
    /// Stretches the spot along its first axis, 0..1.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0, max = 1.0))]
    pub stretch: Option<f32>,
    /// Gaps along both axes that split the spot, 0..1.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(inner(inner(range(min = 0.0, max = 1.0))))]
    pub split: Option<[f32; 2]>,
    /// Makes the spot square, 0..1.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0, max = 1.0))]
    pub square: Option<f32>,
    /// Light from behind on its rims.
    pub back: RuleBack,
    /// Its straight streak.
    pub streak: RuleStreak,
}

/// What a rule changes about light from behind; what is absent stays.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct RuleBack {
    /// Whether there is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub on: Option<bool>,
    /// Colour of the rim; alpha is the strength.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub color: Option<Color>,
    /// Towards the light, in the camera's axes.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(inner(inner(range(min = -1e9, max = 1e9))))]
    pub direction: Option<[f32; 3]>,
    /// Place on its ramp, 0..1, where the rim begins.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0, max = 1.0))]
    pub from: Option<f32>,
    /// Place on its ramp, 0..1, where it is full.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0, max = 1.0))]
    pub to: Option<f32>,
}

impl RuleBack {
    /// `back` with what the rule states in place of what it had.
    fn over(&self, back: Back) -> Back {
        Back {
            on: self.on.unwrap_or(back.on),
            color: self.color.unwrap_or(back.color),
            direction: self.direction.unwrap_or(back.direction),
            from: self.from.unwrap_or(back.from),
            to: self.to.unwrap_or(back.to),
        }
    }
}

/// What a rule changes about a straight streak; what is absent stays.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct RuleStreak {
    /// Whether there is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub on: Option<bool>,
    /// Angle of the streak in the picture, in degrees, -180..180.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = -180.0, max = 180.0))]
    pub angle_deg: Option<f32>,
    /// How far from the middle of the model it lies, in radii, -2..2.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = -2.0, max = 2.0))]
    pub offset: Option<f32>,
    /// Width in radii of the model, 0..2.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0, max = 2.0))]
    pub width: Option<f32>,
    /// How squarely, 0..1, a surface must face the eye to show it.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0, max = 1.0))]
    pub facing: Option<f32>,
}

impl RuleStreak {
    /// `streak` with what the rule states in place of what it had.
    fn over(&self, streak: Streak) -> Streak {
        Streak {
            on: self.on.unwrap_or(streak.on),
            angle_deg: self.angle_deg.unwrap_or(streak.angle_deg),
            offset: self.offset.unwrap_or(streak.offset),
            width: self.width.unwrap_or(streak.width),
            facing: self.facing.unwrap_or(streak.facing),
        }
    }
}

impl RuleHighlight {
    /// Whether it gives parts a highlight that they may lack without it.
    pub fn may_show(&self) -> bool {
        let on = [self.back.on, self.streak.on].contains(&Some(true));
        on || self.edge.is_some_and(|edge| edge != Edge::Off)
    }

    /// `highlight` with what the rule states in place of what it had.
    fn over(&self, highlight: Highlight) -> Highlight {
        Highlight {
            edge: self.edge.unwrap_or(highlight.edge),
            model: self.model.unwrap_or(highlight.model),
            color: self.color.unwrap_or(highlight.color),
            exponent: self.exponent.unwrap_or(highlight.exponent),
            threshold: self.threshold.unwrap_or(highlight.threshold),
            gradient: self.gradient.unwrap_or(highlight.gradient),
            shift: self.shift.unwrap_or(highlight.shift),
            turn_deg: self.turn_deg.unwrap_or(highlight.turn_deg),
            stretch: self.stretch.unwrap_or(highlight.stretch),
            split: self.split.unwrap_or(highlight.split),
            square: self.square.unwrap_or(highlight.square),
            back: self.back.over(highlight.back),
            streak: self.streak.over(highlight.streak),
        }
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
                Some(beam) => Some(beam.over(self.beam)),
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
