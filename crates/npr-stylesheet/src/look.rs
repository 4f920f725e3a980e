//! The look of single parts: the style, with every rule that applies laid over it.

use crate::overlay::Over;
use crate::{
    Beam, CardLines, Color, Dash, Hand, Highlight, Ink, LineBackground, LineBrush, LinePaint,
    OutlineMethod, PartNames, Rule, Stop, Style, Width,
};

/// The look of one part of the scene, with all rules applied.
#[derive(Debug, Clone, PartialEq)]
pub struct Look<'a> {
    /// Whether it has lines.
    pub line_on: bool,
    /// How its outline is drawn.
    pub line_method: OutlineMethod,
    /// How its cards are drawn.
    pub line_cards: CardLines,
    /// Colour of its lines.
    pub line_color: Color,
    /// The other settings that decide their colour.
    pub line_paint: LinePaint,
    /// Factor on the width of its lines.
    pub width_factor: f32,
    /// Its angle for method `angle`, in degrees off the silhouette.
    pub angle_threshold_deg: f32,
    /// How its lines adapt to what lies behind them.
    pub line_background: LineBackground,
    /// What its strokes are drawn with.
    pub line_brush: LineBrush,
    /// How wide they are; rules change how that changes along them.
    pub line_width: Width,
    /// How a hand draws them.
    pub line_hand: Hand,
    /// How they are cut into dashes.
    pub line_dash: Dash,
    /// The subject that it belongs to, where a rule names one.
    pub subject: Option<&'a str>,
    /// Colour in place of its material's, where a rule gives one.
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
    /// Vector in the scene from the part to where it came from, where a rule gives one.
    pub trail: Option<[f32; 3]>,
    /// How many shutters back its speed lines follow what really moves.
    pub follow: f32,
}

impl<'a> Look<'a> {
    /// The look of a part that no rule applies to.
    pub(crate) fn plain(style: &'a Style) -> Self {
        Self {
            line_on: true,
            line_method: style.line.method,
            line_cards: style.line.cards,
            line_color: style.line.color,
            line_paint: style.line.paint.clone(),
            width_factor: 1.0,
            angle_threshold_deg: style.line.angle_threshold_deg,
            line_background: style.line.background.clone(),
            line_brush: style.line.brush.clone(),
            line_width: style.line.width.clone(),
            line_hand: style.line.hand.clone(),
            line_dash: style.line.dash.clone(),
            subject: None,
            shade_color: None,
            ramp: &style.shade.ramp,
            ramp_image: &style.shade.ramp_image,
            ink: style.ink.clone(),
            highlight: style.highlight.clone(),
            beam: None,
            trail: None,
            follow: style.motion.follow,
        }
    }

    /// The look with the values that `rule` states in place of its own.
    pub(crate) fn with(self, rule: &'a Rule) -> Self {
        // Lay every table of the rule over what the part had.
        let (line, shade) = (&rule.line, &rule.shade);
        Self {
            line_on: line.on.unwrap_or(self.line_on),
            line_method: line.method.unwrap_or(self.line_method),
            line_cards: line.cards.unwrap_or(self.line_cards),
            line_color: line.color.unwrap_or(self.line_color),
            line_paint: line.paint.over(self.line_paint),
            width_factor: line.width_factor.unwrap_or(self.width_factor),
            angle_threshold_deg: line.angle_threshold_deg.unwrap_or(self.angle_threshold_deg),
            line_background: line.background.over(self.line_background),
            line_brush: line.brush.over(self.line_brush),
            line_width: line.width.over(self.line_width),
            line_hand: line.hand.over(self.line_hand),
            line_dash: line.dash.over(self.line_dash),
            subject: rule.subject.as_deref().or(self.subject),
            shade_color: shade.color.or(self.shade_color),
            ramp: shade.ramp.as_deref().unwrap_or(self.ramp),
            ramp_image: shade.ramp_image_over(self.ramp_image),
            ink: rule.ink.over(self.ink),
            highlight: rule.highlight.over(self.highlight),
            beam: match &rule.beam {
                Some(beam) => Some(beam.over(self.beam.unwrap_or_default())),
                None => self.beam,
            },
            trail: rule.motion.trail.or(self.trail),
            follow: rule.motion.follow.unwrap_or(self.follow),
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

    /// As [`Self::resolve`], for a part that belongs to no region of an id map.
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
    use crate::{Match, RuleLine};

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
