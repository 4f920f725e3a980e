//! Looks made of a look: without its lines, and the one that it is blended with.

use crate::{
    Blend, LineBackground, OutlineMethod, Rule, RuleBackground, RuleShade, Style, StyleError,
};

impl Style {
    /// The look of everything but what is drawn over it: no lines, trails, words, and no other look blended in.
    pub fn without_lines(&self) -> Self {
        let mut style = Self {
            blend: Blend::default(),
            lettering: Vec::new(),
            ..self.clone()
        };
        style.line.method = OutlineMethod::Off;
        style.line.background = LineBackground::default();
        for rule in &mut style.rule {
            rule.line.method = None;
            rule.line.background = RuleBackground::default();
            rule.motion.trail = None;
        }
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
