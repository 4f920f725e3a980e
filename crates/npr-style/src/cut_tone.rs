//! Tone that is cut out as with a knife: no strip of a hatch is narrower than the spacing of its strokes or dots.
//!
//! A draughtsman lays a sheet of tone over the shade, cuts it along the edge, and lifts the rest off. A strip that one
//! row of dots would not fill gets none: its dots would be lone specks. So the pixels of all parts whose hatch is cut
//! out ([`Part::CUT`]) are sorted into tone, paper and black, and [`even_tones`](crate::even_tones) finds by a median
//! over a disc which tone is too narrow. Other parts and what lies behind are paper. Black counts for nothing: tone
//! that is narrow beside it goes, and black stays black. What is cut away shows the edge of the tone itself, as grooves
//! do: black where more than half of it would be ink, else paper.

use crate::compose::Layers;
use crate::even_tones::{CHANGED, STEP_PARTS, TILE, TONES, ToneMap, far_px, part_in, radius_of};
use crate::hatch::{sharpen, tone_value};
use npr_core::geometry::Part;
use npr_core::surface::weights_around;

/// A hatch that the light leaves.
pub(crate) const TONE: u32 = 0;

/// No ink, or next to none.
pub(crate) const PAPER: u32 = 1;

/// Ink without a hatch.
pub(crate) const BLACK: u32 = 2;

/// Share of ink from which dots are tone to the knife: smaller ones would be grey specks. Of strokes, which taper off,
/// any ink is.
const LEAST_INK: f32 = 0.08;

/// Share of ink from which it is black to the knife.
const NEARLY_BLACK: f32 = 0.85;

/// Distance between dots whose rows are 1 apart: every other row lies between the dots of the one before.
const PITCH_OF_SPACING: f32 = 1.41;

/// Largest radius of a disc, in pixels.
const CUT_REACH_PX_MAX: f32 = 40.0;

/// Radius in pixels of the disc whose median drops strips of a part's hatch that are narrower than from one stroke, or
/// dot, to the next.
pub fn cut_reach_px(part: &Part) -> f32 {
    let pitch = match part.flags & Part::ISOTROPIC {
        0 => 1.0,
        _ => PITCH_OF_SPACING,
    };
    radius_of(pitch * part.spacing_px).min(CUT_REACH_PX_MAX)
}

/// What the knife takes a hatch of luminance `l` of the shade ramp for.
fn cut_tone_of(part: &Part, l: f32) -> u32 {
    let is_inked = |s: f32| tone_value(sharpen(s, part.hatch_gain), l) < part.threshold;
    let least_ink = match part.flags & Part::ISOTROPIC {
        0 => 0.0,
        _ => LEAST_INK,
    };
    if is_inked(NEARLY_BLACK) {
        BLACK
    } else if is_inked(least_ink) {
        TONE
    } else {
        PAPER
    }
}

impl ToneMap<'_> {
    /// Whether the hatch of the part in a word is cut out.
    pub(crate) fn is_cut(&self, word: u32) -> bool {
        self.part_of(word).flags & Part::CUT != 0
    }

    /// What a pixel is on the sheet of tone; `None` where it counts for nothing.
    pub(crate) fn on_sheet(&self, word: u32) -> Option<u32> {
        if word == 0 || !self.is_cut(word) {
            return Some(PAPER);
        }
        let tone = word & (TONES - 1);
        (tone != BLACK).then_some(tone)
    }

    /// Whether a pixel shows the hatch of a part that is cut out.
    fn is_cut_tone(&self, word: u32) -> bool {
        word != 0 && word & (TONES - 1) == TONE && self.is_cut(word)
    }

    /// Steps in the evened map of a pixel of a part whose hatch is cut out, if it is paper or black.
    pub(crate) fn beside_cut_tone(&self, word: u32) -> Option<u32> {
        match word & (TONES - 1) {
            _ if !self.is_cut(word) => None,
            TONE => None,
            PAPER => Some(STEP_PARTS),
            _ => Some(0),
        }
    }

    /// Whether a tile shows a hatch that is cut out, and anything else lies within its reach.
    pub(crate) fn is_cut_around(&self, tile: [u32; 2]) -> bool {
        let start = tile.map(|at| at * TILE);
        let end: [u32; 2] = std::array::from_fn(|i| (start[i] + TILE).min(self.size[i]));
        let own = (start[1]..end[1]).flat_map(|y| self.row(y, start[0]..end[0]));
        let far = |word: &u32| far_px(self.part_of(*word).tone_reach_px);
        let Some(far) = own.filter(|word| self.is_cut_tone(**word)).map(far).max() else {
            return false;
        };
        let low = start.map(|at| at.saturating_sub(far));
        let high: [u32; 2] = std::array::from_fn(|i| (end[i] + far).min(self.size[i]));
        let mut around = (low[1]..high[1]).flat_map(|y| self.row(y, low[0]..high[0]));
        around.any(|word| !self.is_cut_tone(*word))
    }
}

