//! Paint under the pen: where a surface is painted dark, the pen leaves less paper white than the light alone would.
//!
//! Pictures on paper show no colours, but eyes, stripes and dark leather must not be lost with them. A printer of
//! black and white keeps them as tone: the white that light leaves is multiplied by the white that paint leaves.

use crate::compose::Layers;
use crate::luminance::LUMA;
use crate::surface_color::footprint;
use npr_core::geometry::{NONE, Part, Triangle};
use npr_core::raster::ID_MASK;
use npr_core::surface::{blend2, dot};
use npr_core::texture;

/// Lightness (root of luminance) up to which paint is solid ink in any light.
const INKY: f32 = 0.12;

/// Lightness from which paint counts as white paper.
const PAPERY: f32 = 0.75;

/// Most white that light leaves, where 1 ends the last stroke: paint nearly as light as paper draws no strokes.
const OPEN: f32 = 1.25;

/// Share of the paper, 0..1, that paint of a colour in linear light leaves white in full light.
///
/// `strength` is how much paint counts, 0..1: at 1 the share is linear in lightness, towards 0 only nearly black paint
/// darkens. Rises with every channel.
pub fn paint_white(color: [f32; 3], strength: f32) -> f32 {
    let lightness = dot(color, LUMA).max(0.0).sqrt();
    let x = ((lightness - INKY) / (PAPERY - INKY)).clamp(0.0, 1.0);
    x / (x + strength * (1.0 - x)).max(1e-6)
}

/// Luminance L of the shade ramp for paint that leaves `white` of the paper, for a tone that is cut at `threshold`.
///
/// Light alone leaves the share `2 L - threshold` of a hatched tone white, see
/// [`tone_value`](crate::hatch::tone_value). Never above `l` by more than rounding where paint matters.
pub fn painted_level(l: f32, white: f32, threshold: f32) -> f32 {
    let lit = 2.0 * l - threshold;
    if lit <= 0.0 || white >= 1.0 {
        return l;
    }
    0.5 * (lit.min(OPEN) * white + threshold)
}

impl Layers<'_> {
    /// White that the paint of triangle `id` leaves at a pixel and its neighbours to the right and below; 1 if paint
    /// does not count.
    pub(crate) fn paint_at(&self, id: u32, part: &Part, weights: [[f32; 3]; 3]) -> [f32; 3] {
        if part.flags & Part::PAINTED == 0 {
            return [1.0; 3];
        }
        let Triangle { corners, .. } = self.triangles[((id & ID_MASK) - 1) as usize];
        let vertices = corners.map(|v| &self.vertices[v as usize]);
        let [r, g, b, strength] = self.linear_texel(part.paint_color);
        let uvs = weights.map(|w| blend2(w, vertices.map(|v| v.uv)));
        let covered = footprint(uvs);
        std::array::from_fn(|i| {
            let tint = self.tint(weights[i], vertices);
            let mut color = [r * tint[0], g * tint[1], b * tint[2]];
            if part.texture != NONE {
                let texel = texture::sample(self.texels, part.texture, uvs[i], covered);
                color = std::array::from_fn(|k| color[k] * texel[k]);
            }
            paint_white(color, strength)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hatch::tone_value;
    use proptest::prelude::*;

    /// Share of a hatch of even ranks that stays white.
    fn white_share(l: f32, threshold: f32) -> f32 {
        let white = |i: &u32| tone_value((*i as f32 + 0.5) / 1000.0, l) >= threshold;
        (0..1000).filter(white).count() as f32 / 1000.0
    }

    #[test]
    fn black_paint_is_ink_and_white_paint_is_paper() {
        assert_eq!(paint_white([0.0; 3], 0.5), 0.0);
        assert_eq!(paint_white([1.0; 3], 1.0), 1.0);
        assert_eq!(paint_white([0.6; 3], 1.0), 1.0);
        // Lightness halfway between.
        let half = 0.435_f32 * 0.435;
        assert!((paint_white([half; 3], 1.0) - 0.5).abs() < 1e-4);
        assert!((paint_white([half; 3], 0.5) - 2.0 / 3.0).abs() < 1e-4);
        assert_eq!(white_share(painted_level(1.0, 0.0, 0.5), 0.5), 0.0);
        assert_eq!(white_share(painted_level(1.0, 1.0, 0.5), 0.5), 1.0);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]
        #[test]
        fn the_white_of_light_is_multiplied_by_that_of_paint(
            l in 0f32..1.0, white in 0f32..1.0, threshold in 0.1f32..0.9,
        ) {
            let lit = (2.0 * l - threshold).clamp(0.0, OPEN);
            let got = white_share(painted_level(l, white, threshold), threshold);
            prop_assert!((got - (lit * white).min(1.0)).abs() < 2e-3);
        }

        #[test]
        fn paint_never_lightens_and_light_never_darkens(
            l in 0f32..1.0, more in 0f32..0.3, white in 0f32..=1.0, threshold in 0.0f32..=1.0,
        ) {
            let level = painted_level(l, white, threshold);
            prop_assert!(level <= l + 1e-5);
            prop_assert!(painted_level(l + more, white, threshold) >= level - 1e-5);
        }

        #[test]
        fn paint_leaves_a_share(color in prop::array::uniform3(0f32..4.0), strength in 0f32..=1.0) {
            let white = paint_white(color, strength);
            prop_assert!((0.0..=1.0).contains(&white));
            prop_assert!(paint_white(color, 1.0) <= white + 1e-6);
        }
    }
}
