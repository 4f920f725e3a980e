//! Tone ramps: how the light on a surface becomes a few flat tones.

use npr_core::math;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::Color;

/// Most stops that a ramp may have.
pub const STOPS_MAX: usize = 8;

/// One tone of a ramp: from its place on, surfaces are lit this much.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Stop {
    /// Where the tone begins, 0..1: 0 faces away from the light, 0.5 lies across it, 1 faces it.
    /// The first stop also covers everything before it. Raise a stop to spread the darker tone.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub at: f32,
    /// How much of the surface's colour remains, 0..1.5: 0 solid ink, 0.6 a soft shade, 1 the colour
    /// as it is, above 1 a bleached highlight.
    #[schemars(range(min = 0.0, max = 1.5))]
    pub light: f32,
    /// Colour that the tone is multiplied by; default none. A cool tint in the shade and a warm one in the
    /// light look like day.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tint: Option<Color>,
}

/// A stop ready for arithmetic: one row of four floats, as passes read it.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Level {
    /// What linear light, red, green and blue, is multiplied by.
    pub light: [f32; 3],
    /// Where the tone begins on the ramp, 0..1; a level of [`Level::UNUSED`] and all after it never begin.
    pub at: f32,
}

impl Level {
    /// A place that no ramp reaches: fills up rows of fixed length.
    pub const UNUSED: f32 = 2.0;
}

impl Stop {
    /// A tone without tint.
    pub const fn plain(at: f32, light: f32) -> Self {
        Self {
            at,
            light,
            tint: None,
        }
    }

    /// The stop with its tint turned into linear light.
    pub fn level(&self) -> Level {
        let [r, g, b, _] = self.tint.unwrap_or(Color::WHITE).linear();
        Level {
            at: self.at,
            light: [r, g, b].map(|v| v * self.light),
        }
    }
}

/// Place on the ramp, 0..1, of a surface whose unit normal meets the unit light direction at cosine
/// `n_dot_l`: `(N.L + 1) / 2` [Suzuki 2004, section 3.2].
#[inline]
pub fn ramp_coordinate(n_dot_l: f32) -> f32 {
    (n_dot_l + 1.0) * 0.5
}

/// What the surface's linear light is multiplied by at place `x` of a ramp.
///
/// Piecewise constant, with a smooth step `softness` wide centred on the start of each tone; 0 makes
/// hard steps. The result is a blend of the levels, so it never leaves their range, and where the levels
/// rise along the ramp so does the result. Steps closer than `softness` melt into each other.
///
/// `levels` is sorted by `at`; none at all gives full light. O(levels).
#[inline]
pub fn ramp_light(levels: &[Level], softness: f32, x: f32) -> [f32; 3] {
    let Some((first, later)) = levels.split_first() else {
        return [1.0; 3];
    };
    let half = softness * 0.5;
    let used = later.iter().take_while(|level| level.at < Level::UNUSED);
    used.fold(first.light, |below, level| {
        let t = math::smoothstep(level.at - half, level.at + half, x);
        std::array::from_fn(|i| math::mix(below[i], level.light[i], t))
    })
}

/// Index of the first stop that begins before the one ahead of it.
pub(crate) fn first_unsorted(stops: &[Stop]) -> Option<usize> {
    stops
        .windows(2)
        .position(|pair| pair[1].at < pair[0].at)
        .map(|i| i + 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn gray(at: f32, light: f32) -> Level {
        Stop::plain(at, light).level()
    }

    #[test]
    fn hard_steps_switch_at_their_stop() {
        let levels = [gray(0.0, 0.2), gray(0.5, 1.0)];
        assert_eq!(ramp_light(&levels, 0.0, 0.499), [0.2; 3]);
        assert_eq!(ramp_light(&levels, 0.0, 0.5), [1.0; 3]);
    }

    #[test]
    fn a_soft_step_is_half_way_at_its_stop() {
        let levels = [gray(0.0, 0.0), gray(0.5, 1.0)];
        assert!((ramp_light(&levels, 0.2, 0.5)[0] - 0.5).abs() < 1e-6);
        assert_eq!(ramp_light(&levels, 0.2, 0.39), [0.0; 3]);
        assert_eq!(ramp_light(&levels, 0.2, 0.61), [1.0; 3]);
    }

    #[test]
    fn a_tint_is_multiplied_in_linear_light() {
        let stop = Stop {
            at: 0.0,
            light: 0.5,
            tint: Some(Color::rgb(255, 0, 0)),
        };
        assert_eq!(stop.level().light, [0.5, 0.0, 0.0]);
    }

    #[test]
    fn the_coordinate_runs_from_away_to_towards() {
        assert_eq!([-1.0, 0.0, 1.0].map(ramp_coordinate), [0.0, 0.5, 1.0]);
    }

    fn sorted_levels() -> impl Strategy<Value = Vec<Level>> {
        prop::collection::vec((0.0f32..1.0, 0.0f32..1.5), 1..=STOPS_MAX).prop_map(|mut stops| {
            stops.sort_by(|a, b| a.0.total_cmp(&b.0));
            stops
                .into_iter()
                .map(|(at, light)| gray(at, light))
                .collect()
        })
    }

    proptest! {
        #[test]
        fn light_stays_within_its_levels(levels in sorted_levels(), softness in 0.0f32..0.5, x in -0.5f32..1.5) {
            let least = levels.iter().map(|l| l.light[0]).fold(f32::MAX, f32::min);
            let most = levels.iter().map(|l| l.light[0]).fold(f32::MIN, f32::max);
            let light = ramp_light(&levels, softness, x)[0];
            prop_assert!(least - 1e-6 <= light && light <= most + 1e-6, "{light} outside {least}..{most}");
        }

        #[test]
        fn rising_levels_give_rising_light(
            mut levels in sorted_levels(), softness in 0.0f32..0.5, x in 0.0f32..1.0, dx in 0.0f32..1.0,
        ) {
            let mut lights: Vec<f32> = levels.iter().map(|l| l.light[0]).collect();
            lights.sort_by(f32::total_cmp);
            for (level, light) in levels.iter_mut().zip(lights) {
                level.light = [light; 3];
            }
            let (here, further) = (ramp_light(&levels, softness, x)[0], ramp_light(&levels, softness, x + dx)[0]);
            prop_assert!(further >= here - 1e-5, "{here} then {further}");
        }

        #[test]
        fn without_softness_the_light_is_one_of_the_levels(levels in sorted_levels(), x in 0.0f32..1.0) {
            let light = ramp_light(&levels, 0.0, x);
            prop_assert!(levels.iter().any(|level| level.light == light));
        }
    }
}
