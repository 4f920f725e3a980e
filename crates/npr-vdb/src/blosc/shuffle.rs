//! Bytes or bits of equal rank lie together; here they go back to their elements.

/// Puts the bytes of elements together again; both slices have one length.
///
/// `shuffled` holds the first bytes of all whole elements, then the second ones, and so on; what is no whole element
/// comes last, as it is.
pub(super) fn unshuffle_bytes(shuffled: &[u8], element_bytes: usize, bytes: &mut [u8]) {
    let count = bytes.len().checked_div(element_bytes).unwrap_or_default();
    let whole = count.saturating_mul(element_bytes);
    copy_from(whole, shuffled, bytes);
    let planes = shuffled.chunks_exact(count.max(1)).take(element_bytes);
    for (rank, plane) in planes.enumerate() {
        let places = bytes
            .iter_mut()
            .take(whole)
            .skip(rank)
            .step_by(element_bytes);
        places.zip(plane).for_each(|(byte, &value)| *byte = value);
    }
}

/// Puts the bits of elements together again; both slices have one length.
///
/// `shuffled` holds the lowest bit of the first byte of all whole elements, eight elements a byte, then the next
/// bits, and so on. Blosc leaves blocks as they are whose number of elements is no multiple of eight.
pub(super) fn unshuffle_bits(shuffled: &[u8], element_bytes: usize, bytes: &mut [u8]) {
    // Copy what was not shuffled: odd blocks, and what lies behind whole elements.
    let count = bytes.len().checked_div(element_bytes).unwrap_or_default();
    if !count.is_multiple_of(8) || count == 0 {
        copy_from(0, shuffled, bytes);
        return;
    }
    let whole = count.saturating_mul(element_bytes);
    copy_from(whole, shuffled, bytes);
    for byte in bytes.iter_mut().take(whole) {
        *byte = 0;
    }

    // Gather each element's bits from the planes that hold one of every element.
    let planes = shuffled
        .chunks_exact(count >> 3)
        .take(element_bytes.saturating_mul(8));
    for (rank, plane) in planes.enumerate() {
        let places = bytes
            .iter_mut()
            .take(whole)
            .skip(rank >> 3)
            .step_by(element_bytes);
        for (element, byte) in places.enumerate() {
            let group = plane.get(element >> 3).copied().unwrap_or_default();
            *byte |= (group >> (element & 7) & 1) << (rank & 7);
        }
    }
}

/// Copies everything from `start` on.
fn copy_from(start: usize, source: &[u8], target: &mut [u8]) {
    let pairs = target.iter_mut().zip(source).skip(start);
    pairs.for_each(|(byte, &value)| *byte = value);
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn shuffle_bytes(bytes: &[u8], element_bytes: usize) -> Vec<u8> {
        let count = bytes.len() / element_bytes;
        let ranks =
            (0..element_bytes).flat_map(|rank| (0..count).map(move |element| (element, rank)));
        let sorted = ranks.map(|(element, rank)| bytes[element * element_bytes + rank]);
        sorted
            .chain(bytes[count * element_bytes..].iter().copied())
            .collect()
    }

    fn shuffle_bits(bytes: &[u8], element_bytes: usize) -> Vec<u8> {
        let count = bytes.len() / element_bytes;
        if !count.is_multiple_of(8) {
            return bytes.to_vec();
        }
        let mut shuffled = bytes.to_vec();
        shuffled[..count * element_bytes].fill(0);
        for place in 0..count * element_bytes * 8 {
            let (rank, element) = (place / count, place % count);
            let bit = bytes[element * element_bytes + rank / 8] >> (rank % 8) & 1;
            shuffled[place / 8] |= bit << (place % 8);
        }
        shuffled
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 1000, ..ProptestConfig::default() })]

        #[test]
        fn shuffled_bytes_and_bits_come_back(
            bytes in prop::collection::vec(any::<u8>(), 0..300), element_bytes in 1usize..20,
        ) {
            let mut back = vec![0xaa; bytes.len()];
            unshuffle_bytes(&shuffle_bytes(&bytes, element_bytes), element_bytes, &mut back);
            prop_assert_eq!(&back, &bytes);
            let mut back = vec![0xaa; bytes.len()];
            unshuffle_bits(&shuffle_bits(&bytes, element_bytes), element_bytes, &mut back);
            prop_assert_eq!(&back, &bytes);
        }
    }
}
