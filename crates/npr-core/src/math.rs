//! Scalar functions that give the same bits on every platform.
//!
//! The standard library hands transcendental functions to the system's math library, whose last bits
//! differ between platforms, and pictures of the CPU engine must not. These come from the crate `libm`.
//! Square roots, `floor`, `abs` and the four operations are exact in IEEE 754 and need no stand-in.

pub use libm::{
    acosf as acos, asinf as asin, atan2f as atan2, atanf as atan, cbrtf as cbrt, cosf as cos,
    exp2f as exp2, expf as exp, log2f as log2, logf as ln, powf, sinf as sin, tanf as tan,
};

/// The same in double precision, for curves.
pub use libm::{acos as acos_f64, atan2 as atan2_f64, cos as cos_f64, sin as sin_f64};

/// Tangent in double precision, the same on every platform.
pub fn tan_f64(x: f64) -> f64 {
    libm::tan(x)
}

/// A permutation of the 32-bit numbers that looks random [Wellons 2018, `lowbias32`].
pub fn mix_bits(number: u32) -> u32 {
    let mut x = number;
    x = (x ^ (x >> 16)).wrapping_mul(0x7feb_352d);
    x = (x ^ (x >> 15)).wrapping_mul(0x846c_a68b);
    x ^ (x >> 16)
}

/// Linear blend from `a` at `t = 0` to `b` at `t = 1`, exact at both ends for finite input.
#[inline]
pub fn mix(a: f32, b: f32, t: f32) -> f32 {
    a * (1.0 - t) + b * t
}

/// Smooth step from 0 at `from` to 1 at `to`, with zero slope at both ends; a hard step where they meet.
#[inline]
pub fn smoothstep(from: f32, to: f32, x: f32) -> f32 {
    if to <= from {
        return if x < from { 0.0 } else { 1.0 };
    }
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// A direction packed into two signed 16-bit numbers by octahedral mapping.
///
/// Its length does not matter. The error is under 4e-5 radians [Cigolle et al. 2014]. A zero or non-finite vector
/// packs as +z. Packed normals are also what both engines compare, so that rounding in the last bit of a float rarely
/// reaches a threshold.
pub fn pack_unit(v: [f32; 3]) -> u32 {
    let sum = v[0].abs() + v[1].abs() + v[2].abs();
    if !(sum > 0.0 && sum.is_finite()) {
        return 0;
    }
    let (mut x, mut y) = (v[0] / sum, v[1] / sum);
    if v[2] < 0.0 {
        let (fold_x, fold_y) = (1.0 - y.abs(), 1.0 - x.abs());
        x = if x < 0.0 { -fold_x } else { fold_x };
        y = if y < 0.0 { -fold_y } else { fold_y };
    }
    (snorm16(x) & 0xffff) | (snorm16(y) << 16)
}

/// The unit vector that [`pack_unit`] packed.
pub fn unpack_unit(packed: u32) -> [f32; 3] {
    let mut x = from_snorm16(packed << 16);
    let mut y = from_snorm16(packed);
    let z = 1.0 - x.abs() - y.abs();
    if z < 0.0 {
        let (fold_x, fold_y) = (1.0 - y.abs(), 1.0 - x.abs());
        x = if x < 0.0 { -fold_x } else { fold_x };
        y = if y < 0.0 { -fold_y } else { fold_y };
    }
    let length = (x * x + y * y + z * z).sqrt();
    [x / length, y / length, z / length]
}

/// Two shares, 0..1, in one word, the first in the low half; the error is under 8e-6. What is no share counts as the
/// nearest, and NaN as 0.
pub fn pack_shares(shares: [f32; 2]) -> u32 {
    let [low, high] = shares.map(|share| (share.clamp(0.0, 1.0) * 65535.0 + 0.5) as u32);
    low | high << 16
}

/// The shares that [`pack_shares`] packed.
pub fn unpack_shares(packed: u32) -> [f32; 2] {
    [packed & 0xffff, packed >> 16].map(|bits| bits as f32 / 65535.0)
}

/// Rounds `v` in -1..1 to a signed 16-bit step, halves away from zero's left, as the shaders do.
fn snorm16(v: f32) -> u32 {
    (v * 32767.0 + 0.5).floor() as i32 as u32
}

/// Reads the upper 16 bits of `bits` as a signed step.
fn from_snorm16(bits: u32) -> f32 {
    ((bits as i32) >> 16) as f32 / 32767.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn packing_a_unit_vector_keeps_its_direction(
            x in -1.0f32..1.0, y in -1.0f32..1.0, z in -1.0f32..1.0,
        ) {
            let length = (x * x + y * y + z * z).sqrt();
            prop_assume!(length > 1e-3);
            let unit = [x / length, y / length, z / length];
            let back = unpack_unit(pack_unit(unit));
            let error = (0..3).map(|i| (unit[i] - back[i]).powi(2)).sum::<f32>().sqrt();
            prop_assert!(error < 1e-4, "{unit:?} came back as {back:?}");
        }

        #[test]
        fn smoothstep_stays_in_range_and_never_falls(
            from in -2.0f32..2.0, to in -2.0f32..2.0, x in -3.0f32..3.0, dx in 0.0f32..1.0,
        ) {
            let (a, b) = (smoothstep(from, to, x), smoothstep(from, to, x + dx));
            prop_assert!((0.0..=1.0).contains(&a));
            prop_assert!(b >= a - 1e-6);
        }
    }

    #[test]
    fn shares_come_back_from_one_word() {
        for (low, high) in [(0.0, 1.0), (1.0, 0.0), (0.25, 0.7), (1.0, 1.0)] {
            let back = unpack_shares(pack_shares([low, high]));
            assert!(
                (back[0] - low).abs() < 8e-6 && (back[1] - high).abs() < 8e-6,
                "{back:?}"
            );
        }
        assert_eq!(unpack_shares(pack_shares([-3.0, 7.0])), [0.0, 1.0]);
        assert_eq!(unpack_shares(pack_shares([f32::NAN, 0.0])), [0.0, 0.0]);
    }

    #[test]
    fn packing_survives_what_is_no_direction() {
        assert_eq!(pack_unit([0.0; 3]), 0);
        assert_eq!(pack_unit([f32::NAN, 0.0, 1.0]), 0);
        assert_eq!(unpack_unit(0), [0.0, 0.0, 1.0]);
    }

    #[test]
    fn mix_is_exact_at_both_ends() {
        assert_eq!(mix(0.1, 0.7, 0.0), 0.1);
        assert_eq!(mix(0.1, 0.7, 1.0), 0.7);
    }
}
