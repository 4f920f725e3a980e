//! The messages about image files that cannot be decoded.

use crate::fault::{Exit, Fault};
use image::error::{LimitErrorKind, UnsupportedErrorKind};
use image::{ImageError, ImageFormat};
use std::error::Error;
use std::io::ErrorKind;

/// How decoders print the type of a PNG chunk: after this text come the name and the properties of the type, up to a
/// closing brace.
const CHUNK: &str = "ChunkType { type: ";

/// Longest word in mixed case, in characters, that counts as a name from a file format, such as WebP or tRNS. A longer
/// one counts as the name of a Rust type.
const NAME_LENGTH: usize = 6;

/// The fault for an image file that a decoder refused. `most_bytes` is the memory that decoding was allowed.
pub fn broken(error: &ImageError, format: Option<ImageFormat>, most_bytes: u64) -> Fault {
    let name = format.map_or("image", name_of);
    let damage = |text: String| match plain(&text) {
        Some(detail) => format!("the {name} data are broken: {detail}"),
        None => format!("the {name} data are broken"),
    };
    let message = match error {
        ImageError::Limits(limit) if matches!(limit.kind(), LimitErrorKind::InsufficientMemory) => {
            let message =
                format!("decoding it takes more than {most_bytes} bytes, which --max-image lifts");
            return Fault::new(Exit::Limit, message);
        }
        ImageError::Unsupported(error) => match error.kind() {
            UnsupportedErrorKind::GenericFeature(feature) => match plain(&feature) {
                Some(detail) => format!("this sort of {name} data is not read: {detail}"),
                None => format!("this sort of {name} data is not read"),
            },
            UnsupportedErrorKind::Format(_) => {
                "this is none of the image formats that are read".to_owned()
            }
            _ => format!("this sort of {name} data is not read"),
        },
        ImageError::IoError(error) if error.kind() == ErrorKind::UnexpectedEof => {
            "the file ends too early".to_owned()
        }
        // The outer message only adds the format, which is named already.
        error => damage(
            error
                .source()
                .map_or_else(|| error.to_string(), ToString::to_string),
        ),
    };
    Fault::new(Exit::Input, message)
}

/// The fault for an image file whose decoder panicked.
pub fn stopped(format: Option<ImageFormat>) -> Fault {
    let name = format.map_or("image", name_of);
    Fault::new(Exit::Input, format!("the {name} data are broken"))
}

fn name_of(format: ImageFormat) -> &'static str {
    match format {
        ImageFormat::Png => "PNG",
        ImageFormat::Jpeg => "JPEG",
        ImageFormat::WebP => "WebP",
        ImageFormat::Pnm => "PNM",
        ImageFormat::Tiff => "TIFF",
        ImageFormat::Bmp => "BMP",
        _ => "image",
    }
}

/// The sentences of a decoder's message that users can read, joined on one line; `None` where there are none.
fn plain(text: &str) -> Option<String> {
    let text = without_chunk_types(text);
    let words: Vec<&str> = text.split_whitespace().collect();
    let text = words.join(" ");
    let sentences = text
        .split(". ")
        .map(|sentence| sentence.trim_matches(['"', '.', ' ']))
        .filter(|sentence| !sentence.is_empty() && is_plain(sentence));
    let kept: Vec<String> = sentences.map(begun_small).collect();
    (!kept.is_empty()).then(|| kept.join(", "))
}

/// The text with every printed chunk type reduced to its name.
fn without_chunk_types(text: &str) -> String {
    let mut pieces = text.split(CHUNK);
    let mut whole = pieces.next().unwrap_or_default().to_owned();
    for piece in pieces {
        match (piece.split_once(", "), piece.split_once(" }")) {
            (Some((name, _)), Some((_, rest))) => {
                whole.push_str(name);
                whole.push_str(rest);
            }
            _ => whole.push_str(piece),
        }
    }
    whole
}

/// Whether a sentence is free of debug output and of names of Rust types.
fn is_plain(sentence: &str) -> bool {
    let is_type = |word: &str| {
        let letters: Vec<char> = word.chars().collect();
        letters.len() > NAME_LENGTH
            && letters
                .windows(2)
                .any(|pair| pair[0].is_ascii_lowercase() && pair[1].is_ascii_uppercase())
    };
    let is_readable = |letter: char| letter.is_ascii() && !"{}[]\\".contains(letter);
    sentence.chars().all(is_readable)
        && !sentence.contains("::")
        && !sentence.split_whitespace().any(is_type)
}

/// The sentence with a small first letter, to follow a colon. A word such as CRC keeps its capitals.
fn begun_small(sentence: &str) -> String {
    let mut letters = sentence.chars();
    match (letters.next(), letters.next()) {
        (Some(first), Some(second)) if second.is_ascii_lowercase() => {
            let rest: String = sentence.chars().skip(1).collect();
            format!("{}{rest}", first.to_ascii_lowercase())
        }
        _ => sentence.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_decoders_say_is_said_in_plain_words() {
        let reported = |text: &str| plain(text).unwrap_or_default();
        assert_eq!(
            reported(
                "CRC error: expected 0x28 have 0xc4 while decoding \
                 ChunkType { type: IHDR, critical: true, private: false } chunk"
            ),
            "CRC error: expected 0x28 have 0xc4 while decoding IHDR chunk"
        );
        assert_eq!(
            reported("Corrupt deflate stream. BadCodeLengthHuffmanTree"),
            "corrupt deflate stream"
        );
        assert_eq!(
            reported("Unknown filter method 95."),
            "unknown filter method 95"
        );
        assert_eq!(
            reported("\"Premature End\nof image\""),
            "premature End of image"
        );
        for text in [
            "Invalid Chunk header: [56, 50]",
            "ChunkType { type: \\u{1a}\\n, critical: true } comes first",
            "",
        ] {
            assert_eq!(plain(text), None, "{text}");
        }
    }

    #[test]
    fn a_decoder_short_of_memory_hit_a_limit() {
        let error = ImageError::Limits(image::error::LimitError::from_kind(
            LimitErrorKind::InsufficientMemory,
        ));
        let fault = broken(&error, Some(ImageFormat::Tiff), 77);
        assert_eq!(fault.exit, Exit::Limit);
        assert!(fault.message.contains("77 bytes, which --max-image lifts"));
    }
}
