//! Speed lines: motion blur as comics draw it.
//!
//! A part that moves leaves strokes behind, from its trailing edge towards where it came from: along a vector of a
//! rule, or along the way that a clip really moved it. Each is widest at the part and ends in a point; no two are of
//! one length. The requirement is [Suzuki 2004, chapter 6]'s; how they are drawn is ours.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::{Color, Length};
use npr_core::random::{hash, unit};

/// Most different trails in a style: each is a walk over the whole picture.
pub const TRAILS_MAX: usize = 16;

/// Most moments of the way that speed lines follow: between them it is a smooth curve.
const MOMENTS: usize = 8;

/// How speed lines are drawn.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Motion {
    /// Colour of the lines; default black. Alpha is how much they cover; white cuts into dark backgrounds.
    pub color: Color,
    /// Distance between lines on screen; default 7 pixels at frame height 1080. 4 a fine hiss, 14 a roar.
    pub spacing: Length,
    /// Width of a line where it leaves the part, as a share of the spacing, 0..1; default 0.6. 1 solid up to the
    /// points.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub weight: f32,
    /// How much lines differ in length, 0..1; default 0.7. 0 a comb, 1 torn.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub variation: f32,
    /// Which of many drawings in the same hand, 0..4294967295; default 0.
    #[schemars(range(max = 4294967295u32))]
    pub seed: u32,
    /// Seconds that a picture of a clip takes in, 0.001..1; default 0.0416667, a frame of a film. What follows motion
    /// counts in it.
    #[schemars(range(min = 0.001, max = 1.0))]
    pub shutter: f32,
    /// How many shutters back speed lines follow what a clip really moves, 0..64; default 0: none. 3 brisk, 8 a blur.
    #[schemars(range(min = 0.0, max = 64.0))]
    pub follow: f32,
    /// Least way on screen that such lines follow; default 40 pixels at frame height 1080. What moves less has none.
    pub least: Length,
    /// How far lines of strokes lag behind on the side that a clip moves them away from, in ways of one shutter, 0..16;
    /// default 0: not at all. 1 reaches back to the picture before, 3 a stretch.
    #[schemars(range(min = 0.0, max = 16.0))]
    pub smear: f32,
    /// How much wider lines of strokes are where a clip moves them by a tenth of the picture's height or more in one
    /// shutter, less where slower, -1..4; default 0: not at all. 1 doubles them, -0.7 leaves fast lines thin.
    #[schemars(range(min = -1.0, max = 4.0))]
    pub swell: f32,
    /// Outlines behind what a clip moves, of where it was, 0..8; default 0. Older ones are thinner and fainter.
    #[schemars(range(max = 8))]
    pub ghosts: u32,
    /// Shutters from one of them to the next, 0.25..64; default 3. 1 a fan, 8 a row of figures.
    #[schemars(range(min = 0.25, max = 64.0))]
    pub ghost_gap: f32,
}

impl Default for Motion {
    fn default() -> Self {
        Self {
            color: Color::rgb(0, 0, 0),
            spacing: Length::ref_px(7.0),
            weight: 0.6,
            variation: 0.7,
            seed: 0,
            shutter: 1.0 / 24.0,
            follow: 0.0,
            least: Length::ref_px(40.0),
            smear: 0.0,
            swell: 0.0,
            ghosts: 0,
            ghost_gap: 3.0,
        }
    }
}

/// What a rule says about motion; what is absent stays.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct RuleMotion {
    /// From the part to where it came from, in the scene: speed lines reach that far. `[0, 0, 0]` stands still.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(inner(range(min = -1e9, max = 1e9)))]
    pub trail: Option<[f32; 3]>,
    /// As `motion.follow`, for the part. 0 leaves none.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0, max = 64.0))]
    pub follow: Option<f32>,
}

impl Motion {
    /// Seconds before a picture at which it has to be known where everything was, in rising order, where speed lines
    /// follow motion for so many shutters.
    pub(crate) fn moments_s(&self, follow: f32) -> Vec<f32> {
        let reach_s = follow * self.shutter;
        let way = (1..=MOMENTS).map(|i| reach_s * i as f32 / MOMENTS as f32);
        let smear = (self.smear > 0.0 || self.swell != 0.0).then_some(self.shutter);
        let ghosts = (1..=self.ghosts).map(|number| self.ghost_s(number));
        let moments = way.chain(smear).chain(ghosts);
        let mut moments: Vec<f32> = moments.filter(|seconds| *seconds > 0.0).collect();
        moments.sort_by(f32::total_cmp);
        moments.dedup();
        moments
    }

