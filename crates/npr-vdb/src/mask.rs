//! One bit for every place of a node.

/// One bit for every place of a node, as the file stores them: the lowest bit of the first byte comes first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Mask<'a>(pub(crate) &'a [u8]);

impl<'a> Mask<'a> {
    /// Whether the bit of `place` is set.
    pub(crate) fn is_on(self, place: usize) -> bool {
        let byte = self.0.get(place >> 3).copied().unwrap_or_default();
        byte >> (place & 7) & 1 == 1
    }

    /// How many bits are set.
    pub(crate) fn count_on(self) -> usize {
        self.0.iter().map(|byte| byte.count_ones() as usize).sum()
    }

    /// How many bits there are.
    pub(crate) fn len(self) -> usize {
        self.0.len().saturating_mul(8)
    }

    /// The places of set bits, ascending.
    pub(crate) fn places(self) -> impl Iterator<Item = usize> + Clone + 'a {
        let bytes = self.0.iter().enumerate().filter(|&(_, &byte)| byte != 0);
        bytes.flat_map(|(index, &byte)| {
            let bits = (0..8usize).filter(move |bit| byte >> bit & 1 == 1);
            bits.map(move |bit| index << 3 | bit)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig { cases: 1000, ..ProptestConfig::default() })]

        #[test]
        fn places_are_the_set_bits(bytes in prop::collection::vec(any::<u8>(), 0..40)) {
            let mask = Mask(&bytes);
            let set: Vec<_> = (0..mask.len()).filter(|&place| bytes[place / 8] & (1 << (place % 8)) != 0).collect();
            prop_assert_eq!(mask.places().collect::<Vec<_>>(), set.clone());
            prop_assert_eq!(mask.count_on(), set.len());
            prop_assert!((0..mask.len() + 9).all(|place| mask.is_on(place) == set.contains(&place)));
        }
    }
}
