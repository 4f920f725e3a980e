//! OKLab, in which a step of lightness looks the same in dark and light colours.

use npr_core::math;

/// Linear light as OKLab lightness, a and b [Ottosson 2020]: white is (1, 0, 0).
///
/// Written out although crates offer it: `lib/backdrop` does the same on devices, step by step, and the cube root must
/// have the same bits on every platform. Tests hold it against the crate `palette`.
pub fn oklab_of_light(light: [f32; 3]) -> [f32; 3] {
    let [r, g, b] = light;
    let l = cube_root(0.412_221_46 * r + 0.536_332_55 * g + 0.051_445_995 * b);
    let m = cube_root(0.211_903_5 * r + 0.680_699_5 * g + 0.107_396_96 * b);
    let s = cube_root(0.088_302_46 * r + 0.281_718_85 * g + 0.629_978_7 * b);
    [
        0.210_454_26 * l + 0.793_617_8 * m - 0.004_072_047 * s,
        1.977_998_5 * l - 2.428_592_2 * m + 0.450_593_7 * s,
        0.025_904_037 * l + 0.782_771_77 * m - 0.808_675_77 * s,
    ]
}

/// OKLab as linear light, which lies outside 0..1 where sRGB has no such colour.
pub fn light_of_oklab([lightness, a, b]: [f32; 3]) -> [f32; 3] {
    let l = lightness + 0.396_337_78 * a + 0.215_803_76 * b;
    let m = lightness - 0.105_561_346 * a - 0.063_854_17 * b;
    let s = lightness - 0.089_484_18 * a - 1.291_485_5 * b;
    let (l, m, s) = (l * l * l, m * m * m, s * s * s);
    [
        4.076_741_7 * l - 3.307_711_6 * m + 0.230_969_94 * s,
        -1.268_438 * l + 2.609_757_4 * m - 0.341_319_38 * s,
        -0.004_196_086 * l - 0.703_418_6 * m + 1.707_614_7 * s,
    ]
}

/// Cube root of a number that is not negative.
fn cube_root(x: f32) -> f32 {
    if x <= 0.0 {
        return 0.0;
    }
    math::cbrt(x)
}

#[cfg(test)]
mod tests {
    use super::*;
    use palette::{FromColor, LinSrgb, Oklab};
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        #[test]
        fn it_is_the_oklab_of_the_crate_palette(light in prop::array::uniform3(0f32..1.0)) {
            let [r, g, b] = light;
            let want = Oklab::from_color(LinSrgb::new(f64::from(r), f64::from(g), f64::from(b)));
            let [lightness, a, b] = oklab_of_light(light).map(f64::from);
            prop_assert!((lightness - want.l).abs() < 1e-5 && (a - want.a).abs() < 1e-5 && (b - want.b).abs() < 1e-5);
        }

        #[test]
        fn there_and_back_is_the_same_light(light in prop::array::uniform3(0f32..1.0)) {
            let back = light_of_oklab(oklab_of_light(light));
            prop_assert!((0..3).all(|i| (back[i] - light[i]).abs() < 1e-5), "{back:?}");
        }
    }
}
