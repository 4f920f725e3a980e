//! Pictures as files.

use npr_render::Frame;
use std::path::Path;

/// Writes a picture as PNG, packed as tightly as the encoder can.
///
/// # Errors
///
/// Where the file cannot be written.
pub fn write_png(path: &Path, frame: &Frame) -> Result<(), image::ImageError> {
    use image::codecs::png::{CompressionType, FilterType, PngEncoder};
    use image::{ExtendedColorType, ImageEncoder};
    let mut bytes = Vec::new();
    let encoder =
        PngEncoder::new_with_quality(&mut bytes, CompressionType::Best, FilterType::Adaptive);
    let [width, height] = frame.size;
    if frame.rgba.chunks_exact(4).all(|pixel| pixel[3] == 255) {
        let opaque = frame
            .rgba
            .chunks_exact(4)
            .flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]);
        let opaque: Vec<u8> = opaque.collect();
        encoder.write_image(&opaque, width, height, ExtendedColorType::Rgb8)?;
    } else {
        encoder.write_image(&frame.rgba, width, height, ExtendedColorType::Rgba8)?;
    }
    #[allow(
        clippy::disallowed_methods,
        reason = "references and figures are for people who look at once"
    )]
    std::fs::write(path, bytes)?;
    Ok(())
}

/// The picture in a PNG file; `None` where there is no readable one.
pub fn read_png(path: &Path) -> Option<Frame> {
    let image = image::open(path).ok()?.into_rgba8();
    Some(Frame {
        size: [image.width(), image.height()],
        rgba: image.into_raw(),
        ..Frame::default()
    })
}
