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
    PngEncoder::new_with_quality(&mut bytes, CompressionType::Best, FilterType::Adaptive)
        .write_image(&frame.rgba, frame.size[0], frame.size[1], ExtendedColorType::Rgba8)?;
    #[allow(clippy::disallowed_methods, reason = "references and figures are for people who look at once")]
    std::fs::write(path, bytes)?;
    Ok(())
}

/// The picture in a PNG file; `None` where there is no readable one.
pub fn read_png(path: &Path) -> Option<Frame> {
    let image = image::open(path).ok()?.into_rgba8();
    Some(Frame {
        size: [image.width(), image.height()],
        rgba: image.into_raw(),
        times: Vec::new(),
    })
}
