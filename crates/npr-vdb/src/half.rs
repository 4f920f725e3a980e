//! Half floats.

/// The value of a half float [IEEE 754-2019, binary16], exactly.
pub(crate) fn f32_from_half(bits: u16) -> f32 {
    let sign = u32::from(bits & 0x8000) << 16;
    let exponent = u32::from(bits >> 10 & 0x1f);
    let fraction = u32::from(bits & 0x3ff);
    let magnitude = match exponent {
        // Steps of 2^-24, which a float holds exactly.
        0 => (fraction as f32 * f32::from_bits(0x3380_0000)).to_bits(),
        31 => 0x7f80_0000 | fraction << 13,
        _ => (exponent + 112) << 23 | fraction << 13,
    };
    f32::from_bits(sign | magnitude)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The definition of the standard, in double precision.
    fn by_definition(bits: u16) -> f64 {
        let sign = if bits >> 15 == 1 { -1.0 } else { 1.0 };
        let fraction = f64::from(bits & 0x3ff) / 1024.0;
        match i32::from(bits >> 10 & 0x1f) {
            31 if fraction > 0.0 => f64::NAN,
            31 => sign * f64::INFINITY,
            0 => sign * fraction * 2f64.powi(-14),
            exponent => sign * (1.0 + fraction) * 2f64.powi(exponent - 15),
        }
    }

    #[test]
    fn every_half_float_is_what_the_standard_says() {
        for bits in 0..=u16::MAX {
            let (value, wanted) = (f64::from(f32_from_half(bits)), by_definition(bits));
            let same = value == wanted && value.is_sign_negative() == wanted.is_sign_negative();
            assert!(same || value.is_nan() && wanted.is_nan(), "{bits:#06x}");
        }
    }
}
