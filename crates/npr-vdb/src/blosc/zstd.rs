//! Zstandard streams [RFC 8878].

use std::io::Read;

use npr_core::decoding::guard;
use ruzstd::decoding::StreamingDecoder;

use crate::cursor::Cursor;

/// Largest window in bytes, for which the decoder keeps memory.
///
/// The largest chunk is a node of 32768 vectors of doubles, 768 KiB, and no encoder asks for more than the next power
/// of two.
const MOST_WINDOW_BYTES: u64 = 1 << 20;

/// Unpacks a frame that must fill `bytes` exactly.
pub(super) fn unpack(packed: &[u8], bytes: &mut [u8]) -> Result<(), &'static str> {
    const BROKEN: &str = "its zstd stream is broken";
    let window = window_bytes(packed).ok_or(BROKEN)?;
    if window > MOST_WINDOW_BYTES {
        return Err("its zstd stream asks for too much memory");
    }
    let unpacked = guard(|| {
        let mut decoder = StreamingDecoder::new(packed).map_err(|_| BROKEN)?;
        decoder.read_exact(bytes).map_err(|_| BROKEN)?;
        match decoder.read(&mut [0]) {
            Ok(0) => Ok(()),
            _ => Err(BROKEN),
        }
    });
    unpacked.unwrap_or(Err(BROKEN))
}

/// Bytes that the frame's header asks a decoder to keep; nothing if it makes no sense.
fn window_bytes(packed: &[u8]) -> Option<u64> {
    let mut cursor = Cursor::new(packed);
    if cursor.u32("").ok()? != 0xfd2f_b528 {
        return None;
    }
    let descriptor = cursor.byte("").ok()?;
    let keeps_all = descriptor & 0x20 != 0;
    if !keeps_all {
        let window = cursor.byte("").ok()?;
        let base = 1u64.checked_shl(u32::from(window >> 3).saturating_add(10))?;
        let eighths = (base >> 3).saturating_mul(u64::from(window & 7));
        return Some(base.saturating_add(eighths));
    }
    // A dictionary's number stands before the size.
    let skipped = [0, 1, 2, 4].get(usize::from(descriptor & 3)).copied()?;
    cursor.take(skipped, "").ok()?;
    Some(match descriptor >> 6 {
        0 => cursor.byte("").ok()?.into(),
        1 => u64::from(u16::from_le_bytes(cursor.array("").ok()?)).saturating_add(256),
        2 => cursor.u32("").ok()?.into(),
        _ => u64::from_le_bytes(cursor.array("").ok()?),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use ruzstd::encoding::{CompressionLevel, compress_to_vec};

    #[test]
    fn a_frame_must_give_as_many_bytes_as_asked() {
        let bytes: Vec<u8> = (0..5000).map(|k| (k / 100) as u8).collect();
        let packed = compress_to_vec(bytes.as_slice(), CompressionLevel::Fastest);
        let mut back = vec![0; bytes.len()];
        assert_eq!(unpack(&packed, &mut back), Ok(()));
        assert!(back == bytes);
        assert!(unpack(&packed, &mut vec![0; 4999]).is_err());
        assert!(unpack(&packed, &mut vec![0; 5001]).is_err());
        assert!(unpack(&packed[..packed.len() - 1], &mut back).is_err());
    }

    #[test]
    fn a_forged_window_is_refused_before_memory_is_taken() {
        let window = [0x28, 0xb5, 0x2f, 0xfd, 0x00, 0xa0, 1, 0, 0];
        assert_eq!(window_bytes(&window), Some(1 << 30));
        let size = [
            0x28, 0xb5, 0x2f, 0xfd, 0xe0, 255, 255, 255, 255, 255, 255, 255, 255,
        ];
        assert_eq!(window_bytes(&size), Some(u64::MAX));
        for frame in [&window[..], &size] {
            assert_eq!(
                unpack(frame, &mut [0; 10]),
                Err("its zstd stream asks for too much memory")
            );
        }
        assert_eq!(window_bytes(&[0x28, 0xb5]), None);
    }
}
