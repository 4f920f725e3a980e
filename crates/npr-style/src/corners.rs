//! The corners of a triangle as a pixel sees them, and what is interpolated between them.

use crate::ramp::ramp_coordinate;
use npr_core::geometry::PosedVertex;
use npr_core::surface::{blend3, dot, unit_or_z};

/// How far the tone of a flat triangle may lie beyond the tones of its corners, in ramp coordinate: rounding.
const TONE_ROOM: f32 = 0.002;

/// A triangle's corners, and 1 where its front is seen or -1 where its back is.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Corners<'a> {
    pub posed: [&'a PosedVertex; 3],
    pub clip: [[f32; 4]; 3],
    pub side: f32,
}

impl Corners<'_> {
    #[inline]
    pub fn normal(&self, weights: [f32; 3]) -> [f32; 3] {
        unit_or_z(blend3(weights, self.posed.map(|v| v.normal))).map(|v| v * self.side)
    }

    #[inline]
    pub fn world(&self, weights: [f32; 3]) -> [f32; 3] {
        blend3(weights, self.posed.map(|v| v.world))
    }

    /// Cosines between the smooth normal, that of [`Corners::normal`], and the direction `towards` at three places, at
    /// less cost than one by one.
    #[inline]
    pub fn cosines(&self, weights: [[f32; 3]; 3], towards: [f32; 3]) -> [f32; 3] {
        // Keep the places in rows, with one more to make four, so that all steps become vector instructions.
        let [a, b, c] = weights;
        let lanes: [[f32; 4]; 3] = std::array::from_fn(|i| [a[i], b[i], c[i], c[i]]);
        let blended = |corners: [f32; 3]| -> [f32; 4] {
            std::array::from_fn(|i| {
                corners[0] * lanes[0][i] + corners[1] * lanes[1][i] + corners[2] * lanes[2][i]
            })
        };
        let [x, y, z] = std::array::from_fn(|axis| blended(self.posed.map(|v| v.normal[axis])));
        let along = blended(self.posed.map(|v| dot(v.normal, towards)));
        let squares: [f32; 4] = std::array::from_fn(|i| x[i] * x[i] + y[i] * y[i] + z[i] * z[i]);
        let cosines: [f32; 4] = std::array::from_fn(|i| along[i] / squares[i].sqrt());
        std::array::from_fn(|i| {
            let has_direction = squares[i] >= 1e-30;
            self.side
                * if has_direction {
                    cosines[i]
                } else {
                    towards[2]
                }
        })
    }

    /// Lowest and highest ramp coordinate that the smooth normal can have anywhere towards the direction `towards`.
    pub fn range_towards(&self, towards: [f32; 3]) -> [f32; 2] {
        let at = self
            .posed
            .map(|v| ramp_coordinate(dot(v.normal, towards) * self.side));
        // A blend of normals that is scaled to unit length bulges beyond them by at most their difference.
        let [a, b, c] = self.posed.map(|v| v.normal);
        let bulge = 0.5 * (1.0 - dot(a, b).min(dot(b, c)).min(dot(c, a)));
        let room = TONE_ROOM + bulge;
        [
            at[0].min(at[1]).min(at[2]) - room,
            at[0].max(at[1]).max(at[2]) + room,
        ]
    }

    /// A place of the triangle lifted onto the tangent planes of its corners, so that the facets of a smooth surface
    /// throw no shadows on one another [Hanika 2021].
    #[inline]
    pub fn lifted(&self, weights: [f32; 3]) -> [f32; 3] {
        let world = self.world(weights);
        let lifts = self.posed.map(|corner| {
            let normal = corner.normal.map(|n| n * self.side);
            let offset = std::array::from_fn(|i| world[i] - corner.world[i]);
            let below = dot(offset, normal).min(0.0);
            normal.map(|n| -below * n)
        });
        let lift = blend3(weights, lifts);
        std::array::from_fn(|i| world[i] + lift[i])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]
        #[test]
        fn cosines_are_those_of_the_smooth_normal(
            normals in prop::array::uniform3(prop::array::uniform3(-1f32..1.0)),
            towards in prop::array::uniform3(-1f32..1.0),
            places in prop::array::uniform3(prop::array::uniform3(0f32..1.0)),
            front in any::<bool>(),
        ) {
            let posed = normals.map(|normal| PosedVertex { normal: unit_or_z(normal), ..PosedVertex::default() });
            let side = if front { 1.0 } else { -1.0 };
            let corners = Corners { posed: std::array::from_fn(|i| &posed[i]), clip: [[0.0; 4]; 3], side };
            let towards = unit_or_z(towards);
            let got = corners.cosines(places, towards);
            for (got, weights) in got.iter().zip(places) {
                let blended = blend3(weights, posed.map(|v| v.normal));
                prop_assume!(dot(blended, blended) > 1e-4);
                prop_assert!((got - dot(corners.normal(weights), towards)).abs() < 1e-3);
            }
            prop_assert_eq!(corners.cosines([[0.0; 3]; 3], towards), [towards[2] * side; 3], "no direction");
        }
    }
}
