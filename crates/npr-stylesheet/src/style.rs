//! The whole description of a picture's look.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::error::{Problem, StyleError};
use crate::layers::{self, Parents};
use crate::ramp::{Stop, first_unsorted};
use crate::set::Assignment;
use crate::width::WidthSource;
use crate::{
    Antialias, Background, BackgroundMethod, Blend, Detect, Highlight, IdMap, Ink, Lettering,
    Light, Line, LineBackground, LineMethod, Motion, Rule, RuleBackground, Shade, SmokeStyle,
    preset, set,
};

/// What a picture should look like.
///
/// Every key has a default, so a style file states only what it changes. The defaults together are the
/// preset `toon`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Style {
    /// One line for lists; default empty.
    pub title: String,
    /// Version of the look, 1..1000000; default 1. Raised whenever its pictures change.
    #[schemars(range(min = 1, max = 1_000_000))]
    pub version: u32,
    /// Presets or other style files to start from, the last one strongest; default none.
    /// Empty once a style has been read.
    #[serde(skip_serializing_if = "Parents::is_empty")]
    pub extends: Parents,
    /// What shows where no surface is: a colour, `transparent` or an image; default white.
    pub background: Background,
    /// How surfaces are filled.
    pub shade: Shade,
    /// What is drawn over the fill with the pen.
    pub ink: Ink,
    /// Which highlights surfaces have.
    pub highlight: Highlight,
    /// The lights that tones are drawn by.
    pub light: Light,
    /// Which lines are drawn, and with what.
    pub line: Line,
    /// How the line mask is found.
    pub detect: Detect,
    /// How smoke looks, where the scene has any.
    pub smoke: SmokeStyle,
    /// How edges are smoothed.
    pub antialias: Antialias,
    /// How speed lines behind parts that move are drawn; rules say which move.
    pub motion: Motion,
    /// How much of the look is drawn, over another one.
    pub blend: Blend,
    /// Pictures that tell regions of surfaces apart, for rules, up to 64; where several lie on one part, the last
    /// counts.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[schemars(length(max = 64))]
    pub id_map: Vec<IdMap>,
    /// Exceptions for single materials, objects and ids; later ones win.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub rule: Vec<Rule>,
    /// Words over the picture, up to 64, the last on top; default none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[schemars(length(max = 64))]
    pub lettering: Vec<Lettering>,
}

impl Default for Style {
    fn default() -> Self {
        Self {
            title: String::new(),
            version: 1,
            extends: Parents::default(),
            background: Background::default(),
            shade: Shade::default(),
            ink: Ink::default(),
            highlight: Highlight::default(),
            light: Light::default(),
            line: Line::default(),
            detect: Detect::default(),
            smoke: SmokeStyle::default(),
            antialias: Antialias::default(),
            motion: Motion::default(),
            blend: Blend::default(),
            id_map: Vec::new(),
            rule: Vec::new(),
            lettering: Vec::new(),
        }
    }
}

impl Style {
    /// Reads a style file of at most 1 MiB.
    ///
    /// Its parents in `extends` are laid below it: presets by name, anything else through `load`, which
    /// is given the parent as named and answers with its text or with why there is none. Tables merge key
    /// by key, `rule` and `id_map` blocks add up, and any other value of the file replaces its parents'.
    ///
    /// # Errors
    ///
    /// [`StyleError`] for the first fault, with line and column where it stands in `text` itself.
    pub fn from_toml(
        text: &str,
        load: &dyn Fn(&str) -> Result<String, String>,
    ) -> Result<Self, StyleError> {
        Ok(layers::read(text, load)?.style)
    }

    /// The preset called `name`, or `name@version`.
    ///
    /// # Errors
    ///
    /// [`StyleError::UnknownPreset`] or [`StyleError::PresetVersion`].
    pub fn preset(name: &str) -> Result<Self, StyleError> {
        let found = preset::find(name)?;
        Self::from_toml(found.text, &|parent| {
            Err(format!(
                "preset '{}' extends no file '{parent}'",
                found.name
            ))
        })
    }

    /// Overrides one value by `key.path=value`, such as `line.width.base=5px`.
    ///
    /// The value is TOML; text needs no quotes. Entries of lists are counted from 0: `rule.0.line.on=false`.
    /// What rules say about the same key gives way, so that an override always shows.
    ///
    /// # Errors
    ///
    /// [`StyleError`] for an unknown key or a value that does not fit; the style is unchanged then.
    pub fn set(&mut self, assignment: &str) -> Result<(), StyleError> {
        *self = set::assign(self, &[Assignment::of(assignment)?])?;
        Ok(())
    }

