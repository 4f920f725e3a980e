//! The manners in which a style draws the strokes of every part: how they are pressed, thin out, sway and are dashed.

use crate::part_info::PartInfo;
use npr_stylesheet::{Dash, Hand, Look, RuleLine, Style, Taper, WidthStop};
use npr_vector::stroke::Stroke;

/// How strokes are drawn, in lengths of the style.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct StrokeManner {
    /// Factors on the width along a stroke.
    pub pressure: Vec<WidthStop>,
    /// How ends thin out.
    pub taper: Taper,
    /// How a hand draws.
    pub hand: Hand,
    /// How lines are cut into dashes.
    pub dash: Dash,
}

/// The manners of a style, each once, and that of every part of a line model.
#[derive(Debug)]
pub(crate) struct StrokeManners {
    /// The manners; at least one, and the first is the style's own.
    pub all: Vec<StrokeManner>,
    /// The manner of every part; empty where all have the first.
    of_parts: Vec<u32>,
}

impl StrokeManner {
    fn of(look: Look<'_>) -> Self {
        Self {
            pressure: look.line_width.pressure,
            taper: look.line_width.taper,
            hand: look.line_hand,
            dash: look.line_dash,
        }
    }
}

impl StrokeManners {
    /// Those of the parts on which strokes are found. O(parts · rules) where a rule states a manner.
    pub fn new(parts: &[PartInfo], style: &Style) -> Self {
        // Most styles have one.
        let line = &style.line;
        let own = StrokeManner {
            pressure: line.width.pressure.clone(),
            taper: line.width.taper.clone(),
            hand: line.hand.clone(),
            dash: line.dash.clone(),
        };
        let mut all = vec![own];
        if !style.rule.iter().any(|rule| states_manner(&rule.line)) {
            let of_parts = Vec::new();
            return Self { all, of_parts };
        }

        // Keep each once.
        let of_parts = parts.iter().map(|info| {
            let manner = StrokeManner::of(info.look(style));
            let found = all.iter().position(|other| *other == manner);
            found.unwrap_or_else(|| {
                all.push(manner);
                all.len() - 1
            }) as u32
        });
        let of_parts = of_parts.collect();
        Self { all, of_parts }
    }

    /// The number of the manner in which a stroke is drawn.
    pub fn number_of(&self, stroke: &Stroke) -> u32 {
        let of_part = self.of_parts.get(stroke.surface as usize);
        of_part.copied().unwrap_or(0)
    }

    /// Whether any of them cuts lines into dashes.
    pub fn has_dashes(&self) -> bool {
        self.all
            .iter()
            .any(|manner| !manner.dash.pattern.is_empty())
    }

    /// Whether any of them lets lines end elsewhere than what they draw does.
    pub fn moves_ends(&self) -> bool {
        self.all.iter().any(|manner| manner.hand.moves_ends())
    }
}

/// Whether a rule states how strokes are drawn.
fn states_manner(line: &RuleLine) -> bool {
    let nothing = RuleLine::default();
    (&line.width, &line.hand, &line.dash) != (&nothing.width, &nothing.hand, &nothing.dash)
}
