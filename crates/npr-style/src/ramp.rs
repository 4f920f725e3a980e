//! Tone ramps: how the light on a surface becomes a few flat tones.

use npr_core::math;

/// Most stops that a ramp may have.
pub const STOPS_MAX: usize = 8;

/// A stop ready for arithmetic: one row of four floats, as passes read it.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Level {
    /// Factor on linear light: red, green and blue.
    pub light: [f32; 3],
    /// Where the tone begins on the ramp, 0..1; a level of [`Level::UNUSED`] and all after it never begin.
    pub at: f32,
}

impl Level {
    /// A place that no ramp reaches: fills up rows of fixed length.
    pub const UNUSED: f32 = 2.0;
}

/// Ramp coordinate, 0..1, of a surface whose unit normal meets the unit light direction at cosine `n_dot_l`: `(N.L + 1)
/// / 2` [Suzuki 2004, section 3.2].
#[inline]
pub fn ramp_coordinate(n_dot_l: f32) -> f32 {
    (n_dot_l + 1.0) * 0.5
}

/// Factor on the surface's linear light at place `x` of a ramp.
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

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn gray(at: f32, light: f32) -> Level {
        Level {
            at,
            light: [light; 3],
        }
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
