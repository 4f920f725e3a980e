//! Bytes packed by zlib.

use miniz_oxide::inflate::decompress_slice_iter_to_slice;
use npr_core::decoding::guard;

/// Why a chunk is refused that does not give as many bytes as its values take.
pub(crate) const WRONG_SIZE: &str = "its size is not that of its values";

/// Unpacks a zlib stream [RFC 1950] that must fill `bytes` exactly.
pub(crate) fn inflate(packed: &[u8], bytes: &mut [u8]) -> Result<(), &'static str> {
    let length = bytes.len();
    let packed = std::iter::once(packed);
    match guard(|| decompress_slice_iter_to_slice(bytes, packed, true, false)) {
        Ok(Ok(written)) if written == length => Ok(()),
        Ok(Ok(_)) => Err(WRONG_SIZE),
        Ok(Err(_)) | Err(_) => Err("its zlib stream is broken"),
    }
}