impl Layers<'_> {
    /// What the knife takes a place of the frame for that shows triangle `id` of a part whose hatch is cut out.
    pub(crate) fn cut_tone_at(&self, id: u32, px: [f32; 2]) -> u32 {
        let known = &self.known[(id - 1) as usize];
        match known.ink() {
            Some(0.0) => return PAPER,
            Some(_) => return BLACK,
            None => {}
        }
        let triangle = &self.triangles[(id - 1) as usize];
        let part = &self.parts[triangle.part as usize];
        let corners = self.corners_of(triangle);
        let (ndc, step) = (self.view.ndc_at(px), self.view.pixel_ndc());
        let weights = weights_around(corners.clip, ndc, step);
        let dark = self.shadowed(id, &corners, weights[0]);
        let levels = self.levels_at((id, part), &corners, px, weights, dark);
        cut_tone_of(part, levels.l[0])
    }

    /// Share of the hatch that the knife leaves at a place of the frame, 0..1.
    pub(crate) fn hatch_left(&self, frame_px: [f32; 2]) -> f32 {
        // Take what the pixel itself shows, unless that is paper.
        let [x, y] = self.window.pixel_at(frame_px);
        let [width, height] = self.window.size;
        let word_at = |x: u32, y: u32| self.evened[(y * width + x) as usize];
        let word = word_at(x, y);
        let left = self.left_by(word);
        if left > 0.0 || word & CHANGED != 0 {
            return left;
        }

        // Keep the soft edge of what lies beside it.
        let mut most = left;
        for v in y.saturating_sub(1)..(y + 2).min(height) {
            for u in x.saturating_sub(1)..(x + 2).min(width) {
                most = most.max(self.left_by(word_at(u, v)));
            }
        }
        most
    }

    /// Share of the hatch that the knife leaves around the middle of a pixel, by a word of the evened map; 0 where the
    /// map knows of no tone that is cut.
    fn left_by(&self, word: u32) -> f32 {
        if word == 0 || self.parts[part_in(word) as usize].flags & Part::CUT == 0 {
            return 0.0;
        }
        1.0 - (word & (CHANGED - 1)) as f32 / STEP_PARTS as f32
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::backdrop::Rules;
    use crate::compose::Compose;
    use crate::even_tones::{even_tones, flag_tones, tiles_of};
    use crate::lighting::Lights;
    use npr_core::math;
    use npr_core::window::{View, Window};
    use proptest::prelude::*;

    const SIDE: u32 = 64;

    /// A part with a hatch whose strips under `least_px` are cut away.
    fn hatched(least_px: f32) -> Part {
        let part = Part {
            flags: Part::HATCH | Part::CUT,
            threshold: 0.5,
            hatch_gain: 1.0,
            spacing_px: least_px,
            ..Part::default()
        };
        Part {
            tone_reach_px: cut_reach_px(&part),
            ..part
        }
    }

    fn word(part: u32, tone: u32) -> u32 {
        ((part + 1) << 12) | (tone * 585)
    }

    /// Share of the hatch that is left at every pixel of a picture of words.
    fn left_of(parts: &[Part], word_at: impl Fn(u32, u32) -> u32) -> impl Fn(u32, u32) -> f32 {
        let words: Vec<u32> = (0..SIDE * SIDE)
            .map(|i| word_at(i % SIDE, i / SIDE))
            .collect();
        let map = ToneMap {
            size: [SIDE; 2],
            parts,
            words: &words,
        };
        let mut flags = vec![0; tiles_of([SIDE; 2]).iter().product::<u32>() as usize];
        flag_tones(&map, &mut flags);
        let mut evened = vec![0; words.len()];
        even_tones(&map, &flags, &mut evened);
        let parts = parts.to_vec();
        move |x, y| {
            let size = [SIDE as f32; 2];
            let window = Window::over(size, [0.0; 2], size, [SIDE; 2]);
            let (view, lights, rules) = (View::default(), Lights::default(), Rules::default());
            let compose = Compose::default();
            let layers = Layers {
                parts: &parts,
                evened: &evened,
                ..Layers::empty(&view, &window, &compose, &lights, &rules)
            };
            layers.hatch_left([x as f32 + 0.5, y as f32 + 0.5])
        }
    }

    /// How far a pixel lies from a line through the middle of the picture.
    fn away([cos, sin]: [f32; 2], shift: f32, x: u32, y: u32) -> f32 {
        let middle = SIDE as f32 / 2.0;
        (x as f32 + 0.5 - middle) * cos + (y as f32 + 0.5 - middle) * sin - shift
    }

    fn middle_pixels() -> impl Iterator<Item = (u32, u32)> {
        (24..40).flat_map(|y| (24..40).map(move |x| (x, y)))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]
        /// Strips of dots narrower than from one dot to the next are cut away, wide ones are whole, whatever part lies
        /// beside them: paper of their own part, of a part without dots, or what lies behind all.
        #[test]
        fn strips_of_dots_show_if_they_are_wide_enough(
            angle in 0f32..6.3, shift in -6f32..6.0, least in 4f32..16.0, behind in 0u32..3,
        ) {
            let normal = [math::cos(angle), math::sin(angle)];
            let parts = [hatched(least), Part::default()];
            let beside = [word(0, PAPER), word(1, 0), 0][behind as usize];
            for (width, is_left) in [(0.85 * least - 0.7, false), (1.15 * least + 0.7, true)] {
                let is_strip = |x, y| away(normal, shift, x, y).abs() < width / 2.0;
                let left = left_of(&parts, |x, y| if is_strip(x, y) { word(0, TONE) } else { beside });
                for (x, y) in middle_pixels().filter(|(x, y)| is_strip(*x, *y)) {
                    let is_spine = away(normal, shift, x, y).abs() < 0.5;
                    if is_left {
                        prop_assert!(!is_spine || left(x, y) > 0.5, "{width} of {least}: {x} {y} {}", left(x, y));
                    } else {
                        prop_assert!(left(x, y) < 0.5, "{width} of {least}: {x} {y} {}", left(x, y));
                    }
                }
            }
        }

        /// A straight edge of tone stays where it is, up to the pixel.
        #[test]
        fn straight_edges_of_tone_stay(angle in 0f32..6.3, shift in -6f32..6.0, least in 4f32..12.0) {
            let normal = [math::cos(angle), math::sin(angle)];
            let inside = |x, y| away(normal, shift, x, y);
            let tone = |x, y| if inside(x, y) < 0.0 { TONE } else { PAPER };
            let parts = [hatched(least)];
            let left = left_of(&parts, |x, y| word(0, tone(x, y)));
            for (x, y) in middle_pixels().filter(|(x, y)| inside(*x, *y) < -1.5) {
                prop_assert_eq!(left(x, y), 1.0, "{} {}", x, y);
            }
        }
    }

    /// Tone of two parts side by side is one sheet; a speck of it is gone, and black beside it is neither.
    #[test]
    fn a_sheet_runs_over_parts_and_black_counts_for_nothing() {
        let parts = [hatched(8.0), hatched(8.0)];
        let sheet = left_of(&parts, |x, _| match x {
            26..32 => word(0, TONE),
            32..38 => word(1, TONE),
            _ => 0,
        });
        assert!((28..36).all(|x| sheet(x, 32) == 1.0));
        let speck = left_of(&parts, |x, y| {
            let is_speck = (30..34).contains(&x) && (30..34).contains(&y);
            word(0, if is_speck { TONE } else { PAPER })
        });
        assert_eq!(speck(32, 32), 0.0);
        let rim = left_of(&parts, |x, _| match x {
            0..32 => word(0, BLACK),
            32..35 => word(0, TONE),
            _ => word(0, PAPER),
        });
        assert!(rim(33, 32) < 0.5, "a rim of black is {}", rim(33, 32));
        assert_eq!(rim(20, 32), 1.0, "black is cut");
        let wide = left_of(&parts, |x, _| word(0, if x < 32 { BLACK } else { TONE }));
        assert!((33..60).all(|x| wide(x, 32) == 1.0));
    }

    #[test]
    fn dark_hatch_is_black_and_light_hatch_paper() {
        let strokes = hatched(8.0);
        let dots = Part {
            flags: strokes.flags | Part::ISOTROPIC,
            ..strokes
        };
        let tones_of =
            |part: Part| [0.3, 0.4, 0.7, 0.735, 0.748, 0.9].map(|l| cut_tone_of(&part, l));
        assert_eq!(tones_of(dots), [BLACK, TONE, TONE, PAPER, PAPER, PAPER]);
        // Strokes taper off, and end where they have no ink.
        assert_eq!(tones_of(strokes), [BLACK, TONE, TONE, TONE, TONE, PAPER]);
    }
}
