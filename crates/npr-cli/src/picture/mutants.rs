//! Damaged pictures of every format are read or refused, whatever their decoders do.

use super::{decode, decode_bitmap, decode_colors};
use crate::fault::{Exit, Fault};
use image::{DynamicImage, ImageFormat};
use npr_scene::Limits;
use proptest::prelude::*;
use std::io::Cursor;
use std::sync::OnceLock;

/// A change that damages a file.
#[derive(Debug, Clone)]
enum Damage {
    /// A byte becomes another one; half of the time one of the first hundred, where headers are.
    Set(usize, u8),
    Flip(usize, u8),
    Cut(usize),
    Repeat(usize, usize),
    Remove(usize, usize),
}

fn damage() -> impl Strategy<Value = Damage> {
    let place = prop_oneof![any::<usize>(), 0usize..100];
    prop_oneof![
        4 => (place.clone(), any::<u8>()).prop_map(|(at, byte)| Damage::Set(at, byte)),
        4 => (place.clone(), 0u8..8).prop_map(|(at, bit)| Damage::Flip(at, bit)),
        1 => any::<usize>().prop_map(Damage::Cut),
        1 => (place.clone(), 1usize..20).prop_map(|(at, count)| Damage::Repeat(at, count)),
        1 => (place, 1usize..20).prop_map(|(at, count)| Damage::Remove(at, count)),
    ]
}

impl Damage {
    fn apply(&self, file: &mut Vec<u8>) {
        if file.is_empty() {
            return;
        }
        let length = file.len();
        let piece = |at: usize, count: usize| at % length..length.min(at % length + count);
        match *self {
            Self::Set(at, byte) => file[at % length] = byte,
            Self::Flip(at, bit) => file[at % length] ^= 1 << bit,
            Self::Cut(at) => file.truncate(at % length),
            Self::Repeat(at, count) => {
                let again = file[piece(at, count)].to_vec();
                file.splice(at % length..at % length, again);
            }
            Self::Remove(at, count) => drop(file.drain(piece(at, count))),
        }
    }
}

/// A small picture with soft edges, in every format that is read and every sort of pixel that it has.
fn files(format: ImageFormat) -> Vec<Vec<u8>> {
    // Draw soft edges in grey and in colour.
    let grey = image::GrayImage::from_fn(13, 9, |x, y| image::Luma([(x * 19 + y * 7) as u8]));
    let grey = DynamicImage::ImageLuma8(grey);
    let color = image::RgbaImage::from_fn(13, 9, |x, y| {
        image::Rgba([
            (x * 19) as u8,
            (y * 28) as u8,
            (x * y) as u8,
            (255 - x * 9) as u8,
        ])
    });
    let color = DynamicImage::ImageRgba8(color);

    // Encode them in every sort of pixel that the format has.
    let pictures = [
        grey.clone(),
        DynamicImage::ImageRgb8(color.to_rgb8()),
        DynamicImage::ImageLuma16(grey.to_luma16()),
        color,
    ];
    let mut files: Vec<Vec<u8>> = pictures
        .iter()
        .filter_map(|picture| {
            let mut file = Cursor::new(Vec::new());
            picture.write_to(&mut file, format).ok()?;
            Some(file.into_inner())
        })
        .collect();

    // Add the sorts that are not encoded here.
    match format {
        ImageFormat::Png => files.push(PALETTE_PNG.to_vec()),
        ImageFormat::Pnm => files.extend([
            b"P1\n3 2\n0 1 0 1 0 1\n".to_vec(),
            b"P2\n3 2\n9\n0 1 2 3 4 5\n".to_vec(),
            b"P3\n2 1\n9\n0 1 2 3 4 5\n".to_vec(),
            b"P4 # drawn\n9 2\n\x80\x80\x00\x00".to_vec(),
            b"P7\nWIDTH 2\nHEIGHT 1\nDEPTH 2\nMAXVAL 255\nTUPLTYPE GRAYSCALE_ALPHA\nENDHDR\n1234"
                .to_vec(),
        ]),
        _ => {}
    }
    files
}

/// A PNG file of one pixel, with a palette of one colour.
const PALETTE_PNG: &[u8] =
    b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\x01\0\0\0\x01\x08\x03\0\0\0\x28\xcb\x34\xbb\
    \0\0\0\x03PLTE\0\0\0\xa7\x7a\x3d\xda\
    \0\0\0\x0aIDATx\x9cc\x60\0\0\0\x02\0\x01\x48\xaf\xa4\x71\0\0\0\0IEND\xae\x42\x60\x82";

