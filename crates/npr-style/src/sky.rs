//! How much of the sky a place sees, and the light of a picture of the sky: the twin of `lib/sky`.
//!
//! A sky is light from everywhere: of one colour from above, of another, the ground's, from below. What stands in its
//! way is found on pictures of the scene from many sides, whose texels hold how far outwards the scene reaches there:
//! a place whose own distance is less does not see the sky on that side. As in shadow maps [Williams 1978] of so many
//! distant lights; the host draws them once a scene, so that frames only look up.
//!
//! Limits: what is thinner than a texel may hide nothing, and within two texels of a corner places see too much.

use crate::compose::Layers;
use crate::lighting::Lights;
use crate::tone::Corners;
use npr_core::math::{cos_f64, sin_f64};
use npr_core::surface::{dot, weights_around};

/// Words before the texels of the pictures, for each of them: right, up and outwards, each a vector and an empty
/// word; of the last row it is 1 where the picture is of the lower half.
pub const SKY_HEADER_WORDS: u32 = 12;

/// How far a place is moved along its normal before it is looked up, in texels: enough for no flat face to hide
/// itself, for the nearest four lie up to the root of two away.
const LIFT_TEXELS: f32 = 1.5;

/// Share of the sky and of the ground below that shines on a surface, 0..1, by how squarely it faces each part of
/// them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Openness {
    /// Of what lies above.
    pub above: f32,
    /// Of what lies below.
    pub below: f32,
}

impl Openness {
    /// Nothing is hidden.
    pub const FULL: Self = Self {
        above: 1.0,
        below: 1.0,
    };
}

/// How much of the sky a place of the frame sees, and how that changes over a pixel.
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

    /// What is seen so many pixels to the right and down.
    pub fn at(&self, offset: [f32; 2]) -> Openness {
        let [above, below] = std::array::from_fn(|half| {
            let moved = self.right[half] * offset[0] + self.down[half] * offset[1];
            (self.here[half] + moved).clamp(0.0, 1.0)
        });
        Openness { above, below }
    }
}

/// A distance outwards, -1..1 in radii, as the texels of pictures hold it; 0 is kept for nothing.
pub fn sky_height(outwards: f32) -> f32 {
    (outwards + 1.0) * 0.5 * 65534.0 + 1.0
}

/// How far the sky is seen on one of the pictures, and how that changes over a texel to the right and down.
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
        // Look up every picture from which light falls on the front of the surface.
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
        // Make shares of sums; a half that the surface does not face counts as open.
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

    /// Three words of the texture store as numbers.
    fn floats(&self, at: usize) -> [f32; 3] {
        std::array::from_fn(|i| f32::from_bits(self.texels[at + i]))
    }

    /// How far a place at a height sees the sky on one of the pictures: the mean of the four texels around it by how
    /// near they are, of which each is 1 where the scene reaches no farther outwards.
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

/// The nine polynomials of a unit vector that a picture of the sky is summed up by: spherical harmonics up to the
/// second order, not normalised.
pub fn harmonics([x, y, z]: [f32; 3]) -> [f32; 9] {
    [
        1.0,
        x,
        y,
        z,
        x * y,
        y * z,
        x * z,
        3.0 * z * z - 1.0,
        x * x - y * y,
    ]
}

/// What [`harmonics`] of the sky are weighted by so that their sum is the mean of its light over the half that a
/// surface faces, by how squarely [Ramamoorthi and Hanrahan 2001, equations 10 and 13].
const HARMONIC_WEIGHTS: [f32; 9] = [1.0, 2.0, 2.0, 2.0, 3.75, 3.75, 3.75, 0.312_5, 0.937_5];

/// Sums a picture of the whole sky up: nine colours whose sum by [`harmonics`] of a normal is the light on a surface,
/// 1 under a white sky.
///
/// `texels` are `size` pixels in linear light, rows from the top: straight up to straight down. Columns go all the
/// way round; the one in the middle lies towards -z, as seen by a camera that looks at the front of a scene, with +x
/// right of it. O(pixels).
pub fn dome_of(size: [u32; 2], texels: &[[f32; 3]]) -> [[f32; 4]; 9] {
    use std::f64::consts::PI;
    let [width, height] = size.map(f64::from);
    let mut sums = [[0.0f64; 3]; 9];
    let mut whole = 0.0;
    for (row, pixels) in texels.chunks(size[0].max(1) as usize).enumerate() {
        let polar = (row as f64 + 0.5) / height * PI;
        let (sine, cosine) = (sin_f64(polar), cos_f64(polar));
        for (column, pixel) in pixels.iter().enumerate() {
            let turn = ((column as f64 + 0.5) / width - 0.5) * 2.0 * PI;
            let direction = [sine * sin_f64(turn), cosine, -sine * cos_f64(turn)];
            let values = harmonics(direction.map(|v| v as f32));
            whole += sine;
            for (sum, value) in sums.iter_mut().zip(values) {
                for (sum, light) in sum.iter_mut().zip(pixel) {
                    *sum += f64::from(*light) * f64::from(value) * sine;
                }
            }
        }
    }
    let whole = if whole > 0.0 { whole } else { 1.0 };
    std::array::from_fn(|i| {
        let [r, g, b] = sums[i].map(|sum| (sum / whole) as f32 * HARMONIC_WEIGHTS[i]);
        [r, g, b, 0.0]
    })
}

