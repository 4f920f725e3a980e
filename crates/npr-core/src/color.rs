//! The sRGB transfer curve and packed 8-bit colours.
//!
//! Shading and blending happen on linear light; files and textures hold sRGB [IEC 61966-2-1].

use crate::math;
use std::sync::LazyLock;

/// Linear light of an sRGB-encoded value, both 0..1.
pub fn linear_from_srgb(v: f32) -> f32 {
    if v <= 0.04045 {
        v / 12.92
    } else {
        math::powf((v + 0.055) / 1.055, 2.4)
    }
}

/// Linear light of an sRGB byte: [`linear_from_srgb`] by table.
#[inline]
pub fn linear_from_byte(byte: u8) -> f32 {
    static LIGHT: LazyLock<[f32; 256]> =
        LazyLock::new(|| std::array::from_fn(|byte| linear_from_srgb(byte as f32 / 255.0)));
    LIGHT[usize::from(byte)]
}

/// The sRGB encoding of linear light, both 0..1; values outside are clamped.
pub fn srgb_from_linear(v: f32) -> f32 {
    let v = v.clamp(0.0, 1.0);
    if v <= 0.003_130_8 {
        v * 12.92
    } else {
        1.055 * math::powf(v, 1.0 / 2.4) - 0.055
    }
}

/// Linear light to sRGB bytes by table: the byte nearest to [`srgb_from_linear`], without its cost.
#[derive(Debug, Clone)]
pub struct SrgbEncoder {
    /// Light from which each byte is the nearest; the entry past the last byte is out of reach.
    starts: [f32; 257],
    /// The byte at the start of each of equal steps of light.
    guesses: [u8; Self::STEPS + 1],
}

impl SrgbEncoder {
    /// Steps of the table of first guesses.
    const STEPS: usize = 1024;

    /// The tables; about a microsecond per hundred entries.
    pub fn new() -> Self {
        let mut starts = [f32::MAX; 257];
        for (byte, start) in starts[..256].iter_mut().enumerate() {
            *start = linear_from_srgb((byte as f32 - 0.5) / 255.0);
        }
        let mut guesses = [0; Self::STEPS + 1];
        for (step, guess) in guesses.iter_mut().enumerate() {
            let light = step as f32 / Self::STEPS as f32;
            *guess = starts[1..256].partition_point(|start| *start <= light) as u8;
        }
        Self { starts, guesses }
    }

    /// The byte of a light; values outside 0..1 are clamped, NaN is 0.
    #[inline]
    pub fn byte(&self, light: f32) -> u32 {
        let light = light.clamp(0.0, 1.0);
        let mut byte = usize::from(self.guesses[(light * Self::STEPS as f32) as usize]);
        while light >= self.starts[byte + 1] {
            byte += 1;
        }
        byte as u32
    }
}

impl Default for SrgbEncoder {
    fn default() -> Self {
        Self::new()
    }
}

/// Four values 0..1 as bytes, the first in the lowest byte, rounded to nearest.
#[inline]
pub fn pack_rgba8(rgba: [f32; 4]) -> u32 {
    let byte = |v: f32| (v.clamp(0.0, 1.0) * 255.0 + 0.5) as u32;
    byte(rgba[0]) | byte(rgba[1]) << 8 | byte(rgba[2]) << 16 | byte(rgba[3]) << 24
}

/// The four values 0..1 that [`pack_rgba8`] packed.
#[inline]
pub fn unpack_rgba8(packed: u32) -> [f32; 4] {
    packed.to_le_bytes().map(|byte| f32::from(byte) / 255.0)
}

/// An sRGB colour with straight alpha as linear light with straight alpha.
pub fn linear_rgba(srgb: [f32; 4]) -> [f32; 4] {
    [
        linear_from_srgb(srgb[0]),
        linear_from_srgb(srgb[1]),
        linear_from_srgb(srgb[2]),
        srgb[3],
    ]
}

/// Linear light, premultiplied with alpha, of sRGB bytes with straight alpha.
pub fn premultiplied_light([r, g, b, a]: [u8; 4]) -> [f32; 4] {
    let alpha = f32::from(a) / 255.0;
    let [r, g, b] = [r, g, b].map(|byte| linear_from_byte(byte) * alpha);
    [r, g, b, alpha]
}

/// The largest difference of a channel of two colours.
pub fn largest_difference(a: [f32; 3], b: [f32; 3]) -> f32 {
    (a[0] - b[0])
        .abs()
        .max((a[1] - b[1]).abs())
        .max((a[2] - b[2]).abs())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn every_byte_survives_the_way_to_linear_and_back() {
        for byte in 0..=255u32 {
            let encoded = byte as f32 / 255.0;
            let back = pack_rgba8([srgb_from_linear(linear_from_srgb(encoded)), 0.0, 0.0, 0.0]);
            assert_eq!(back, byte);
        }
    }

    #[test]
    fn known_points_of_the_curve() {
        assert!((linear_from_srgb(0.5) - 0.214_041).abs() < 1e-5);
        assert!((srgb_from_linear(0.18) - 0.461_356).abs() < 1e-5);
        assert!((srgb_from_linear(7.0) - 1.0).abs() < 1e-6);
    }

    proptest! {
        #[test]
        fn the_encoder_gives_the_nearest_byte(light in -0.1f32..1.1) {
            let want = srgb_from_linear(light) * 255.0;
            let got = SrgbEncoder::new().byte(light) as f32;
            prop_assert!((got - want).abs() < 0.502, "{got} for {want}");
        }

        #[test]
        fn packing_keeps_bytes(packed: u32) {
            prop_assert_eq!(pack_rgba8(unpack_rgba8(packed)), packed);
        }
    }
}
