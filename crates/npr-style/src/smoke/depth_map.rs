//! A light's view as depths, looked up for a place: the twin of `lib/depth_map`.

use npr_core::light_view::Matrix;
use npr_core::surface::apply_point;

/// The four texels around a place in the picture that a light sees.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct DepthTexels {
    /// The texel to the upper left.
    low: [u32; 2],
    /// How far the place lies from that texel towards the one diagonally below it to the right, 0..1 along each axis.
    part: [f32; 2],
    /// Reversed depth of the place.
    nearness: f32,
}

impl DepthTexels {
    /// The texels around a place in a picture of `side` texels square; `None` if the place lies outside of the light's
    /// view.
    pub fn around(m: &Matrix, side: u32, world: [f32; 3]) -> Option<Self> {
        let clip = apply_point(m, world);
        let length = side as f32;
        let at = [
            (clip[0] / clip[3] + 1.0) * 0.5 * length - 0.5,
            (1.0 - clip[1] / clip[3]) * 0.5 * length - 0.5,
        ];
        let is_inside = |x: f32| x >= 0.0 && x < length - 1.0;
        if !(clip[3] > 0.0 && is_inside(at[0]) && is_inside(at[1])) {
            return None;
        }
        let low = at.map(|v| v as u32);
        Some(Self {
            low,
            part: [at[0] - low[0] as f32, at[1] - low[1] as f32],
            nearness: clip[2] / clip[3],
        })
    }

    /// Whether something in the picture lies between the place and the light: the four texels vote, weighted by
    /// nearness, so the edge of a shadow runs smoothly between texels.
    pub fn are_nearer(&self, depths: &[u32], side: u32) -> bool {
        let low = self.low.map(|v| v as usize);
        let dark = |x: usize, y: usize| {
            let depth = f32::from_bits(depths[(low[1] + y) * side as usize + low[0] + x]);
            f32::from(u8::from(depth > self.nearness))
        };
        let upper = dark(0, 0) + (dark(1, 0) - dark(0, 0)) * self.part[0];
        let lower = dark(0, 1) + (dark(1, 1) - dark(0, 1)) * self.part[0];
        upper + (lower - upper) * self.part[1] > 0.5
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use npr_core::light_view::distant_view;
    use proptest::prelude::*;

    const SIDE: u32 = 64;

    /// Light from above over the square of -1..1, in which something hides all with x below `edge` from a height of
    /// 0.5 on.
    fn picture(edge: f32) -> (Matrix, Vec<u32>) {
        let reach = [[-1.0, -1.0, -1.0], [1.0, 1.0, 1.0]];
        let m = distant_view([0.0, 1.0, 0.0], &reach, &reach);
        let texel = |i: u32| {
            // Find the x of the texel's middle by what the matrix makes of two places.
            let of = |x: f32| apply_point(&m, [x, 0.5, 0.0]);
            let along = usize::from(of(1.0)[1] != of(-1.0)[1]);
            let (low, high) = (of(-1.0)[along], of(1.0)[along]);
            let px = [i % SIDE, i / SIDE][along] as f32 + 0.5;
            let ndc = px / SIDE as f32 * 2.0 - 1.0;
            let ndc = if along == 1 { -ndc } else { ndc };
            let x = (ndc - low) / (high - low) * 2.0 - 1.0;
            if x < edge { of(x)[2] } else { 0.0 }
        };
        (m, (0..SIDE * SIDE).map(|i| texel(i).to_bits()).collect())
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        /// Wrong by at most half a texel beside the edge, and never about what lies above.
        #[test]
        fn places_below_are_dark_and_others_are_not(
            edge in -0.8f32..0.8, at in prop::array::uniform3(-0.9f32..0.9),
        ) {
            let texel = 2.1 / SIDE as f32;
            prop_assume!((at[0] - edge).abs() > texel && (at[1] - 0.5).abs() > 1e-3);
            let (m, depths) = picture(edge);
            let texels = DepthTexels::around(&m, SIDE, at).unwrap();
            prop_assert_eq!(texels.are_nearer(&depths, SIDE), at[0] < edge && at[1] < 0.5);
        }

        #[test]
        fn no_place_makes_it_look_outside(
            world in prop::array::uniform3(prop::num::f32::ANY),
            m in prop::array::uniform4(prop::array::uniform4(prop::num::f32::ANY)), side in 0u32..4,
        ) {
            let depths = vec![0; (side * side) as usize];
            if let Some(texels) = DepthTexels::around(&m, side, world) {
                texels.are_nearer(&depths, side);
            }
        }
    }
}
