//! Text in UTF-16, as some editors save it, and byte order marks.
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::arithmetic_side_effects
)]

use std::borrow::Cow;

use crate::limits::LimitError;
use crate::loading::Loading;

/// Most bytes of UTF-8 that a unit of UTF-16 becomes.
const UTF8_BYTES_PER_UNIT: usize = 3;

/// The text without a byte order mark. Text in UTF-16 is rewritten in UTF-8, with a notice.
///
/// Other encodings stay as they are: statements are ASCII in all of them, and only names may suffer.
pub(crate) fn utf8<'a>(
    bytes: &'a [u8],
    loading: &mut Loading,
) -> Result<Cow<'a, [u8]>, LimitError> {
    // Hand on text that is in ASCII or UTF-8.
    let Some(unit) = unit_of(bytes) else {
        let mark = b"\xef\xbb\xbf";
        return Ok(Cow::Borrowed(bytes.strip_prefix(mark).unwrap_or(bytes)));
    };

    // Rewrite text in UTF-16, and say so.
    let (pairs, _) = bytes.as_chunks::<2>();
    loading
        .allowance
        .take::<[u8; UTF8_BYTES_PER_UNIT]>("the text", pairs.len())?;
    loading
        .notices
        .add("the text is in UTF-16, where OBJ files are in ASCII or UTF-8");
    let units = pairs.iter().map(|&pair| unit(pair));
    let letters =
        char::decode_utf16(units).map(|letter| letter.unwrap_or(char::REPLACEMENT_CHARACTER));
    let text: String = letters.filter(|&letter| letter != '\u{feff}').collect();
    Ok(Cow::Owned(text.into_bytes()))
}

/// How two bytes make a unit, where the text is in UTF-16: by its mark, or by the zeros beside its first two letters.
fn unit_of(bytes: &[u8]) -> Option<fn([u8; 2]) -> u16> {
    match bytes {
        [0xff, 0xfe, ..] => Some(u16::from_le_bytes),
        [0xfe, 0xff, ..] => Some(u16::from_be_bytes),
        [1..=255, 0, 1..=255, 0, ..] => Some(u16::from_le_bytes),
        [0, 1..=255, 0, 1..=255, ..] => Some(u16::from_be_bytes),
        _ => None,
    }
}
