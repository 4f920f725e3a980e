//! Decodes the pictures that a style names, and bitmaps to trace or outline.

use crate::broken_image::{broken, stopped};
use crate::colors::reduce;
use crate::fault::{Exit, Fault};
use crate::input::regular_file;
use image::{DynamicImage, ImageDecoder, ImageError, ImageFormat, ImageReader};
use npr_core::budget::Budget;
use npr_core::decoding::guard;
use npr_render::Picture;
use npr_scene::{LimitError, Limits};
use npr_trace::{Bitmap, IndexPicture};
use std::io::{Cursor, Read, Seek, SeekFrom};
use std::path::Path;

/// Formats of pictures that are traced or outlined.
const BITMAPS: [ImageFormat; 6] = [
    ImageFormat::Png,
    ImageFormat::Jpeg,
    ImageFormat::WebP,
    ImageFormat::Pnm,
    ImageFormat::Tiff,
    ImageFormat::Bmp,
];

/// Longest header, in bytes, of a binary PBM file that is read without holding its bytes.
const HEAD_BYTES: u64 = 256;

/// Memory for a pixel, in bytes: up to eight as it is decoded and four as it is used.
const PIXEL_BYTES: usize = 12;

/// Further memory for a pixel, in bytes, while a picture is reduced to few colours or cut into layers.
const COLOUR_BYTES: usize = 16;

/// The pixels of a PNG or JPEG file. Its size is checked before any pixel is decoded.
pub fn decode(bytes: &[u8], limits: &Limits) -> Result<Picture, Fault> {
    decode_as(bytes, limits, &[ImageFormat::Png, ImageFormat::Jpeg])
}

/// The pixels of an image file in any of the formats `BITMAPS`. Its size is checked before any pixel is decoded.
pub fn decode_any(bytes: &[u8], limits: &Limits) -> Result<Picture, Fault> {
    decode_as(bytes, limits, &BITMAPS)
}

fn decode_as(bytes: &[u8], limits: &Limits, formats: &[ImageFormat]) -> Result<Picture, Fault> {
    let pixels = image(bytes, limits, formats, PIXEL_BYTES)?.into_rgba8();
    Ok(Picture {
        size: [pixels.width(), pixels.height()],
        rgba: pixels.into_raw(),
    })
}

/// An image file in any of the formats `BITMAPS` as a bitmap. Pixels up to the brightness `black_level`, 0 to 1, are
/// black.
///
/// The memory planned for its pixels must stay within the limit.
pub fn decode_bitmap(bytes: &[u8], limits: &Limits, black_level: f64) -> Result<Bitmap, Fault> {
    if let Some((size, packed)) = packed_rows(bytes) {
        check_size(size, limits)?;
        let bitmap = Bitmap::from_packed(size.0, size.1, packed);
        return bitmap.map_err(|error| Fault::new(Exit::Input, error));
    }
    let image = image(bytes, limits, &BITMAPS, PIXEL_BYTES)?;
    let (width, height) = (image.width(), image.height());
    let bitmap = match image {
        DynamicImage::ImageLuma8(grey) => {
            Bitmap::from_luminance(width, height, grey.as_raw(), black_level)
        }
        other => Bitmap::from_rgba(width, height, other.into_rgba8().as_raw(), black_level),
    };
    bitmap.map_err(|error| Fault::new(Exit::Input, error))
}

/// The pixels of an image file in any of the formats `BITMAPS`, in at most `most` colours.
///
/// The memory planned for its pixels, and for the layers made of them, must stay within the limit.
pub fn decode_colors(bytes: &[u8], limits: &Limits, most: u16) -> Result<IndexPicture, Fault> {
    let pixels = image(bytes, limits, &BITMAPS, PIXEL_BYTES + COLOUR_BYTES)?.into_rgba8();
    reduce([pixels.width(), pixels.height()], pixels.as_raw(), most)
}

