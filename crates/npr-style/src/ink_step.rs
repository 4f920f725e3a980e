//! Steps between tones: where ink ends at once, those of the ramp, and tones that were evened with both.

use crate::ramp::Level;
use npr_core::geometry::Part;

/// Hatch luminance at the middle of a stroke's half width: it stands for the hatch where there is none.
pub(crate) const NO_HATCH: f32 = 0.5;

/// Coordinate of the ramp where the ink of a part ends at once, as there is nothing but the light that decides: neither
/// strokes nor paint, and no face that the pen spares. [`Level::UNUSED`] if it does not.
pub(crate) fn ink_step(part: &Part) -> f32 {
    let all = Part::INK | Part::HATCH | Part::PAINTED | Part::SPARED;
    let level = 0.5 + 0.5 * (part.threshold - NO_HATCH);
    if part.flags & all != Part::INK || level <= 0.0 || level >= 1.0 {
        return Level::UNUSED;
    }
    part.light_at.min(part.dark_at) + level * (part.light_at - part.dark_at).max(0.0)
}

/// Steps of a part's ramp that light passes at coordinate `x`.
pub(crate) fn ramp_steps(part: &Part, x: f32) -> u32 {
    part.ramp[1..].iter().filter(|stop| stop[3] <= x).count() as u32
}

/// An evened tone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Evened {
    /// Light from the ramp.
    pub light: [f32; 3],
    /// Share of ink, 0..1, if light alone decides it.
    pub ink: Option<f32>,
}
