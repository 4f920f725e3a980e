//! How wide lines are, as shares of their base width.

use npr_core::math;

/// `min + (max - min) * share`, never outside `min..max`; a share that is no number counts as 0.
pub fn width_factor(min: f32, max: f32, share: f32) -> f32 {
    let share = if share.is_nan() {
        0.0
    } else {
        share.clamp(0.0, 1.0)
    };
    math::mix(min, max, share).max(min).min(max)
}

/// How far a line reaches to either side of its edge, in the unit of `base`.
pub fn half_width(base: f32, factor: f32) -> f32 {
    base * factor * 0.5
}

/// The share of 0..1 that a curvature gives: `k R gain / (1 + k R gain)`.
///
/// `curvature` is in 1/length and `radius`, that of the bounding sphere, in the same length, on the
/// surface or on the screen, so doubling a mesh keeps its lines. The sign of the curvature does not
/// count. Rises from 0 in a plane towards 1 at a point; 1/2 where `k R gain` is 1.
pub fn curvature_share(curvature: f32, radius: f32, gain: f32) -> f32 {
    let bend = curvature.abs() * radius * gain;
    if bend.is_nan() {
        return 0.0;
    }
    // Not bend / (1 + bend), which is no number at an infinite curvature.
    1.0 - 1.0 / (1.0 + bend.max(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn half_of_the_bend_is_half_of_the_way() {
        assert_eq!(curvature_share(1.0, 2.0, 0.5), 0.5);
        assert_eq!(width_factor(0.5, 1.5, 0.5), 1.0);
        assert_eq!(half_width(3.0, 1.5), 2.25);
    }

    #[test]
    fn a_plane_is_thin_and_a_point_is_thick() {
        assert_eq!(curvature_share(0.0, 1.0, 1.0), 0.0);
        assert_eq!(curvature_share(f32::INFINITY, 1.0, 1.0), 1.0);
        assert_eq!(curvature_share(f32::NAN, 1.0, 1.0), 0.0);
    }

    proptest! {
        #[test]
        fn factors_stay_within_their_bounds(
            min in 0.0f32..10.0, span in 0.0f32..5.0, share in prop::num::f32::ANY,
        ) {
            let factor = width_factor(min, min + span, share);
            prop_assert!(min <= factor && factor <= min + span, "{factor}");
        }

        #[test]
        fn more_curvature_never_gives_a_thinner_line(k in 0.0f32..1e6, dk in 0.0f32..1e6, gain in 0.0f32..10.0) {
            prop_assert!(curvature_share(k + dk, 1.0, gain) >= curvature_share(k, 1.0, gain));
        }

        #[test]
        fn scaling_the_mesh_keeps_the_share(k in 0.0f32..100.0, radius in 0.1f32..10.0) {
            let (once, twice) = (curvature_share(k, radius, 1.0), curvature_share(k * 0.5, radius * 2.0, 1.0));
            prop_assert_eq!(once, twice);
        }

    }
}
