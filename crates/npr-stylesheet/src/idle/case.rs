//! A key of a style, and all that decides whether it can act.

use crate::key::{lies_in, without_rule};
use crate::{BackgroundMethod, Look, OutlineMethod, Style, Tone, WidthSource};
use npr_core::line_source::LineSource;

/// Where a style is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Occasion {
    /// What is made.
    pub output: Output,
    /// What is drawn.
    pub scene: Facts,
}

/// What is made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Output {
    /// A picture of surfaces and lines.
    Frame,
    /// Lines as curves.
    Lines(LineOutput),
}

/// A drawing of lines as curves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LineOutput {
    /// How its lines are found.
    pub source: LineSource,
    /// What its file holds.
    pub form: LineForm,
    /// Whether surfaces are filled.
    pub fill: bool,
}

/// What a file of lines holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LineForm {
    /// Ink on paper.
    Ink,
    /// The middles of lines, for pen plotters.
    Centrelines,
    /// Points for programs: no paper and no words.
    Data,
}

/// What of the things that keys are about a scene has.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Facts {
    /// Surfaces or lines of its own.
    pub surfaces: bool,
    /// Smoke.
    pub smoke: bool,
    /// Textures that colour surfaces.
    pub textures: bool,
    /// Colours of vertices.
    pub vertex_colors: bool,
    /// Lights.
    pub lights: bool,
}

impl Facts {
    /// A scene that has everything.
    pub const ALL: Self = Self {
        surfaces: true,
        smoke: true,
        textures: true,
        vertex_colors: true,
        lights: true,
    };
}

/// A key, and all that decides whether it can act.
pub(super) struct Case<'a> {
    pub style: &'a Style,
    /// The key as the style itself has it, also where a rule says it.
    pub key: &'a str,
    /// Whether a rule says it.
    pub is_of_rule: bool,
    pub on: Occasion,
    /// The looks that parts which the key is about may have.
    pub looks: Vec<Look<'a>>,
}

impl<'a> Case<'a> {
    pub fn new(style: &'a Style, key: &'a str, occasion: &Occasion) -> Self {
        let inner = without_rule(key);
        Self {
            looks: looks(style, rule_of(key)),
            style,
            key: inner.unwrap_or(key),
            is_of_rule: inner.is_some(),
            on: *occasion,
        }
    }

    /// Whether any part may have such a look.
    pub fn any(&self, is_so: impl Fn(&Look<'_>) -> bool) -> bool {
        self.looks.iter().any(is_so)
    }

    /// The drawing of lines that is made, if one is.
    pub fn lines(&self) -> Option<LineOutput> {
        match self.on.output {
            Output::Frame => None,
            Output::Lines(lines) => Some(lines),
        }
    }

    pub fn is_frame(&self) -> bool {
        self.lines().is_none()
    }

    /// Whether it is a drawing of curves that come from there.
    pub fn is_found_by(&self, source: LineSource) -> bool {
        self.lines().is_some_and(|lines| lines.source == source)
    }

    /// Whether it is a drawing of curves whose file holds that.
    pub fn is_written_as(&self, form: LineForm) -> bool {
        self.lines().is_some_and(|lines| lines.form == form)
    }

    /// Whether a picture with tones is made, be it to judge lines before it.
    pub fn has_tones(&self) -> bool {
        self.is_frame() || self.style.contrasts_with_background()
    }

    /// Whether a drawing of curves fills smoke with tones.
    pub fn fills_smoke(&self) -> bool {
        self.on.scene.smoke && self.lines().is_some_and(|lines| lines.fill)
    }

    /// Whether smoke is drawn, be it its outlines alone.
    pub fn draws_smoke(&self) -> bool {
        let by_image = |lines: LineOutput| lines.source == LineSource::Image && !lines.fill;
        self.on.scene.smoke && !self.lines().is_some_and(by_image)
    }

    /// Whether the key is the colour of a light.
    pub fn is_color_of_light(&self) -> bool {
        self.key.ends_with(".color")
    }

    /// Whether the key says how letters are painted.
    pub fn is_paint_of_words(&self) -> bool {
        let of_entry = self.key.splitn(3, '.').nth(2).unwrap_or_default();
        let paints = ["color", "outline.width", "second_outline"];
        paints.iter().any(|name| lies_in(of_entry, name))
    }

    /// Whether lines of a frame may be drawn by one of these methods; always in drawings of curves.
    pub fn is_drawn_by(&self, methods: &[OutlineMethod]) -> bool {
        let by_one = |look: &Look<'_>| look.line_on && methods.contains(&look.line_method);
        !self.is_frame() || self.any(by_one)
    }

    /// Why the methods of a frame's lines do not use a key.
    pub fn methods_reason(&self) -> String {
        let mut names: Vec<String> = Vec::new();
        for look in self.looks.iter().filter(|look| look.line_on) {
            let name = method_name(look.line_method);
            if look.line_method != OutlineMethod::Off && !names.contains(&name) {
                names.push(name);
            }
        }
        match names.as_slice() {
            [] => "no lines are drawn".to_owned(),
            names => format!("lines of method {} do not use it", names.join(" or ")),
        }
    }

    /// Whether any part is drawn with strokes.
    pub fn hatches(&self) -> bool {
        self.any(|look| matches!(look.ink.tone, Tone::Hatch | Tone::InkHatch | Tone::Auto))
    }

    /// Whether any part minds what lies behind its lines, by one of these rules.
    pub fn contrasts_by(&self, methods: &[BackgroundMethod]) -> bool {
        self.any(|look| methods.contains(&look.line_background.method))
    }

    /// The bits of `Part::line_flags` that any part may have.
    pub fn paint_flags(&self) -> u32 {
        let flags = self.looks.iter().map(|look| look.line_paint.flags());
        flags.fold(0, |all, of_one| all | of_one)
    }

    /// Whether widths come from one of these sources.
    pub fn width_is_of(&self, sources: &[WidthSource]) -> bool {
        sources.contains(&self.style.line.width.source)
    }
}

/// The rule that a key belongs to.
fn rule_of(key: &str) -> Option<usize> {
    let (rule, _) = key.strip_prefix("rule.")?.split_once('.')?;
    rule.parse().ok()
}

/// The looks that parts may have: the style's own, with each rule, and with all; for a key of a rule those with it.
fn looks(style: &Style, of_rule: Option<usize>) -> Vec<Look<'_>> {
    let own = Look::plain(style);
    let own = match of_rule.and_then(|i| style.rule.get(i)) {
        Some(rule) => own.with(rule),
        None => own,
    };
    let all = style.rule.iter().fold(own.clone(), Look::with);
    let singly = style.rule.iter().map(|rule| own.clone().with(rule));
    let mut looks: Vec<Look<'_>> = singly.collect();
    looks.extend([own, all]);
    looks
}

/// A method as styles write it.
fn method_name(method: OutlineMethod) -> String {
    let value = toml::Value::try_from(method).ok();
    let name = value.as_ref().and_then(toml::Value::as_str);
    name.unwrap_or_default().to_owned()
}
