//! The light of a picture of the sky, summed up in nine colours.

use npr_core::math::{cos_f64, sin_f64};

/// The nine polynomials of a unit vector in which a picture of the sky is summed up: spherical harmonics up to the
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

/// Weights of [`harmonics`] with which their sum is the mean of the sky's light over the half that a surface faces, by
/// how squarely it faces each part [Ramamoorthi and Hanrahan 2001, equations 10 and 13].
const HARMONIC_WEIGHTS: [f32; 9] = [1.0, 2.0, 2.0, 2.0, 3.75, 3.75, 3.75, 0.312_5, 0.937_5];

/// Sums up a picture of the whole sky in nine colours; their sum, weighted by the [`harmonics`] of a normal, is the
/// light on a surface, 1 under a white sky.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lighting::Lights;
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
