//! A quick 128-bit digest that tells inputs apart; no protection against those who want them to meet.

/// Two independent lanes over words of 64 bits.
///
/// For a given word every step is a bijection of the lane, and for a given lane of the word: inputs of
/// one length that differ in a single word never meet, in either lane.
#[derive(Debug, Clone)]
pub struct ContentHash {
    lanes: [u64; 2],
}

impl Default for ContentHash {
    fn default() -> Self {
        Self::new()
    }
}

impl ContentHash {
    /// Of nothing so far.
    pub fn new() -> Self {
        Self {
            lanes: [0x243f_6a88_85a3_08d3, 0x1319_8a2e_0370_7344],
        }
    }

    fn word(&mut self, word: u64) {
        let [a, b] = self.lanes;
        let a = (a ^ word).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        let b = (b ^ word.rotate_left(32)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        self.lanes = [a ^ a >> 32, b ^ b >> 29];
    }

    /// Numbers, after how many they are.
    pub fn numbers(&mut self, numbers: &[u32]) {
        self.word(numbers.len() as u64);
        let (pairs, last) = numbers.as_chunks();
        pairs
            .iter()
            .for_each(|&[low, high]| self.word(u64::from(low) | u64::from(high) << 32));
        last.iter().for_each(|&number| self.word(u64::from(number)));
    }

    /// Positions bit by bit, after how many they are.
    pub fn positions(&mut self, positions: &[[f32; 3]]) {
        self.word(positions.len() as u64);
        for position in positions {
            let [x, y, z] = position.map(|v| u64::from(v.to_bits()));
            self.word(x | y << 32);
            self.word(z);
        }
    }

    /// Bytes, after how many they are.
    pub fn bytes(&mut self, bytes: &[u8]) {
        self.word(bytes.len() as u64);
        let (words, last) = bytes.as_chunks();
        words
            .iter()
            .for_each(|&word| self.word(u64::from_le_bytes(word)));
        let mut word = [0; 8];
        word[..last.len()].copy_from_slice(last);
        self.word(u64::from_le_bytes(word));
    }

    /// The digest of all that was fed.
    pub fn finish(mut self) -> u128 {
        // The last words have reached few bits yet.
        (0..3).for_each(|round| self.word(round));
        u128::from(self.lanes[1]) << 64 | u128::from(self.lanes[0])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn digest(bytes: &[u8]) -> u128 {
        let mut hash = ContentHash::new();
        hash.bytes(bytes);
        hash.finish()
    }

    proptest! {
        #[test]
        fn a_changed_bit_changes_both_lanes(
            mut bytes in prop::collection::vec(any::<u8>(), 1..100), at: prop::sample::Index, bit in 0u32..8,
        ) {
            let before = digest(&bytes);
            let at = at.index(bytes.len());
            bytes[at] ^= 1 << bit;
            let after = digest(&bytes);
            prop_assert!(before as u64 != after as u64 && before >> 64 != after >> 64);
        }

        #[test]
        fn zeros_at_the_end_count(mut bytes in prop::collection::vec(any::<u8>(), 0..40)) {
            let before = digest(&bytes);
            bytes.push(0);
            prop_assert_ne!(before, digest(&bytes));
        }
    }

    #[test]
    fn half_of_all_bits_change_with_one() {
        let flips: u32 = (0..64u32)
            .map(|bit| (digest(&(1u64 << bit).to_le_bytes()) ^ digest(&[0; 8])).count_ones())
            .sum();
        assert!((56..72).contains(&(flips / 64)), "{flips} of {}", 64 * 128);
    }

    /// Keys name files on disk, so a change of the digest must come with a new version.
    #[test]
    fn the_digest_stays_what_it_is() {
        assert_eq!(
            digest(b"line drawing"),
            0x82b4_b15b_6fe7_ad8a_7410_b071_1f98_dc99
        );
    }
}