    /// The style as TOML with every value spelled out; reading it gives the same style.
    ///
    /// # Errors
    ///
    /// [`StyleError::Syntax`] if a value has no TOML form, which no style that was read has.
    pub fn to_toml(&self) -> Result<String, StyleError> {
        toml::to_string(self).map_err(|error| StyleError::Syntax {
            place: None,
            message: error.to_string(),
        })
    }

    /// Whether any part may have its lines drawn as curves, which takes a line model of the scene.
    pub fn has_curves(&self) -> bool {
        self.has_method(LineMethod::Curves) || self.has_method(LineMethod::Potrace)
    }

    /// Whether any part may have its lines drawn by a method.
    pub fn has_method(&self, method: LineMethod) -> bool {
        let mut rules = self.rule.iter().filter_map(|rule| rule.line.method);
        self.line.method == method || rules.any(|of_rule| of_rule == method)
    }

    /// Whether the lines of any part may mind what lies behind them.
    pub fn contrasts_with_background(&self) -> bool {
        let rules = self.rule.iter().map(|rule| rule.line.background.method);
        let mut methods = rules.chain([Some(self.line.background.method)]).flatten();
        methods.any(|method| method != BackgroundMethod::Off)
    }

    /// The look of everything but what is drawn over it: no lines, trails, words, and no other look blended in.
    pub fn without_lines(&self) -> Self {
        let mut style = Self {
            blend: Blend::default(),
            lettering: Vec::new(),
            ..self.clone()
        };
        style.line.method = LineMethod::Off;
        style.line.background = LineBackground::default();
        for rule in &mut style.rule {
            rule.line.method = None;
            rule.line.background = RuleBackground::default();
            rule.motion.trail = None;
        }
        style
    }

    /// Checks what no single value shows: order, contradictions, missing companions.
    ///
    /// Reading does this already; call it after changing fields by hand.
    ///
    /// # Errors
    ///
    /// [`StyleError::Value`] for the first key that contradicts another.
    pub fn sanity_check(&self) -> Result<(), StyleError> {
        self.light.sanity_check()?;
        self.blend.sanity_check()?;
        self.check_trails()?;
        self.check_ids()?;
        check_direction(self.ink.direction, "ink.direction")?;
        check_width(&self.line.width)?;
        self.check_line_paint()?;
        check_ramp(&self.shade.ramp, "shade.ramp")?;
        self.smoke.sanity_check()?;
        let mut words = self.lettering.iter().enumerate();
        words.try_for_each(|(i, words)| words.check(i))?;
        self.rule.iter().enumerate().try_for_each(|(i, rule)| {
            check_method(rule.line.method, i)?;
            check_direction(rule.ink.direction, &format!("rule.{i}.ink.direction"))?;
            let ramp = rule.shade.ramp.as_deref();
            ramp.map_or(Ok(()), |stops| {
                check_ramp(stops, &format!("rule.{i}.shade.ramp"))
            })
        })
    }
}

fn check_ramp(stops: &[Stop], key: &str) -> Result<(), StyleError> {
    match first_unsorted(stops) {
        Some(i) => Err(StyleError::unfit(
            format!("{key}.{i}.at"),
            "lies before the stop ahead of it",
        )),
        None => Ok(()),
    }
}

/// Strokes cannot follow a direction of no length.
fn check_direction(direction: Option<[f32; 3]>, key: &str) -> Result<(), StyleError> {
    match direction {
        Some([0.0, 0.0, 0.0]) => Err(StyleError::unfit(key, "points nowhere")),
        _ => Ok(()),
    }
}

/// A part cannot have a method that works on whole pictures.
fn check_method(method: Option<LineMethod>, rule: usize) -> Result<(), StyleError> {
    match method {
        None
        | Some(
            LineMethod::Off
            | LineMethod::Shape
            | LineMethod::Hull
            | LineMethod::Angle
            | LineMethod::Curves
            | LineMethod::Potrace,
        ) => Ok(()),
        Some(_) => Err(StyleError::unfit(
            format!("rule.{rule}.line.method"),
            "works on whole pictures; a part may have shape, hull, angle, curves, potrace or none",
        )),
    }
}

fn check_width(width: &crate::Width) -> Result<(), StyleError> {
    if width.min > width.max {
        let (value, max) = (f64::from(width.min), f64::from(width.max));
        return Err(StyleError::value(
            "line.width.min",
            Problem::OutOfRange {
                value,
                min: 0.0,
                max,
            },
        ));
    }
    match width.source {
        WidthSource::Texture if width.texture.is_none() => Err(StyleError::unfit(
            "line.width.source",
            "is texture, but line.width.texture names no image",
        )),
        WidthSource::ControlPoints if width.control_points.is_empty() => Err(StyleError::unfit(
            "line.width.source",
            "is control-points, but line.width.control_points is empty",
        )),
        _ => Ok(()),
    }
}
