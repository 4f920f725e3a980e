//! How a hand draws lines.

use crate::Length;
use crate::overlay::style_table;

style_table! {
/// How a hand draws lines: it sways, draws them more than once, and does not stop where they end.
pub struct Hand;
/// What a rule changes about how a hand draws lines; what is absent stays.
pub struct RuleHand {
    /// Greatest distance that a line sways from its place; default 0, a ruler. 2 a calm hand, 5 a loose one, 12 a
    /// child's. Short lines sway less, and lines that end on each other still do.
    #[rule = "Greatest distance that a line sways from its place; 0 a ruler."]
    pub wobble: Length = Length::ref_px(0.0),
    /// About how long its waves are; default 100. 30 a tremor, 300 a slow arm.
    #[rule = "About how long its waves are."]
    pub wave: Length = Length::ref_px(100.0),
    /// How often each line is drawn, 1..8; default 1. 2 a firm sketch, 4 a search for the line.
    #[schemars(range(min = 1, max = 8))]
    #[rule = "How often each line is drawn, 1..8."]
    pub copies: u32 = 1,
    /// Greatest distance of further copies from the line; default 2. 1 looks like one thick line, 8 like a loose
    /// sketch. They begin and end elsewhere by up to three times as much.
    #[rule = "Greatest distance of further copies from the line."]
    pub spread: Length = Length::ref_px(2.0),
    /// Length by which ends of lines run on straight, by half of it at least and a quarter of the line at most; default
    /// 0. 6 a quick pen, 40 construction lines. `split_angle_deg` gives ends at corners, too.
    #[rule = "Length by which ends of lines run on straight."]
    pub overshoot: Length = Length::ref_px(0.0),
    /// Length by which ends of lines stop short, by half of it at least and a third of the line at most; default 0. 4
    /// broken lines, 15 hints of them. With an overshoot too, chance decides for each end.
    #[rule = "Length by which ends of lines stop short."]
    pub undershoot: Length = Length::ref_px(0.0),
}
}

impl Hand {
    /// Whether ends of lines lie elsewhere than those of what they draw.
    pub fn moves_ends(&self) -> bool {
        self.overshoot.value > 0.0 || self.undershoot.value > 0.0
    }

    /// Whether lines are drawn otherwise than by a ruler.
    pub fn is_on(&self) -> bool {
        self.moves_ends() || self.wobble.value > 0.0 || self.copies > 1
    }
}
