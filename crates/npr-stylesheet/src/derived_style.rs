//! Styles derived from a style: without its lines, and the one that it is blended with.

use crate::{
    Blend, LineBackground, OutlineMethod, Rule, RuleBackground, RuleShade, Style, StyleError,
};

impl Style {
    /// The style without everything that is drawn over surfaces: no lines, trails or lettering, and no blend.
    pub fn without_lines(&self) -> Self {
        let mut style = Self {
            blend: Blend::default(),
            lettering: Vec::new(),
            ..self.clone()
        };
        style.line.method = OutlineMethod::Off;
        style.line.background = LineBackground::default();
        style.motion.follow = 0.0;
        style.motion.ghosts = 0;
        for rule in &mut style.rule {
            rule.line.method = None;
            rule.line.background = RuleBackground::default();
            rule.motion.trail = None;
            rule.motion.follow = None;
        }
        style
    }

    /// The style that this one is blended with: the preset `blend.with`, with the background, lights, antialiasing, id
    /// maps, beams and replaced colours of this style.
    ///
    /// # Errors
    ///
    /// [`StyleError::UnknownPreset`] where `blend.with` was changed by hand and names no preset.
    pub fn blended_with(&self) -> Result<Self, StyleError> {
        // Keep of each rule what the other style shares: replaced colours and beams.
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
