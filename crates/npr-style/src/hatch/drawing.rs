//! One drawing: how many strokes a tile holds, and how the hand that made them moves.

use super::{Hatch, Pattern};
use npr_core::math;

/// Texels of a level between neighbouring strokes of its first drawing.
///
/// Few, so that a tile holds many strokes before it repeats; distances survive the blend between texels.
pub const SPACING_TEXELS: u32 = 8;

/// Drawings from one level to the next.
pub const STEPS: u32 = 3;

/// One drawing of a tile as seen from one of its levels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drawing {
    /// Texels per side of the level.
    pub side: u32,
    /// Drawings since the level's first, 0..=[`STEPS`].
    pub step: u32,
}

impl Drawing {
    /// Octaves since the level's first drawing, 0..1.
    pub fn octave(self) -> f32 {
        self.step as f32 / STEPS as f32
    }

    /// Factor on the strokes per side against the level's first drawing, 0.5..1.
    pub fn thinning(self) -> f32 {
        math::powf(0.5, self.octave())
    }

    /// Strokes side by side in the level's first drawing, a power of two.
    pub fn tracks(self) -> u32 {
        self.side / SPACING_TEXELS
    }

    /// Spacings of this drawing along a side of the tile.
    pub fn side_spacings(self) -> f32 {
        self.tracks() as f32 * self.thinning()
    }
}

/// The settings of a pattern as the hand that draws it uses them, each within its range.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hand {
    /// Length of a stroke in spacings.
    pub length: f32,
    /// How far strokes stray; 1 is the worst of a steady hand.
    pub wobble: f32,
    /// Length of the tips as a part of the stroke, 0..1.
    pub taper: f32,
    /// How much pressure varies, 0..1.
    pub variation: f32,
    /// How much the paper's grain shows, 0..1.
    pub grain: f32,
}

impl Hand {
    /// The hand of `hatch`; NaN becomes the least value of its range.
    pub fn of(hatch: &Hatch) -> Self {
        let within = |x: f32, low: f32, high: f32| x.max(low).min(high);
        let plain = Self {
            length: within(hatch.length, 1.0, 200.0),
            wobble: within(hatch.wobble, 0.0, 1.0),
            taper: within(hatch.taper, 0.0, 1.0),
            variation: within(hatch.variation, 0.0, 1.0),
            grain: 0.0,
        };
        match hatch.pattern {
            Pattern::Pencil => Self {
                wobble: 1.6 * plain.wobble,
                grain: 0.55,
                ..plain
            },
            Pattern::Brush => Self {
                length: 1.75 * plain.length,
                taper: plain.taper.max(0.85),
                variation: (2.0 * plain.variation).min(1.0),
                ..plain
            },
            _ => plain,
        }
    }
}