/// A PNG file with a palette of five bytes, where every colour takes three: its decoder panics.
const SHORT_PALETTE_PNG: &[u8] = include_bytes!("../../tests/data/palette_of_5_bytes.png");

/// The file with correct check sums for all PNG chunks. Otherwise decoders refuse every change for its check sum
/// alone.
fn with_sums(mut file: Vec<u8>) -> Vec<u8> {
    let mut at = 8;
    while let Some(length) = file.get(at..at + 4) {
        let length = u32::from_be_bytes([length[0], length[1], length[2], length[3]]) as usize;
        let end = at.saturating_add(8).saturating_add(length);
        let (Some(chunk), true) = (file.get(at + 4..end), end + 4 <= file.len()) else {
            break;
        };
        let sum = crc32(chunk).to_be_bytes();
        file[end..end + 4].copy_from_slice(&sum);
        at = end + 4;
    }
    file
}

/// The check sum of [ISO 3309], bit by bit.
fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0, |sum, byte| {
        (0..8).fold(sum ^ u32::from(*byte), |sum, _| {
            (sum >> 1) ^ (0xedb8_8320 & 0u32.wrapping_sub(sum & 1))
        })
    })
}

/// Decodes a file in every way. It may be refused only as broken input or by a limit, in plain words.
fn survives(file: &[u8], limits: &Limits) -> Result<(), TestCaseError> {
    let refused = [
        decode(file, limits).err(),
        decode_bitmap(file, limits, 0.5).err(),
        decode_colors(file, limits, 4).err(),
    ];
    for Fault { exit, message } in refused.into_iter().flatten() {
        prop_assert!(
            matches!(exit, Exit::Input | Exit::Limit),
            "{:?} {}",
            exit,
            message
        );
        prop_assert!(
            !message.contains("::") && !message.contains(['{', '[']),
            "{}",
            message
        );
        prop_assert!(
            message.chars().count() < 200 && !message.contains('\n'),
            "{}",
            message
        );
    }
    Ok(())
}

fn check(
    format: ImageFormat,
    files: &[Vec<u8>],
    which: usize,
    damages: &[Damage],
    sums: bool,
) -> Result<(), TestCaseError> {
    let mut file = files[which % files.len()].clone();
    damages.iter().for_each(|damage| damage.apply(&mut file));
    if sums && format == ImageFormat::Png {
        file = with_sums(file);
    }
    let limits = Limits {
        image_bytes: 1 << 16,
        memory_bytes: 1 << 22,
        ..Limits::default()
    };
    survives(&file, &limits)
}

/// Declares one test for each format. `PROPTEST_CASES` raises the number of mutants.
macro_rules! mutants_of {
    ($($name:ident: $format:ident,)*) => {
        proptest! {
            #![proptest_config(ProptestConfig {
                cases: ProptestConfig::default().cases.max(1000),
                max_shrink_iters: 200,
                ..ProptestConfig::default()
            })]
            $(
                #[test]
                fn $name(
                    which in any::<usize>(), damages in prop::collection::vec(damage(), 1..4), sums in any::<bool>(),
                ) {
                    static FILES: OnceLock<Vec<Vec<u8>>> = OnceLock::new();
                    let files = FILES.get_or_init(|| files(ImageFormat::$format));
                    check(ImageFormat::$format, files, which, &damages, sums)?;
                }
            )*
        }
    };
}

mutants_of! {
    damaged_png_files: Png,
    damaged_jpeg_files: Jpeg,
    damaged_webp_files: WebP,
    damaged_pnm_files: Pnm,
    damaged_tiff_files: Tiff,
    damaged_bmp_files: Bmp,
}

#[test]
fn sums_of_sound_files_are_found_again() {
    for file in [PALETTE_PNG, SHORT_PALETTE_PNG] {
        assert_eq!(with_sums(file.to_vec()), file);
    }
}

#[test]
fn a_palette_of_five_bytes_is_broken() {
    assert!(decode(PALETTE_PNG, &Limits::default()).is_ok());
    let bitmap = decode_bitmap(SHORT_PALETTE_PNG, &Limits::default(), 0.5).map(|_| ());
    let picture = decode(SHORT_PALETTE_PNG, &Limits::default()).map(|_| ());
    for refused in [bitmap, picture] {
        assert_eq!(
            refused,
            Err(Fault::new(Exit::Input, "the PNG data are broken"))
        );
    }
}
