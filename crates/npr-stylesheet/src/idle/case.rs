//! A key of a style, and everything that decides whether it has an effect.

use crate::key::{lies_in, without_rule};
use crate::{BackgroundMethod, Look, OutlineMethod, Style, TaperEnds, Tone, WidthSource};
use npr_core::line_source::LineSource;

/// The output and the scene that a style is used for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Occasion {
    /// The kind of output.
    pub output: Output,
    /// The facts about the scene.
    pub scene: Facts,
}

/// The kind of output.
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

/// The contents of a file of lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LineForm {
    /// Ink on paper, of one even pen.
    Ink,
    /// Ink on paper, with brushes.
    Stamps,
    /// The middles of lines, for pen plotters.
    Centrelines,
    /// Points for programs: no paper and no words.
    Data,
}

/// Whether a scene has the things that some keys depend on.
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
    /// Figures with the bone of a head.
    pub faces: bool,
    /// Materials that say how they are drawn as toons.
    pub toons: bool,
    /// Clips, which move it.
    pub clips: bool,
}

impl Facts {
    /// A scene that has everything.
    pub const ALL: Self = Self {
        surfaces: true,
        smoke: true,
        textures: true,
        vertex_colors: true,
        lights: true,
        faces: true,
        toons: true,
        clips: true,
    };
}

/// A key, and everything that decides whether it has an effect.
pub(super) struct Case<'a> {
    pub style: &'a Style,
    /// The key, without the prefix `rule.N.` where it is a key of a rule.
    pub key: &'a str,
    /// Whether it is a key of a rule.
    pub is_of_rule: bool,
    pub on: Occasion,
    /// The looks that the parts affected by the key may have.
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

    /// Whether speed lines follow what a clip moves.
    pub fn follows_motion(&self) -> bool {
        self.on.scene.clips && self.style.follow() > 0.0
    }

    /// Whether `is_so` holds for any of the looks.
    pub fn any(&self, is_so: impl Fn(&Look<'_>) -> bool) -> bool {
        self.looks.iter().any(is_so)
    }

    /// The drawing of lines, where the output is one.
    pub fn lines(&self) -> Option<LineOutput> {
        match self.on.output {
            Output::Frame => None,
            Output::Lines(lines) => Some(lines),
        }
    }

    pub fn is_frame(&self) -> bool {
        self.lines().is_none()
    }

    /// Whether the output is a drawing of lines that `source` finds.
    pub fn is_found_by(&self, source: LineSource) -> bool {
        self.lines().is_some_and(|lines| lines.source == source)
    }

    /// Whether lines are found on pixels alone.
    pub fn traces_pixels(&self) -> bool {
        match self.lines() {
            Some(lines) => lines.source.is_of_pixels(),
            None => !self.is_drawn_by(&[OutlineMethod::Strokes]),
        }
    }

    /// Whether the output is a drawing of lines in the form `form`.
    pub fn is_written_as(&self, form: LineForm) -> bool {
        self.lines().is_some_and(|lines| lines.form == form)
    }

    /// Whether a picture with tones is drawn, as the output or as the background that lines adapt to.
    pub fn has_tones(&self) -> bool {
        self.is_frame() || self.style.contrasts_with_background()
    }

    /// Whether the output is a drawing of lines that fills smoke with tones.
    pub fn fills_smoke(&self) -> bool {
        self.on.scene.smoke && self.lines().is_some_and(|lines| lines.fill)
    }

    /// Whether smoke is drawn, even if only its outlines are.
    pub fn draws_smoke(&self) -> bool {
        let by_image = |lines: LineOutput| lines.source == LineSource::Image && !lines.fill;
        self.on.scene.smoke && !self.lines().is_some_and(by_image)
    }

    /// Whether the key is the colour of a light.
    pub fn is_color_of_light(&self) -> bool {
        self.key.ends_with(".color")
    }

    /// Whether the key is about the colour or the outlines of letters.
    pub fn is_paint_of_words(&self) -> bool {
        let of_entry = self.key.splitn(3, '.').nth(2).unwrap_or_default();
        let paints = ["color", "outline.width", "second_outline"];
        paints.iter().any(|name| lies_in(of_entry, name))
    }

    /// Whether lines of a frame may be drawn by one of these methods. Always true for drawings of lines.
    pub fn is_drawn_by(&self, methods: &[OutlineMethod]) -> bool {
        let by_one = |look: &Look<'_>| look.line_on && methods.contains(&look.line_method);
        !self.is_frame() || self.any(by_one)
    }

    /// The reason for a key that the line methods of a frame do not use.
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

    /// Whether a stroke that is cut in two looks otherwise than one that is not.
    pub fn shows_cuts(&self) -> bool {
        let width = &self.style.line.width;
        let shows = |look: &Look<'_>| {
            let taper = &look.line_width.taper;
            let tapers = taper.is_on() && taper.ends == TaperEnds::All;
            tapers || look.line_hand.is_on() || look.line_dash.is_on()
        };
        width.short.value > 0.0 || self.any(shows)
    }

    /// Whether a stroke that is cut in two with its pen lifted between looks otherwise than one that is not.
    pub fn shows_lifts(&self) -> bool {
        self.shows_cuts() || self.any(|look| look.line_width.taper.is_on())
    }

    /// Whether any part may be hatched.
    pub fn hatches(&self) -> bool {
        self.any(|look| matches!(look.ink.tone, Tone::Hatch | Tone::InkHatch | Tone::Auto))
    }

    /// Whether strokes, or hatching of surfaces or of smoke, show the grain of the paper.
    pub fn minds_paper(&self) -> bool {
        let smoke = &self.style.smoke.ink;
        let strokes = self.is_drawn_by(&[OutlineMethod::Strokes, OutlineMethod::Potrace])
            && self.any(|look| {
                let brush = &look.line_brush;
                !brush.is_pen() && brush.manner().grain > 0.0
            });
        let hatching = self.hatches() && self.any(|look| look.ink.hatch.grain > 0.0);
        let tones = hatching || self.on.scene.smoke && smoke.hatch.grain > 0.0;
        strokes || self.has_tones() && tones
    }

    /// Whether the lines of any part may adapt to the background by one of these methods.
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

/// Index of the rule that a key belongs to; `None` for other keys.
fn rule_of(key: &str) -> Option<usize> {
    let (rule, _) = key.strip_prefix("rule.")?.split_once('.')?;
    rule.parse().ok()
}

/// The looks that parts may have: the style's own look, that look with each single rule, and with all rules. For a key
/// of the rule `of_rule`, all of them have that rule too.
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
