//! The sRGB transfer curve and packed 8-bit colours.
//!
//! Shading and blending happen on linear light; files and textures hold sRGB [IEC 61966-2-1].

use crate::math;

/// Linear light of an sRGB-encoded value, both 0..1.
pub fn linear_from_srgb(v: f32) -> f32 {
    if v <= 0.04045 { v / 12.92 } else { math::powf((v + 0.055) / 1.055, 2.4) }
}

/// The sRGB encoding of linear light, both 0..1; values outside are clamped.
pub fn srgb_from_linear(v: f32) -> f32 {
    let v = v.clamp(0.0, 1.0);
    if v <= 0.003_130_8 { v * 12.92 } else { 1.055 * math::powf(v, 1.0 / 2.4) - 0.055 }
}

/// Four values 0..1 as bytes, the first in the lowest byte, rounded to nearest.
pub fn pack_rgba8(rgba: [f32; 4]) -> u32 {
    let byte = |v: f32| (v.clamp(0.0, 1.0) * 255.0 + 0.5) as u32;
    byte(rgba[0]) | byte(rgba[1]) << 8 | byte(rgba[2]) << 16 | byte(rgba[3]) << 24
}

/// The four values 0..1 that [`pack_rgba8`] packed.
pub fn unpack_rgba8(packed: u32) -> [f32; 4] {
    packed.to_le_bytes().map(|byte| f32::from(byte) / 255.0)
}

/// An sRGB colour with straight alpha as linear light with straight alpha.
pub fn linear_rgba(srgb: [f32; 4]) -> [f32; 4] {
    [linear_from_srgb(srgb[0]), linear_from_srgb(srgb[1]), linear_from_srgb(srgb[2]), srgb[3]]
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
        fn packing_keeps_bytes(packed: u32) {
            prop_assert_eq!(pack_rgba8(unpack_rgba8(packed)), packed);
        }
    }
}
