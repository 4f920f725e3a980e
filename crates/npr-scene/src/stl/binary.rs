//! How large binary STL files are.
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::arithmetic_side_effects
)]

/// Bytes before the first triangle of a binary file: a comment and a count.
pub(super) const HEADER_BYTES: usize = 84;

/// Bytes of a triangle: normal, three corners, two bytes of attributes.
pub(super) const TRIANGLE_BYTES: usize = 50;

/// Whether `bytes` are as long as a binary header says.
pub(crate) fn is_binary(bytes: &[u8]) -> bool {
    let length = stated_count(bytes).and_then(|count| (count as usize).checked_mul(TRIANGLE_BYTES));
    length.and_then(|length| length.checked_add(HEADER_BYTES)) == Some(bytes.len())
}

pub(super) fn stated_count(bytes: &[u8]) -> Option<u32> {
    bytes
        .get(80..)?
        .first_chunk()
        .copied()
        .map(u32::from_le_bytes)
}
