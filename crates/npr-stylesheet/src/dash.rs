//! How lines are cut into dashes.

use crate::Length;
use crate::overlay::style_table;

style_table! {
/// How lines are cut into dashes and dots.
pub struct Dash;
/// What a rule changes about how lines are cut into dashes; what is absent stays.
pub struct RuleDash {
    /// Lengths of ink, gap, ink, gap and so on, at most 8; default none, whole lines. [12, 8] dashes, [0, 8] dots,
    /// [20, 6, 0, 6] both. Round ends make ink longer by the line's width, and gaps shorter. Of an odd number of
    /// lengths ink and gap change places every time. Lines shorter than the pattern stay whole.
    #[schemars(length(max = 8))]
    #[rule = "Lengths of ink, gap, ink, gap and so on, at most 8; [] for whole lines after all."]
    pub pattern: Vec<Length> = Vec::new(),
    /// Whether the pattern is stretched so that lines begin and end with half a dash, and meet at corners; default
    /// true. False keeps its lengths, and breaks off where lines end.
    #[rule = "Whether the pattern is stretched so that lines begin and end with half a dash."]
    pub fit: bool = true,
}
}

impl Dash {
    /// Whether it asks for gaps.
    pub fn is_on(&self) -> bool {
        let gaps = self.pattern.iter().skip(1).step_by(2);
        let lengths = self.pattern.iter().filter(|length| length.value > 0.0);
        match self.pattern.len() % 2 {
            0 => gaps.filter(|gap| gap.value > 0.0).count() > 0,
            _ => lengths.count() > 0,
        }
    }
}
