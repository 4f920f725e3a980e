//! How much of the sky a place sees: the twin of `lib/sky`.
//!
//! A sky is light from everywhere: one colour from above, another, the ground's, from below. What hides it is found on
//! pictures of the scene from many sides, whose texels hold how far outwards the scene reaches: a place whose own
//! distance is less does not see the sky on that side. They are shadow maps [Williams 1978] of as many distant lights;
//! the host draws them once a scene, so that frames only look up.
//!
//! Limits: what is thinner than a texel may hide nothing, and within two texels of a corner places see too much.

use crate::compose::Layers;
use crate::corners::Corners;
use npr_core::surface::{dot, weights_around};

pub use crate::dome::{dome_of, harmonics};
pub use crate::lighting::Openness;

/// Words of the header of each picture, before the texels of all: the vectors right, up and outwards, each with one
/// more word; that of the last is 1 for a picture of the lower half, else 0.
pub const SKY_HEADER_WORDS: u32 = 12;

/// Distance, in texels, that a place is moved along its normal before the look-up: enough for no flat face to hide
/// itself, since the nearest four texels lie up to the root of two away.
const LIFT_TEXELS: f32 = 1.5;

/// How much of the sky a position of the frame sees, and how that changes over a pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SkyPoint {
    here: [f32; 2],
    right: [f32; 2],
    down: [f32; 2],
}

impl SkyPoint {
    /// Nothing is hidden.
    const FULL: Self = Self {
        here: [1.0; 2],
        right: [0.0; 2],
        down: [0.0; 2],
    };

    /// How much of the sky is seen `offset` pixels to the right and down.
    pub fn at(&self, offset: [f32; 2]) -> Openness {
        let [above, below] = std::array::from_fn(|half| {
            let moved = self.right[half] * offset[0] + self.down[half] * offset[1];
            (self.here[half] + moved).clamp(0.0, 1.0)
        });
        Openness { above, below }
    }
}

/// A distance outwards, -1..1 in radii, in the units of the pictures' texels; 0 is kept for empty ones.
pub fn sky_height(outwards: f32) -> f32 {
    (outwards + 1.0) * 0.5 * 65534.0 + 1.0
}

/// Share of a picture's side on which a place sees the sky, and its change over a texel to the right and down.
type Seen = [f32; 3];

impl Layers<'_> {
    /// How much of the sky a triangle sees at a place of the frame. O(pictures).
    pub(crate) fn openness(&self, corners: &Corners<'_>, px: [f32; 2]) -> SkyPoint {
        let lights = self.lights;
        if lights.sky_views == 0 {
            return SkyPoint::FULL;
        }
        // Find the place, lifted off its surface, and its steps over a pixel, in radii of the pictures.
        let around = weights_around(corners.clip, self.view.ndc_at(px), self.view.pixel_ndc());
        let (normal, lifted) = (corners.normal(around[0]), corners.lifted(around[0]));
        let (world, radius) = (corners.world(around[0]), lights.sky_radius);
        let lift = LIFT_TEXELS * 2.0 / lights.sky_side as f32;
        let place: [f32; 3] =
            std::array::from_fn(|i| (lifted[i] - lights.sky_center[i]) / radius + normal[i] * lift);
        let step = |weights: [f32; 3]| -> [f32; 3] {
            let there = corners.world(weights);
            std::array::from_fn(|i| (there[i] - world[i]) / radius)
        };
        let (right, down) = (step(around[1]), step(around[2]));
        // Look up every picture from whose side light falls on the front of the surface.
        let half_side = 0.5 * lights.sky_side as f32;
        let mut whole = [0.0; 2];
        let mut open = SkyPoint {
            here: [0.0; 2],
            ..SkyPoint::FULL
        };
        for view in 0..lights.sky_views {
            let header = (lights.sky_maps + view * SKY_HEADER_WORDS) as usize;
            let outwards = self.floats(header + 8);
            let facing = dot(normal, outwards);
            if facing <= 0.0 {
                continue;
            }
            let half = self.texels[header + 11] as usize;
            let axes = [self.floats(header), self.floats(header + 4)];
            let height = sky_height(dot(place, outwards));
            let [x, y] = axes.map(|axis| dot(place, axis));
            let [seen, by_x, by_y] = self.sky_seen(view, [x, y], height);
            let change = |step: [f32; 3]| {
                half_side * (by_x * dot(step, axes[0]) - by_y * dot(step, axes[1]))
            };
            whole[half] += facing;
            open.here[half] += facing * seen;
            open.right[half] += facing * change(right);
            open.down[half] += facing * change(down);
        }
        // Turn the sums into shares; a half that the surface does not face counts as open.
        for (half, whole) in whole.into_iter().enumerate() {
            if whole > 0.0 {
                open.here[half] /= whole;
                open.right[half] /= whole;
                open.down[half] /= whole;
            } else {
                open.here[half] = 1.0;
            }
        }
        open
    }

    /// Three words of the texture store from `at` on, as floats.
    fn floats(&self, at: usize) -> [f32; 3] {
        std::array::from_fn(|i| f32::from_bits(self.texels[at + i]))
    }

    /// Whether a place at a height sees the sky on one of the pictures: the mean of the four texels around it, weighted
    /// by nearness; each is 1 if the scene reaches no farther outwards there.
    fn sky_seen(&self, view: u32, at: [f32; 2], height: f32) -> Seen {
        let lights = self.lights;
        let side = lights.sky_side as f32;
        let x = (at[0] + 1.0) * 0.5 * side - 0.5;
        let y = (1.0 - at[1]) * 0.5 * side - 0.5;
        let is_inside = |v: f32| v >= 0.0 && v < side - 1.0;
        if !(is_inside(x) && is_inside(y)) {
            return [1.0, 0.0, 0.0];
        }
        let left_top = (view * lights.sky_side + y as u32) * lights.sky_side + x as u32;
        let left_low = left_top + lights.sky_side;
        let [a, b] = [left_top, left_top + 1].map(|texel| self.texel_seen(texel, height));
        let [c, d] = [left_low, left_low + 1].map(|texel| self.texel_seen(texel, height));
        let (across, down) = (x - x.floor(), y - y.floor());
        let (upper, lower) = (a + (b - a) * across, c + (d - c) * across);
        let by_x = (b - a) * (1.0 - down) + (d - c) * down;
        [upper + (lower - upper) * down, by_x, lower - upper]
    }

    /// 1 where the scene reaches no farther outwards than a height at a texel of the pictures, else 0.
    fn texel_seen(&self, texel: u32, height: f32) -> f32 {
        let first = self.lights.sky_maps + self.lights.sky_views * SKY_HEADER_WORDS;
        let word = self.texels[(first + texel / 2) as usize];
        let reach = (word >> (16 * (texel % 2))) & 0xffff;
        if reach as f32 > height { 0.0 } else { 1.0 }
    }
}
