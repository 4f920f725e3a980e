//! Words and numbers of text formats.
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::arithmetic_side_effects
)]

/// The words of a line, split at spaces and tabs.
pub(crate) fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    line.split(u8::is_ascii_whitespace)
        .filter(|word| !word.is_empty())
}

/// The number that `word` spells; one too large for the type is infinite.
pub(crate) fn number(word: &[u8]) -> Option<f32> {
    str::from_utf8(word).ok()?.parse().ok()
}

/// The next three numbers of `words`.
pub(crate) fn triple<'a>(words: &mut impl Iterator<Item = &'a [u8]>) -> Option<[f32; 3]> {
    Some([
        number(words.next()?)?,
        number(words.next()?)?,
        number(words.next()?)?,
    ])
}

/// Lines with their numbers, counted from 1.
pub(crate) fn numbered_lines(text: &[u8]) -> impl Iterator<Item = (usize, &[u8])> {
    (1..).zip(text.split(|&byte| byte == b'\n'))
}
