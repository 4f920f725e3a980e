//! The table `line.background` of a style: how lines adapt to what lies behind them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::Length;
use crate::overlay::{rule_table, style_table};
use npr_style::backdrop;

/// By which rule a line's colour minds the background.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum BackgroundMethod {
    /// By none: lines have their own colour everywhere.
    #[default]
    Off,
    /// As published: where surface and background are alike, the surface's colour times `intensity` [Tsuji 2014].
    Published,
    /// Lines that read keep their colour; others move in lightness until they do.
    Contrast,
}

/// Which way a line moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Direction {
    /// Whichever reaches the target; of both the smaller step. As published: brighter before dark backgrounds.
    #[default]
    Auto,
    /// Brighter alone.
    Brighter,
    /// Darker alone.
    Darker,
}

impl Direction {
    /// Its number in a [`backdrop::Rule`].
    pub fn number(self) -> u32 {
        match self {
            Self::Auto => backdrop::Rule::AUTO,
            Self::Brighter => backdrop::Rule::BRIGHTER,
            Self::Darker => backdrop::Rule::DARKER,
        }
    }
}

/// What contrast is measured in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Measure {
    /// Difference of OKLab lightness: even to the eye from dark to light.
    #[default]
    Lightness,
    /// Ratio of luminances of WCAG 2, as for text.
    Wcag,
}

/// Which lines mind the background.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum LineScope {
    /// Those between a subject and anything else.
    #[default]
    Outline,
    /// Those inside a subject too, each before the surface that it lies on.
    All,
}

/// What is one subject, where no rule names it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Subjects {
    /// All of the scene: only what lies behind all of it is background.
    #[default]
    Scene,
    /// Each node without a parent, with all that hangs on it.
    Root,
    /// Each object.
    Object,
}

/// What colour lines start from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum LineStart {
    /// Their own.
    #[default]
    Line,
    /// That of the surface beside them, as it is lit, times `factor`: outlines that never look put on.
    Rim,
}

style_table! {
/// How alike two colours must be.
pub struct Likeness;

/// What a rule changes about how alike two colours must be; what is absent stays.
pub struct RuleLikeness {
    /// Largest difference of any channel of RGB, 0..1; default 0.25. 1 takes the criterion out.
    #[schemars(range(min = 0.0, max = 1.0))]
    #[rule = "Largest difference of any channel of RGB, 0..1."]
    pub rgb: f32 = 0.25,
    /// Largest difference of V, the greatest channel, 0..1; default 1.
    #[schemars(range(min = 0.0, max = 1.0))]
    #[rule = "Largest difference of V, 0..1."]
    pub value: f32 = 1.0,
    /// Largest difference of saturation, 0..1; default 1.
    #[schemars(range(min = 0.0, max = 1.0))]
    #[rule = "Largest difference of saturation, 0..1."]
    pub saturation: f32 = 1.0,
    /// Largest difference of hue in degrees, 0..180; default 180.
    #[schemars(range(min = 0.0, max = 180.0))]
    #[rule = "Largest difference of hue in degrees, 0..180."]
    pub hue_deg: f32 = 180.0,
}
}

impl Likeness {
    /// The criteria of the published method; thresholds that nothing exceeds are left out.
    pub fn criteria(&self) -> backdrop::Criteria {
        let below = |threshold: f32, most: f32| (threshold < most).then_some(threshold);
        let some = backdrop::Criteria {
            rgb: below(self.rgb, 1.0),
            value: below(self.value, 1.0),
            saturation: below(self.saturation, 1.0),
            hue_deg: below(self.hue_deg, 180.0),
        };
        match some == backdrop::Criteria::default() {
            true => backdrop::Criteria {
                rgb: Some(1.0),
                ..some
            },
            false => some,
        }
    }
}

