//! The whole style of a picture.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::overlay::Over;
use crate::{
    Antialias, Background, BackgroundMethod, Blend, CardLines, Detect, Highlight, IdMap, Ink,
    Lettering, Light, Line, LineSource, Motion, OutlineMethod, Paper, Parents, Rule, SceneHints,
    Shade, ShadeMode, SmokeStyle,
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
    /// The preset or style file whose strokes are drawn in place of those of the parents: its tables `line` and
    /// `paper`, and what its rules say about lines; default none. So several looks share one way of drawing lines.
    /// Empty once a style has been read.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub strokes: String,
    /// Whether materials of the scene that say how they are drawn, as MToon of VRM avatars does, are drawn so; default
    /// false. A list of `shade` and `outline` uses these alone. What the scene says goes before rules, and overrides go
    /// before the scene. Outlines are those of method `hull`.
    pub use_scene_hints: SceneHints,
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
    /// The paper that strokes are drawn on.
    pub paper: Paper,
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
            strokes: String::new(),
            use_scene_hints: SceneHints::default(),
            background: Background::default(),
            shade: Shade::default(),
            ink: Ink::default(),
            highlight: Highlight::default(),
            light: Light::default(),
            line: Line::default(),
            paper: Paper::default(),
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
    /// Whether any part may have its lines drawn as curves, which takes a line model of the scene.
    pub fn has_curves(&self) -> bool {
        self.curve_sources().next().is_some()
    }

    /// The same style with lines of method `strokes` drawn by `shape`, which needs no line model; `None` where there
    /// are no such lines.
    pub fn with_shapes_for_strokes(&self) -> Option<Self> {
        let mut style = self.clone();
        let of_rules = style.rule.iter_mut().flat_map(|rule| &mut rule.line.method);
        let mut has_strokes = false;
        for method in of_rules.chain([&mut style.line.method]) {
            if *method == OutlineMethod::Strokes {
                (*method, has_strokes) = (OutlineMethod::Shape, true);
            }
        }
        has_strokes.then_some(style)
    }

    /// Whether any part may be drawn as a tuft.
    pub fn has_tufts(&self) -> bool {
        let rules = self.rule.iter().filter_map(|rule| rule.line.cards);
        let mut all = rules.chain([self.line.cards]);
        all.any(|cards| cards == CardLines::Tuft)
    }

    /// Whether the textures of materials have a part in flat colour: not where the paper's colour stands for theirs.
    pub fn fills_with_textures(&self) -> bool {
        self.shade.use_textures && self.shade.mode != ShadeMode::Paper
    }

    /// The line sources of the parts whose lines may be drawn as curves, each once.
    pub fn curve_sources(&self) -> impl Iterator<Item = LineSource> {
        let rules = self.rule.iter().filter_map(|rule| rule.line.method);
        let methods = rules.chain([self.line.method]);
        LineSource::ALL.into_iter().filter(move |source| {
            let mut methods = methods.clone();
            methods.any(|method| method.source() == Some(*source))
        })
    }

    /// Whether the lines of any part may adapt to what lies behind them.
    pub fn contrasts_with_background(&self) -> bool {
        let rules = self.rule.iter().map(|rule| rule.line.background.method);
        let mut methods = rules.chain([Some(self.line.background.method)]).flatten();
        methods.any(|method| method != BackgroundMethod::Off)
    }

    /// The bits of [`Part::line_flags`](npr_core::geometry::Part::line_flags) that any part of a scene may have.
    pub fn line_paint_flags(&self) -> u32 {
        let rules = self.rule.iter();
        rules.fold(self.line.paint.flags(), |flags, rule| {
            flags | rule.line.paint.over(self.line.paint.clone()).flags()
        })
    }

    /// The different trails of parts that move, in the order of rules.
    pub fn trails(&self) -> Vec<[f32; 3]> {
        let mut trails: Vec<[f32; 3]> = Vec::new();
        for trail in self.rule.iter().filter_map(|rule| rule.motion.trail) {
            if trail != [0.0; 3] && !trails.contains(&trail) {
                trails.push(trail);
            }
        }
        trails
    }

    /// The most shutters that speed lines of any part follow what moves; 0 where none do.
    pub fn follow(&self) -> f32 {
        let of_rules = self.rule.iter().filter_map(|rule| rule.motion.follow);
        of_rules.fold(self.motion.follow, f32::max)
    }

    /// Whether lines go over a picture that follow what moves in it: speed lines or after-images.
    pub fn has_motion_lines(&self) -> bool {
        self.follow() > 0.0 || self.motion.ghosts > 0
    }

    /// Seconds before a picture at which it has to be known where everything was, in rising order; none where nothing
    /// follows motion.
    pub fn moments_s(&self) -> Vec<f32> {
        self.motion.moments_s(self.follow())
    }
}
