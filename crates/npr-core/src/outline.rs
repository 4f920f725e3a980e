//! Settings of outlines, as passes read them.

use crate::gpu_layout;
use bytemuck::{Pod, Zeroable};

/// How lines are detected, chosen and drawn.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct Outline {
    /// Line width at width factor 1: frame pixels, or world units where `flags` has [`Outline::WORLD_WIDTH`].
    pub base_width: f32,
    /// Width factor where the source gives 0.
    pub min_factor: f32,
    /// Width factor where the source gives 1.
    pub max_factor: f32,
    /// How strongly projected curvature swells lines.
    pub gain: f32,
    /// Bounding radius of the scene in world units: curvatures are stored relative to it.
    pub radius_world: f32,
    /// Cosine of the crease angle: sharper edges are creases.
    pub crease_cos: f32,
    /// Depth jump, as a share of the frame's height at that depth, from which pixels are separated by a line.
    pub depth_threshold: f32,
    /// Cosine of the angle between normals from which pixels are separated by a line.
    pub normal_cos: f32,
    /// Which kinds of edges are drawn: bits of [`KindSet`](crate::line_kind::KindSet), and
    /// [`FACING`](crate::edge_flags::EdgeFlags::FACING).
    pub kinds: u32,
    /// Which buffers lines are detected on: bits of [`Outline::DEPTH`] to [`Outline::MATERIAL_ID`].
    pub detects: u32,
    /// Bits of [`Outline::WORLD_WIDTH`] to [`Outline::UNMASKED`].
    pub flags: u32,
    /// Largest half width of any line, rounded up, plus one: how far ink reaches beside its surface, in frame pixels.
    pub reach_px: u32,
}
gpu_layout!(Outline {
    base_width,
    min_factor,
    max_factor,
    gain,
    radius_world,
    crease_cos,
    depth_threshold,
    normal_cos,
    kinds,
    detects,
    flags,
    reach_px,
});

impl Outline {
    /// Detects jumps in depth. Also the bit that such a pixel gets in the mask.
    pub const DEPTH: u32 = 1;
    /// Detects jumps in the normal.
    pub const NORMAL: u32 = 2;
    /// Detects changes of object.
    pub const OBJECT_ID: u32 = 4;
    /// Detects changes of material.
    pub const MATERIAL_ID: u32 = 8;
    /// Compares depths with the neighbour's tangent plane instead of directly.
    pub const PLANE_DEPTH: u32 = 16;
    /// Detects where pieces of one object cut through each other. Also the bit that such a pixel gets in the mask.
    pub const PIECE: u32 = 32;

    /// `base_width` is in world units.
    pub const WORLD_WIDTH: u32 = 1;
    /// Width follows the projected curvature instead of the vertex's own value.
    pub const PROJECTED_CURVATURE: u32 = 2;
    /// Ribbons end square and look at the one mask pixel under them, as published.
    pub const PUBLISHED: u32 = 4;
    /// Ribbons are drawn without looking at the mask.
    pub const UNMASKED: u32 = 8;
}

/// The bits of a mask pixel that say what found it.
pub const MASK_KINDS: u32 =
    Outline::DEPTH | Outline::NORMAL | Outline::OBJECT_ID | Outline::MATERIAL_ID | Outline::PIECE;

/// Cosine of the angle between normals above which two pieces of an object count as one smooth skin.
pub const PIECE_COS: f32 = 0.99;

/// In the mask: this pixel's surface is the one in front, so the line belongs to it.
pub const MASK_OWNER: u32 = 16;

/// In the mask: the owner's line runs along its left, right, upper or lower side, in this bit and the three above.
pub const MASK_SIDE: u32 = 256;

/// Width factor 0..1 that a curvature gives, as `x / (1 + x)`: half its range where `x`, curvature times gain, is 1.
pub fn width_of_curvature(curvature: f32, gain: f32) -> f32 {
    let x = curvature.abs() * gain;
    x / (1.0 + x)
}

/// Factor on a line's width at a share 0..1 of the way from the least to the greatest.
#[inline]
pub fn width_factor(min: f32, max: f32, share: f32) -> f32 {
    min + (max - min) * share
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn half_of_the_bend_is_half_of_the_way() {
        assert_eq!(width_of_curvature(2.0, 0.5), 0.5);
        assert_eq!(width_factor(0.5, 1.5, 0.5), 1.0);
    }

    #[test]
    fn a_plane_is_thin_and_a_point_is_thick() {
        assert_eq!(width_of_curvature(0.0, 1.0), 0.0);
        assert_eq!(width_of_curvature(f32::MAX, 1.0), 1.0);
    }

    proptest! {
        #[test]
        fn the_sign_of_a_curvature_does_not_count(k in 0.0f32..1e6, gain in 0.0f32..10.0) {
            prop_assert_eq!(width_of_curvature(-k, gain), width_of_curvature(k, gain));
        }

        /// Rounding may cost a few units in the last place.
        #[test]
        fn more_curvature_never_gives_a_thinner_line(k in 0.0f32..1e6, dk in 0.0f32..1e6, gain in 0.0f32..10.0) {
            prop_assert!(width_of_curvature(k + dk, gain) >= width_of_curvature(k, gain) - 1e-6);
        }

        #[test]
        fn scaling_the_mesh_keeps_the_share(k in 0.0f32..100.0, radius in 0.1f32..10.0) {
            // Curvatures are stored in 1 / radius.
            let [once, twice] = [k * radius, (k * 0.5) * (radius * 2.0)];
            prop_assert_eq!(width_of_curvature(once, 1.0), width_of_curvature(twice, 1.0));
        }

        #[test]
        fn factors_stay_within_their_bounds(min in 0.0f32..10.0, span in 0.0f32..5.0, share in 0f32..=1.0) {
            let factor = width_factor(min, min + span, share);
            prop_assert!(min <= factor && factor <= (min + span) * 1.000_001, "{factor}");
        }
    }
}