/// The pixels of a binary PBM file, read without holding its bytes. `None` for any other file, and for one that is too
/// long or broken.
pub fn read_packed(path: &Path, limits: &Limits) -> Result<Option<Bitmap>, Fault> {
    let (mut file, length) = regular_file(path)?;
    if length > limits.file_bytes {
        return Ok(None);
    }
    let mut head = Vec::new();
    (&mut file).take(HEAD_BYTES).read_to_end(&mut head)?;
    let Some(head) = packed_head(&head).filter(|head| head.end().is_some_and(|end| end <= length))
    else {
        return Ok(None);
    };
    check_size(head.size, limits)?;
    let (width, height) = head.size;
    let mut bitmap = Bitmap::new(width, height).map_err(|error| Fault::new(Exit::Input, error))?;
    file.seek(SeekFrom::Start(head.length))?;
    bitmap.read_packed(file)?;
    Ok(Some(bitmap))
}

/// Size and rows of a valid binary PBM file, whose rows of eight pixels a byte need no decoding.
fn packed_rows(bytes: &[u8]) -> Option<((u32, u32), &[u8])> {
    let head = packed_head(bytes)?;
    let rows = bytes.get(head.length as usize..head.end()? as usize)?;
    Some((head.size, rows))
}

/// The header of a binary PBM file, which has eight pixels a byte.
struct PackedHead {
    size: (u32, u32),
    /// Length of the header, in bytes.
    length: u64,
}

impl PackedHead {
    /// Length of header and rows, in bytes; `None` where there are no rows, or where the number overflows.
    fn end(&self) -> Option<u64> {
        let row = u64::from(self.size.0.div_ceil(8));
        let rows = row.checked_mul(u64::from(self.size.1))?;
        (rows > 0).then(|| self.length.checked_add(rows))?
    }
}

fn packed_head(bytes: &[u8]) -> Option<PackedHead> {
    let mut rest = bytes.strip_prefix(b"P4")?;
    let mut sides = [0u32; 2];
    for side in &mut sides {
        // A file with comments fails here, and goes to the general decoder.
        rest = rest.trim_ascii_start();
        let digits = rest.iter().take_while(|byte| byte.is_ascii_digit()).count();
        *side = std::str::from_utf8(rest.get(..digits)?)
            .ok()?
            .parse()
            .ok()?;
        rest = rest.get(digits..)?;
    }
    let (_, rows) = rest
        .split_first()
        .filter(|(byte, _)| byte.is_ascii_whitespace())?;
    Some(PackedHead {
        size: (sides[0], sides[1]),
        length: (bytes.len() - rows.len()) as u64,
    })
}

/// Decodes an image file in one of `formats`. Its size, and `pixel_bytes` of memory for every pixel, are checked
/// before any pixel is decoded.
fn image(
    bytes: &[u8],
    limits: &Limits,
    formats: &[ImageFormat],
    pixel_bytes: usize,
) -> Result<DynamicImage, Fault> {
    // Determine the format, and refuse those that are not among `formats`.
    let mut format = None;
    let decoded = guard(|| {
        let mut reader = ImageReader::new(Cursor::new(bytes)).with_guessed_format()?;
        format = reader.format();
        if format.is_some_and(|format| !formats.contains(&format)) {
            return Err(Fault::new(
                Exit::Input,
                "this is none of the image formats that are read",
            ));
        }

        // Check the size before any pixel is decoded.
        let bounds = decoder_limits(limits);
        let most_bytes = bounds.max_alloc.unwrap_or(u64::MAX);
        let broken = |error: ImageError| broken(&error, format, most_bytes);
        reader.limits(bounds);
        let decoder = reader.into_decoder().map_err(broken)?;
        check_plan(decoder.dimensions(), limits, pixel_bytes)?;
        DynamicImage::from_decoder(decoder).map_err(broken)
    });
    decoded.unwrap_or_else(|_| Err(stopped(format)))
}

/// Refuses an image without pixels, and one beyond the limits.
fn check_plan(size: (u32, u32), limits: &Limits, pixel_bytes: usize) -> Result<(), Fault> {
    let (width, height) = size;
    if width == 0 || height == 0 {
        return Err(Fault::new(Exit::Input, "the image has no pixels"));
    }
    check_size(size, limits)?;
    let pixels = width as usize * height as usize;
    let planned = Budget::new(limits.memory_bytes).take("the image", pixels, pixel_bytes);
    planned.map_err(|error| Fault::from(npr_render::RenderError::from(error)))
}