impl Lights {
    /// Light of the picture of the sky on a surface that faces along a unit vector.
    pub(crate) fn dome_at(&self, normal: [f32; 3]) -> [f32; 3] {
        let values = harmonics(normal);
        let mut sum = [0.0; 3];
        for (color, value) in self.dome.iter().zip(values) {
            sum = std::array::from_fn(|i| sum[i] + color[i] * value);
        }
        sum.map(|v| v.max(0.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::f64::consts::PI;

    fn lit(size: [u32; 2], texels: &[[f32; 3]], normal: [f32; 3]) -> [f32; 3] {
        let lights = Lights {
            dome: dome_of(size, texels),
            ..Lights::default()
        };
        lights.dome_at(normal)
    }

    #[test]
    fn a_white_sky_gives_all_its_light_everywhere() {
        let white = [[1.0; 3]; 64 * 32];
        for normal in [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.6, 0.0, -0.8]] {
            for light in lit([64, 32], &white, normal) {
                assert!((light - 1.0).abs() < 2e-3, "{normal:?}: {light}");
            }
        }
    }

    #[test]
    fn a_white_upper_half_is_the_two_colored_sky() {
        let texel = |i: usize| [if i < 64 * 16 { 1.0 } else { 0.0 }; 3];
        let half: Vec<[f32; 3]> = (0..64 * 32).map(texel).collect();
        for y in [-1.0, -0.6, 0.0, 0.28, 0.8, 1.0f32] {
            let [light, ..] = lit([64, 32], &half, [(1.0 - y * y).sqrt(), y, 0.0]);
            assert!((light - 0.5 * (1.0 + y)).abs() < 4e-3, "{y}: {light}");
        }
    }

    #[test]
    fn the_middle_of_the_picture_lies_ahead_and_its_right_on_the_right() {
        let light = |column: usize, normal| {
            let mut texels = [[0.0; 3]; 8 * 4];
            texels[8 + column] = [1.0; 3];
            texels[16 + column] = [1.0; 3];
            lit([8, 4], &texels, normal)[0]
        };
        let (ahead, right) = ([0.0, 0.0, -1.0], [1.0, 0.0, 0.0]);
        assert!(light(4, ahead) > 2.0 * light(4, right).max(light(4, [0.0, 0.0, 1.0])));
        assert!(light(6, right) > 2.0 * light(6, ahead).max(light(6, [-1.0, 0.0, 0.0])));
    }

    /// The mean light of the half that a surface faces, texel by texel.
    fn mean_light(size: [u32; 2], texels: &[[f32; 3]], normal: [f32; 3]) -> [f64; 2] {
        let [width, height] = size.map(|n| n as usize);
        let (mut sum, mut whole, mut all) = (0.0, 0.0, 0.0);
        for (i, texel) in texels.iter().enumerate() {
            let polar = ((i / width) as f64 + 0.5) / height as f64 * PI;
            let turn = (((i % width) as f64 + 0.5) / width as f64 - 0.5) * 2.0 * PI;
            let way = [
                polar.sin() * turn.sin(),
                polar.cos(),
                -polar.sin() * turn.cos(),
            ];
            let facing: f64 = way.iter().zip(normal).map(|(a, b)| a * f64::from(b)).sum();
            sum += 4.0 * facing.max(0.0) * f64::from(texel[0]) * polar.sin();
            all += f64::from(texel[0]) * polar.sin();
            whole += polar.sin();
        }
        [sum / whole, all / whole]
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(200))]
        /// Two orders of harmonics make of the cosine something at most 3/32 beside it.
        #[test]
        fn a_picture_lights_as_its_texels_do(
            lights in prop::collection::vec((0usize..16 * 8, 0f32..4.0), 1..6),
            normal in prop::array::uniform3(-1f32..1.0),
        ) {
            let normal = npr_core::surface::unit_or_z(normal);
            let mut texels = vec![[0.0; 3]; 16 * 8];
            for (at, light) in lights {
                texels[at] = [light; 3];
            }
            let [wanted, mean] = mean_light([16, 8], &texels, normal);
            let got = f64::from(lit([16, 8], &texels, normal)[0]);
            prop_assert!((got - wanted).abs() <= 4.0 * (3.0 / 32.0 + 1e-3) * mean, "{got} for {wanted}");
        }
    }
}