    /// Seconds before a picture that after-image `number` shows, counted from 1.
    pub fn ghost_s(&self, number: u32) -> f32 {
        number as f32 * self.ghost_gap * self.shutter
    }

    /// How much of a pixel speed lines cover, 0..1.
    ///
    /// `across` counts spacings across the lines, from anywhere; `along` is the distance from the part as a share of
    /// the trail, 0..1; a spacing is `spacing_px` wide. Edges are smooth over a pixel.
    pub fn coverage(&self, across: f32, along: f32, spacing_px: f32) -> f32 {
        let line = across.floor();
        let reach = 1.0 - self.variation * unit(hash(self.seed, 0x6d6f, line as i32 as u32));
        if along >= reach {
            return 0.0;
        }
        let half = 0.5 * self.weight * (1.0 - along / reach);
        let off = (across - line - 0.5).abs();
        ((half - off) * spacing_px + 0.5).clamp(0.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Style, StyleError};
    use proptest::prelude::*;

    fn read(text: &str) -> Result<Style, StyleError> {
        Style::from_toml(text, &|_| Err(String::new()))
    }

    #[test]
    fn a_line_is_widest_at_the_part_and_ends_in_a_point() {
        let motion = Motion {
            variation: 0.0,
            ..Motion::default()
        };
        let width = |along: f32| {
            let places = (0..1000).map(|i| i as f32 / 1000.0);
            let covered = places.map(|across| motion.coverage(across, along, 50.0));
            covered.sum::<f32>() / 1000.0
        };
        assert!((width(0.0) - 0.6).abs() < 0.01, "{}", width(0.0));
        assert!((width(0.5) - 0.3).abs() < 0.01, "{}", width(0.5));
        assert_eq!(width(1.0), 0.0);
    }

    #[test]
    fn a_part_has_the_trail_of_its_last_rule() {
        let rule = |object: &str, trail: &str| {
            format!("[[rule]]\nmatch.object = '{object}'\nmotion.trail = {trail}\n")
        };
        let text = rule("A", "[1, 0, 0]")
            + &rule("B", "[0, 2, 0]")
            + &rule("C", "[1, 0, 0]")
            + &rule("A", "[0, 0, 0]");
        let style = read(&text).unwrap();
        assert_eq!(style.trails(), [[1.0, 0.0, 0.0], [0.0, 2.0, 0.0]]);
        let of = |object| style.resolve_for("", object).trail;
        let still = Some([0.0; 3]);
        let wanted = [still, Some([0.0, 2.0, 0.0]), Some([1.0, 0.0, 0.0]), None];
        assert_eq!(["A", "B", "C", "D"].map(of), wanted);
    }

    #[test]
    fn moments_reach_as_far_as_the_part_that_follows_most() {
        let text = "motion.shutter = 0.1\n[[rule]]\nmatch.object = 'A'\nmotion.follow = 4";
        let style = read(text).unwrap();
        let moments = style.moments_s();
        assert_eq!((moments.len(), moments[0], moments[7]), (8, 0.05, 0.4));
        let of = |object| style.resolve_for("", object).follow;
        assert_eq!([of("A"), of("B")], [4.0, 0.0]);
        assert!(Style::default().moments_s().is_empty());
    }

    #[test]
    fn trails_beyond_the_limit_are_refused() {
        let text: String = (1..20)
            .map(|i| format!("[[rule]]\nmotion.trail = [{i}, 0, 0]\n"))
            .collect();
        let reported = read(&text).unwrap_err().to_string();
        assert!(
            reported.ends_with("is one of more than 16 different trails"),
            "{reported}"
        );
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]
        #[test]
        fn lines_thin_out_along_the_trail(
            across in -1e6f32..1e6, along in 0f32..1.0, further in 0f32..1.0, spacing_px in 0.1f32..99.0,
            weight in 0f32..1.0, variation in 0f32..1.0, seed: u32,
        ) {
            let motion = Motion { weight, variation, seed, ..Motion::default() };
            let [near, far] = [along, along + further].map(|along| motion.coverage(across, along, spacing_px));
            prop_assert!((0.0..=1.0).contains(&near) && far <= near, "{near} {far}");
        }

        #[test]
        fn hostile_numbers_cover_nothing_or_something(across: f32, along: f32, spacing_px: f32) {
            let covered = Motion::default().coverage(across, along, spacing_px);
            prop_assert!(covered.is_nan() || (0.0..=1.0).contains(&covered));
        }
    }
}