fn check_size((width, height): (u32, u32), limits: &Limits) -> Result<(), Fault> {
    // Measure the picture by its side and by its bytes.
    let side = u64::from(width.max(height));
    let bytes = u64::from(width) * u64::from(height) * 4;
    let checks = [
        (
            "image side in pixels",
            side,
            u64::from(limits.image_side_px),
            "--max-image-side",
        ),
        (
            "image size in bytes",
            bytes,
            limits.image_bytes,
            "--max-image",
        ),
    ];

    // Refuse it where a limit is exceeded, and name the option that lifts it.
    for (what, value, limit, option) in checks {
        if value > limit {
            let what = what.to_owned();
            return Err(Fault::new(
                Exit::Limit,
                LimitError {
                    what,
                    value,
                    limit,
                    option,
                },
            ));
        }
    }
    Ok(())
}

/// Bounds the decoder's own memory: four bytes a pixel grow to at most eight while decoding 16-bit
/// channels, beside the result.
fn decoder_limits(limits: &Limits) -> image::Limits {
    let mut bounds = image::Limits::no_limits();
    bounds.max_alloc = Some(limits.image_bytes.saturating_mul(3));
    bounds
}

#[cfg(test)]
mod mutants;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::encoder::png;
    use crate::output::Output;

    #[test]
    fn what_is_encoded_is_decoded_again() {
        let rgba = vec![1, 2, 3, 255, 40, 50, 60, 128];
        let bytes = png([2, 1], &rgba, true).expect("a small picture");
        assert_eq!(
            decode(&bytes, &Limits::default()),
            Ok(Picture { size: [2, 1], rgba })
        );
    }

    #[test]
    fn a_picture_beyond_the_limit_is_refused_by_its_header() {
        let bytes = png([3, 1], &[0; 12], true).expect("a small picture");
        let limits = Limits {
            image_side_px: 2,
            ..Limits::default()
        };
        assert_eq!(
            decode(&bytes, &limits).map_err(|fault| fault.exit),
            Err(Exit::Limit)
        );
    }

    #[test]
    fn packed_bitmaps_are_read_as_they_are() {
        let (size, rows) = packed_rows(b"P4 9\n2\n\x80\x80\x00\x00rest").expect("sound");
        assert_eq!((size, rows), ((9, 2), &[0x80, 0x80, 0, 0][..]));
        for other in [
            &b"P4 9 2 \x80"[..],
            b"P4 # 9\n9 2\n1234",
            b"P4 0 0\n",
            b"P4",
            b"P1 1 1 1",
            b"P4 9 2",
        ] {
            assert_eq!(packed_rows(other), None);
        }
    }

    #[test]
    fn packed_files_are_read_as_their_bytes_are_decoded() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("rows.pbm");
        let limits = Limits::default();
        let read = |bytes: &[u8], limits: &Limits| {
            let output = Output::of(&path);
            output
                .and_then(|output| output.write(bytes))
                .expect("written");
            read_packed(&path, limits)
        };
        let file = b"P4 9\n2\n\x80\x80\x00\x00rest";
        let bitmap = decode_bitmap(file, &limits, 0.5).expect("sound");
        assert!(bitmap.is_ink(8, 0));
        assert_eq!(read(file, &limits), Ok(Some(bitmap)));
        // Other files go to the general decoder, which reports what is wrong with them.
        for other in [
            &file[..10],
            b"P4 # 9\n9 2\n1234",
            b"P4 0 0\n",
            b"",
            b"P1 1 1 1",
        ] {
            assert_eq!(read(other, &limits), Ok(None));
        }
        let small = Limits {
            file_bytes: 14,
            ..limits
        };
        assert_eq!(read(file, &small), Ok(None));
        let narrow = Limits {
            image_side_px: 8,
            ..limits
        };
        assert_eq!(
            read(file, &narrow).map_err(|fault| fault.exit),
            Err(Exit::Limit)
        );
    }

    #[test]
    fn text_is_no_picture() {
        let fault = decode(b"not a picture", &Limits::default()).expect_err("text");
        assert_eq!(fault.exit, Exit::Input);
    }
}
