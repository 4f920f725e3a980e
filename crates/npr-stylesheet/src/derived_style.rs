//! Looks made of a look: without its lines, with nothing but what moves, and the one that it is blended with.

use crate::motion::color_of_trail;
use crate::{
    Background, BeamStop, Blend, Color, Highlight, Ink, LineBackground, LineMethod, Rule,
    RuleBackground, RuleBeam, RuleShade, ShadeMode, Stop, Style, StyleError,
};

impl Style {
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

    /// A look in which nothing but what moves is seen: [`trail_of`](crate::motion::trail_of) reads it.
    pub fn of_motion(&self) -> Self {
        // Paint every part that stands still black.
        let trails = self.trails();
        let clear = BeamStop {
            at: 0.0,
            color: Color::rgba(0, 0, 0, 0),
        };
        let still = Rule {
            shade: RuleShade {
                color: Some(Color::rgb(0, 0, 0)),
                ..RuleShade::default()
            },
            ..Rule::default()
        };

        // Paint every part that moves in the red of its trail, and make beams transparent.
        let own = |rule: &Rule| {
            let code = rule
                .motion
                .trail
                .map(|trail| color_of_trail(trails.iter().position(|other| *other == trail)));
            Rule {
                matching: rule.matching.clone(),
                shade: RuleShade {
                    color: code,
                    ..RuleShade::default()
                },
                beam: rule.beam.as_ref().map(|_| RuleBeam {
                    ramp: Some(vec![clear.clone()]),
                    ..RuleBeam::default()
                }),
                ..Rule::default()
            }
        };

        // Leave nothing else to be seen: no light, no lines, no blended edges.
        let mut style = Self {
            background: Background::Color(Color::rgb(0, 0, 0)),
            ink: Ink::default(),
            highlight: Highlight::default(),
            rule: std::iter::once(still)
                .chain(self.rule.iter().map(own))
                .collect(),
            ..Self::default()
        };
        style.shade.mode = ShadeMode::Flat;
        style.shade.use_textures = false;
        style.shade.use_vertex_colors = false;
        style.shade.ramp = vec![Stop::plain(0.0, 1.0)];
        style.line.method = LineMethod::Off;
        style.antialias.samples = 1;
        style
    }

    /// The look that this one is blended with: its preset, on the background, under the lights and with the beams and
    /// painted-over colours of this one.
    ///
    /// # Errors
    ///
    /// [`StyleError::UnknownPreset`] where `blend.with` was changed by hand to what is none.
    pub fn blended_with(&self) -> Result<Self, StyleError> {
        // Keep of the rules what the other look shares: painted-over colours and beams.
        let other = Self::preset(&self.blend.with)?;
        let own = |rule: &Rule| Rule {
            matching: rule.matching.clone(),
            shade: RuleShade {
                color: rule.shade.color,
                ..RuleShade::default()
            },
            beam: rule.beam.clone(),
            ..Rule::default()
        };

        // Lay them over the rules of the preset, on the same background and under the same lights.
        Ok(Self {
            background: self.background.clone(),
            light: self.light.clone(),
            antialias: self.antialias.clone(),
            id_map: self.id_map.clone(),
            rule: other
                .rule
                .iter()
                .cloned()
                .chain(self.rule.iter().map(own))
                .collect(),
            blend: Blend::default(),
            lettering: Vec::new(),
            ..other
        })
    }
}
