//! Pictures that a style names: backgrounds and width textures.

use crate::fault::{Exit, Fault};
use image::{DynamicImage, ImageDecoder, ImageReader};
use npr_render::Picture;
use npr_scene::{LimitError, Limits};
use std::io::Cursor;

/// The pixels of a PNG or JPEG file. Its size is checked before any pixel is decoded.
pub fn decode(bytes: &[u8], limits: &Limits) -> Result<Picture, Fault> {
    let broken = |error: image::ImageError| Fault::new(Exit::Input, error);
    let mut reader = ImageReader::new(Cursor::new(bytes)).with_guessed_format()?;
    reader.limits(decoder_limits(limits));
    let decoder = reader.into_decoder().map_err(broken)?;
    check_size(decoder.dimensions(), limits)?;
    let pixels = DynamicImage::from_decoder(decoder)
        .map_err(broken)?
        .into_rgba8();
    Ok(Picture {
        size: [pixels.width(), pixels.height()],
        rgba: pixels.into_raw(),
    })
}

fn check_size((width, height): (u32, u32), limits: &Limits) -> Result<(), Fault> {
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
mod tests {
    use super::*;
    use crate::encoder::png;

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
    fn text_is_no_picture() {
        let fault = decode(b"not a picture", &Limits::default()).expect_err("text");
        assert_eq!(fault.exit, Exit::Input);
    }
}
