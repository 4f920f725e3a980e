//! BloscLZ, blosc's own codec: runs of new bytes, and repeats of bytes some distance back.
//!
//! The first control byte opens a run of new bytes whatever its upper three bits say. From then on, below 32 it is
//! one less than the length of such a run; else its upper three bits are the length of a repeat and its lower five
//! the upper bits of its distance.

/// Distances above this are stored in 16 bits of their own.
const NEAR: usize = 8191;

/// Unpacks into the beginning of `bytes`; how many bytes it filled, or nothing where the stream makes no sense.
pub(super) fn unpack(packed: &[u8], bytes: &mut [u8]) -> Option<usize> {
    let mut packed = packed.iter().copied();
    let mut filled = 0usize;
    let mut control = packed.next().map(|byte| byte & 31);
    while let Some(byte) = control {
        let control_bits = usize::from(byte);

        // Copy a run of new bytes, or repeat a run that was unpacked before.
        filled = if byte < 32 {
            let end = filled.checked_add(control_bits)?.checked_add(1)?;
            for new in bytes.get_mut(filled..end)? {
                *new = packed.next()?;
            }
            end
        } else {
            let (length, distance) = repeat(control_bits, &mut packed)?;
            let end = filled.checked_add(length)?;
            let start = filled.checked_sub(distance)?;
            copy_forward(bytes.get_mut(start..end)?, distance);
            end
        };
        control = packed.next();
    }
    Some(filled)
}

/// Length and distance of a repeat.
fn repeat(control: usize, packed: &mut impl Iterator<Item = u8>) -> Option<(usize, usize)> {
    let mut length = (control >> 5).checked_add(2)?;
    let high = (control & 31) << 8;
    // The longest of the short lengths says that more of it follows.
    if control >> 5 == 7 {
        loop {
            let more = packed.next()?;
            length = length.checked_add(more.into())?;
            if more != 255 {
                break;
            }
        }
    }
    let low = usize::from(packed.next()?);
    if high | low != NEAR {
        return Some((length, (high | low).checked_add(1)?));
    }
    let far = usize::from(packed.next()?) << 8 | usize::from(packed.next()?);
    Some((length, far.checked_add(NEAR)?.checked_add(1)?))
}

/// Fills what lies behind the first `distance` bytes by repeating them, in the order that lets a repeat overlap itself.
fn copy_forward(bytes: &mut [u8], distance: usize) {
    let length = bytes.len();
    let mut known = distance;
    while known < length {
        let (source, target) = bytes.split_at_mut(known);
        let copied = source.len().min(target.len());
        if let (Some(source), Some(target)) = (source.get(..copied), target.get_mut(..copied)) {
            target.copy_from_slice(source);
        }
        known = known.saturating_add(copied.max(1));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_repeat_may_overlap_itself() {
        let mut bytes = [0; 8];
        // One new byte, then six bytes from one back, then a new one.
        let packed = [0, b'a', 4 << 5, 0, 0, b'b'];
        assert_eq!(unpack(&packed, &mut bytes), Some(8));
        assert_eq!(&bytes, b"aaaaaaab");
    }

    #[test]
    fn distances_before_the_beginning_are_refused() {
        assert_eq!(unpack(&[0, b'a', 32, 1], &mut [0; 8]), None);
        assert_eq!(unpack(&[0, b'a', 32], &mut [0; 8]), None);
        assert_eq!(unpack(&[31, b'a'], &mut [0; 40]), None);
        assert_eq!(unpack(&[0, b'a', 32, 0], &mut [0; 3]), None);
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 1000, ..ProptestConfig::default() })]

        #[test]
        fn a_forward_copy_is_one_byte_after_another(
            mut bytes in prop::collection::vec(any::<u8>(), 1..200), distance in 1usize..60,
        ) {
            let distance = distance.min(bytes.len());
            let mut wanted = bytes.clone();
            for at in distance..wanted.len() {
                wanted[at] = wanted[at - distance];
            }
            copy_forward(&mut bytes, distance);
            prop_assert_eq!(bytes, wanted);
        }

        #[test]
        fn any_bytes_end_in_a_length_or_nothing(
            packed in prop::collection::vec(any::<u8>(), 0..100), length in 0usize..400,
        ) {
            let filled = unpack(&packed, &mut vec![0; length]);
            prop_assert!(filled.is_none_or(|filled| filled <= length));
        }
    }
}
