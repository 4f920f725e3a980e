//! From PNG and JPEG bytes to pixels.
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::arithmetic_side_effects
)]

use std::io::Cursor;

use ::image::{DynamicImage, ImageDecoder, ImageReader, Limits};
use npr_core::decoding::guard;

use crate::image::Image;
use crate::limits::{Allowance, LimitError};

/// Why an image was not decoded.
#[derive(Debug)]
pub(crate) enum DecodeFault {
    /// It is broken or of another format; the scene does without it.
    Broken,
    /// It is larger than allowed; the scene is refused.
    TooLarge(LimitError),
}

/// The pixels of a PNG or JPEG file. Its size is checked before any pixel is decoded.
pub(crate) fn decode(
    name: &str,
    bytes: &[u8],
    allowance: &mut Allowance,
) -> Result<Image, DecodeFault> {
    let decoded = guard(|| {
        let mut reader = ImageReader::new(Cursor::new(bytes));
        reader.limits(decoder_limits(allowance));
        let reader = reader
            .with_guessed_format()
            .map_err(|_| DecodeFault::Broken)?;
        // A program around may have switched on more formats than scenes may hold.
        if !matches!(
            reader.format(),
            Some(::image::ImageFormat::Png | ::image::ImageFormat::Jpeg)
        ) {
            return Err(DecodeFault::Broken);
        }
        let decoder = reader.into_decoder().map_err(|_| DecodeFault::Broken)?;
        let (width, height) = decoder.dimensions();
        allowance
            .take_image(width, height)
            .map_err(DecodeFault::TooLarge)?;

        let pixels = DynamicImage::from_decoder(decoder).map_err(|_| DecodeFault::Broken)?;
        Ok(Image {
            name: name.to_owned(),
            width,
            height,
            rgba: pixels.into_rgba8().into_raw(),
        })
    });
    decoded.unwrap_or(Err(DecodeFault::Broken))
}

/// Bounds the decoder's own memory: four bytes a pixel grow to at most eight while decoding 16-bit
/// channels. The sides are left open, since [`Allowance::take_image`] gives the better message.
fn decoder_limits(allowance: &Allowance) -> Limits {
    let mut limits = Limits::no_limits();
    limits.max_alloc = Some(allowance.limits.image_bytes.saturating_mul(3));
    limits
}