style_table! {
/// How lines mind what lies behind them.
///
/// A line is judged before what is really there, other subjects included; where nothing is, before a transparent
/// background, it keeps its colour. What counts as one subject, rules say by `subject`.
pub struct LineBackground {
    /// By which rule; default `off`.
    pub method: BackgroundMethod = BackgroundMethod::Off,
    /// Which way lines move; default `auto`.
    pub direction: Direction = Direction::Auto,
    /// What `contrast` is measured in; default `lightness`.
    pub measure: Measure = Measure::Lightness,
    /// For `contrast` by lightness: the difference that every line must have, 0..0.9; default 0.3. 0.15 a hint, 0.5
    /// loud.
    #[schemars(range(min = 0.0, max = 0.9))]
    pub lightness: f32 = 0.3,
    /// For `contrast` by `wcag`: the ratio that every line must have, 1..21; default 3, as for large text.
    #[schemars(range(min = 1.0, max = 21.0))]
    pub ratio: f32 = 3.0,
    /// For `contrast`: what colour lines start from; default `line`.
    pub start: LineStart = LineStart::Line,
    /// For `contrast` that starts from the `rim`: share of the surface's light, 0..1; default 0.7. 0.3 a deep shade,
    /// 0.9 nearly the surface.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub factor: f32 = 0.7,
    /// For `published`: what the surface's colour is multiplied or divided by, 1..20; default 2.
    #[schemars(range(min = 1.0, max = 20.0))]
    pub intensity: f32 = 2.0,
    /// For `published`: how alike surface and background must be in everything.
    pub likeness: Likeness = Likeness::default(),
    /// What is one subject; default `scene`. Where several characters stand together, `root` or `object` judge each
    /// before the others; rules name single ones by `subject`.
    pub subjects: Subjects = Subjects::Scene,
    /// Which lines follow the rule; default `outline`.
    pub scope: LineScope = LineScope::Outline,
    /// Length of outline over which colours are blended; default 8 of 1080 px, at most 24 px of the frame; which way
    /// lines turn is decided over 12 times that length. 0 for every pixel by itself; `published` always is.
    pub smooth: Length = Length::ref_px(8.0),
    /// For `contrast`: how much a stretch of outline that was brighter or darker in the frame before stays so, 0..2;
    /// default 1. 0 decides every frame anew, 1 turns a line only where it would not read any more. Frames too large
    /// for one piece are always drawn by themselves.
    #[schemars(range(min = 0.0, max = 2.0))]
    pub hold: f32 = 1.0,
    /// For `contrast`: frames in which a line that must turn fades from darker to brighter, 1..60; default 20. 1
    /// turns at once. After a cut, and in frames too large for one piece, lines do not fade.
    #[schemars(range(min = 1.0, max = 60.0))]
    pub fade: f32 = 20.0,
}
}

impl LineBackground {
    /// The rule as passes read it.
    pub fn rule(&self) -> backdrop::Rule {
        // Take the published rule as it is.
        let direction = self.direction.number();
        let within = u32::from(self.scope == LineScope::All);
        if self.method == BackgroundMethod::Published {
            let published = self.likeness.criteria().rule(self.intensity, direction);
            return backdrop::Rule {
                within,
                ..published
            };
        }

        // Set the contrast that lines must have, and the colour that they start from.
        let (measure, target) = match self.measure {
            Measure::Lightness => (backdrop::Rule::LIGHTNESS, self.lightness),
            Measure::Wcag => (backdrop::Rule::WCAG, self.ratio),
        };
        backdrop::Rule {
            method: match self.method {
                BackgroundMethod::Off => backdrop::Rule::OFF,
                _ => backdrop::Rule::BY_CONTRAST,
            },
            direction,
            measure,
            goal: target,
            rim_factor: match self.start {
                LineStart::Line => 0.0,
                LineStart::Rim => self.factor.max(1e-4),
            },
            within,
            ..backdrop::Rule::CONTRAST
        }
    }
}

rule_table! {
/// What a rule changes about how lines mind the background; what is absent stays.
pub struct RuleBackground over LineBackground {
    /// By which rule: hair may keep its line while clothes adapt.
    pub method: BackgroundMethod,
    /// Which way its lines move.
    pub direction: Direction,
    /// The difference of lightness that its lines must have, 0..0.9.
    #[schemars(range(min = 0.0, max = 0.9))]
    pub lightness: f32,
    /// The ratio that its lines must have, 1..21.
    #[schemars(range(min = 1.0, max = 21.0))]
    pub ratio: f32,
    /// What its contrast is measured in.
    pub measure: Measure,
    /// What colour its lines start from.
    pub start: LineStart,
    /// Share of its surface's light that lines start from, 0..1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub factor: f32,
    /// What its colour is multiplied or divided by, 1..20.
    #[schemars(range(min = 1.0, max = 20.0))]
    pub intensity: f32,
    /// Which of its lines follow the rule.
    pub scope: LineScope,
}
with {
    /// How alike it and what lies behind must be.
    pub likeness: RuleLikeness,
}
}
