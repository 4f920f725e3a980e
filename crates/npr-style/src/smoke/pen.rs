//! The last step of smoke: its tones, and its ink and hatching. The twin of `lib/smoke_pen`.
//!
//! If a pen or the tones of a picture finish the smoke, the smoke passes draw [`TONES`] instead of colours: red and
//! green hold the tone, blue how much the outline leaves open: sRGB bytes tell small shares apart best, and little
//! light beside dark ink shows most. So they need no ramps, tiles and pens, which the last pass holds for surfaces
//! anyway.

use npr_core::geometry::Part;

use super::resolve::MASK;
use crate::compose::{Compose, Layers};
use crate::inking::on_paper;
use crate::ramp::Level;

/// Points in a pixel's range of tones over which the ramp is averaged.
const TONE_TAPS: u32 = 4;

/// Share of a pixel that its line must leave open so that the tone beside it is known.
const LEAST_OPEN: f32 = 0.05;

/// Colours for [`SmokeLook::ramp`](super::SmokeLook) that encode tones: red rises up to one half, green from there on,
/// so that bytes tell more tones apart than one channel could. They need a softness of 0.5.
pub const TONES: [[f32; 4]; 8] = [
    [0.0, 0.0, 1.0, 0.0],
    [1.0, 0.0, 1.0, 0.25],
    [1.0, 1.0, 1.0, 0.75],
    [1.0, 1.0, 1.0, Level::UNUSED],
    [1.0, 1.0, 1.0, Level::UNUSED],
    [1.0, 1.0, 1.0, Level::UNUSED],
    [1.0, 1.0, 1.0, Level::UNUSED],
    [1.0, 1.0, 1.0, Level::UNUSED],
];

/// Colour of the outline in the same picture, before its opacity.
pub const OUTLINE: [f32; 3] = [0.0; 3];

/// Tone in a colour of unfinished smoke; negative if the outline covers it.
fn tone_of([r, g, open, _]: [f32; 4]) -> f32 {
    if open < LEAST_OPEN {
        return -1.0;
    }
    0.5 * ((r / open).min(1.0) + (g / open).min(1.0))
}

impl Layers<'_> {
    /// Tone of a neighbour, or `tone` if it has none.
    fn tone_beside(&self, pixel: [u32; 2], step: [i32; 2], tone: f32) -> f32 {
        let [width, height] = self.window.size.map(|side| side as i32);
        let at = [pixel[0] as i32 + step[0], pixel[1] as i32 + step[1]];
        if at[0] < 0 || at[1] < 0 || at[0] >= width || at[1] >= height {
            return tone;
        }
        let texel = (at[1] * width + at[0]) as usize;
        if self.smoke_depths[texel] & MASK == 0 {
            return tone;
        }
        let beside = tone_of(self.linear_texel(self.smoke_colors[texel]));
        if beside < 0.0 { tone } else { beside }
    }

    /// The finished colour of a smoke pixel whose picture holds tone and outline; linear light.
    pub(super) fn penned(&self, pixel: [u32; 2], frame_px: [f32; 2], color: [f32; 4]) -> [f32; 4] {
        // Read the tone of the pixel, and how it changes towards its neighbours.
        let Compose {
            smoke_part,
            smoke_line,
            smoke_anchor_px,
            smoke_tiles,
            ..
        } = *self.compose;
        let pen: &Part = &self.parts[smoke_part as usize];
        let tone = tone_of(color).max(0.0);
        let beside = |x: i32, y: i32| self.tone_beside(pixel, [x, y], tone);
        let change = [
            0.5 * (beside(1, 0) - beside(-1, 0)),
            0.5 * (beside(0, 1) - beside(0, -1)),
        ];
        let slope = (change[0] * change[0] + change[1] * change[1]).sqrt();

        // Average the ramp over the tones within the pixel.
        let mut light = [0.0; 3];
        for i in 0..TONE_TAPS {
            let step = (i as f32 + 0.5) / TONE_TAPS as f32 - 0.5;
            let tap = self.ramp_of(pen, tone + slope * step);
            light = std::array::from_fn(|k| light[k] + tap[k] / TONE_TAPS as f32);
        }

        // Draw the strokes of the sheet there, and the outline over them.
        let at = [
            frame_px[0] - smoke_anchor_px[0],
            frame_px[1] - smoke_anchor_px[1],
        ];
        let on_sheet = self.ink_on_sheet(pen, at, smoke_tiles, tone, change);
        let ink = on_paper(pen, on_sheet, frame_px) * pen.ink_color[3];
        let [r, g, b] = std::array::from_fn(|k| {
            let inked = light[k] + (pen.ink_color[k] - light[k]) * ink;
            smoke_line[k] + (inked - smoke_line[k]) * color[2]
        });
        [r, g, b, color[3]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::smoke::SmokeLook;
    use npr_core::color::{SrgbEncoder, linear_from_srgb};
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        /// What the passes of smoke draw is read again, but for what bytes round off: half a step of each colour's
        /// byte, and of the line's as much again as there is tone, all as large as the part beside the line is small.
        #[test]
        fn tones_come_back_from_bytes(tone in 0f32..=1.0, line in 0f32..=0.9) {
            check_tone_of_bytes(tone, line)?;
        }

        /// Devices round bytes their own way, which must not show where an outline is darker than what it lies on.
        #[test]
        fn a_step_of_the_outlines_byte_is_a_step_of_the_picture(byte in 0u8..255, light in 0f32..=1.0) {
            let encoder = SrgbEncoder::new();
            for ink in [0.0, 0.02, 0.3, 1.0].map(|share| share * light) {
                let of = |byte: u8| {
                    let open = linear_from_srgb(f32::from(byte) / 255.0);
                    encoder.byte(ink + (light - ink) * open)
                };
                prop_assert!(of(byte).abs_diff(of(byte + 1)) <= 1, "{} and {}", of(byte), of(byte + 1));
            }
        }
    }

    fn check_tone_of_bytes(tone: f32, line: f32) -> Result<(), TestCaseError> {
        let look = SmokeLook {
            softness: 0.5,
            ramp: TONES,
            ..SmokeLook::default()
        };
        let [r, g, b] = look.color_of(tone, 0.0);
        prop_assert!(b == 1.0);
        let lined = [r, g, b].map(|open| open * (1.0 - line));
        let encoder = SrgbEncoder::new();
        let bytes = lined.map(|v| encoder.byte(v) as f32);
        let back = bytes.map(|byte| linear_from_srgb(byte / 255.0));
        let half_steps = bytes
            .map(|byte| linear_from_srgb((byte + 0.5) / 255.0) - linear_from_srgb(byte / 255.0));
        let rounded = 0.5 * (half_steps[0] + half_steps[1]) + tone * half_steps[2];
        let room = rounded / back[2] + 1e-3;
        let found = tone_of([back[0], back[1], back[2], 1.0]);
        prop_assert!((found - tone).abs() < room, "{} is not {}", found, tone);
        Ok(())
    }

    /// Found by chance: the line's own byte rounds too.
    #[test]
    fn the_byte_of_the_line_rounds_too() {
        check_tone_of_bytes(0.910_069_94, 0.574_327_1).expect("within what bytes round off");
    }
}
