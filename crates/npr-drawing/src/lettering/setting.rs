//! How words are set: bent, leaning, growing, spaced.

/// Greatest `spread`: beyond, the first letters would all but vanish.
pub const SPREAD_MAX: f64 = 0.8;

/// How words are set; every value is clamped to its range, and 0 if it is not a number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Setting {
    /// How far the lines bend, -1..1: the part of half a turn that they span, up in the middle where positive,
    /// sagging where negative.
    ///
    /// Short words bend less than asked: the circle's centre stays a cap height away from the letters.
    pub bend: f64,
    /// How far letters lean to the right, as a share of their height, -1..1; 0.2 is an italic.
    pub slant: f64,
    /// How much letters grow from the first to the last, -0.8..0.8: from `1 - spread` to `1 + spread`.
    pub spread: f64,
    /// Free space added between letters, in cap heights, -0.5..2.
    pub spacing: f64,
    /// Distance from baseline to baseline in cap heights, 0.5..5. From 1 on it grows where letters of two lines would
    /// meet, as a p over a T does; below 1 they overlap.
    pub line_step: f64,
    /// Turn of the whole text, in radians, counter-clockwise in the picture.
    pub turn: f64,
}

impl Default for Setting {
    fn default() -> Self {
        Self {
            bend: 0.0,
            slant: 0.0,
            spread: 0.0,
            spacing: 0.0,
            line_step: 1.3,
            turn: 0.0,
        }
    }
}

impl Setting {
    /// The same with every value in its range.
    pub(super) fn within_bounds(self) -> Self {
        let bound = |value: f64, low: f64, high: f64| {
            let value = if value.is_nan() { 0.0 } else { value };
            value.clamp(low, high)
        };
        Self {
            bend: bound(self.bend, -1.0, 1.0),
            slant: bound(self.slant, -1.0, 1.0),
            spread: bound(self.spread, -SPREAD_MAX, SPREAD_MAX),
            spacing: bound(self.spacing, -0.5, 2.0),
            line_step: bound(self.line_step, 0.5, 5.0),
            turn: if self.turn.is_finite() {
                self.turn
            } else {
                0.0
            },
        }
    }
}
