//! Numbers that look random, by hash: the same for the same question, whoever asks first.

use crate::math::mix_bits;

/// A well mixed number from three, each stirred in by [`mix_bits`].
pub fn hash(seed: u32, a: u32, b: u32) -> u32 {
    let mixed = mix_bits(mix_bits(seed ^ 0x9e37_79b9).wrapping_add(a));
    mix_bits(mixed.wrapping_add(b.wrapping_mul(0x85eb_ca6b)))
}

/// A hash as a number of 0..1, 1 left out.
pub fn unit(hash: u32) -> f32 {
    (hash >> 8) as f32 / (1 << 24) as f32
}

/// A hash as a number of -1..1.
pub fn signed(hash: u32) -> f32 {
    2.0 * unit(hash) - 1.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hashes_fill_the_range_evenly() {
        let mut counts = [0u32; 16];
        for i in 0..16_000 {
            counts[(unit(hash(3, i, 7)) * 16.0) as usize] += 1;
        }
        assert!(
            counts.iter().all(|&n| (850..1150).contains(&n)),
            "{counts:?}"
        );
    }
}
