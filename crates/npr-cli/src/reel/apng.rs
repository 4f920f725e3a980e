//! Films as animated PNG files, without loss.

use super::{Pixels, Whole};
use crate::fault::Fault;
use png::{BitDepth, ColorType, Encoder, SrgbRenderingIntent};
use std::io::{BufWriter, Write};

/// Writes a film that plays for ever. Every frame is whole and has an alpha channel. A frame is held at a time.
pub fn write(film: &Whole<'_>, frames: Pixels<'_>) -> Result<(), Fault> {
    film.output.write_with(|sink| {
        // Write the header: eight bits a channel, in sRGB.
        let mut sink = BufWriter::new(sink);
        let [width, height] = film.size;
        let mut encoder = Encoder::new(&mut sink, width, height);
        encoder.set_color(ColorType::Rgba);
        encoder.set_depth(BitDepth::Eight);
        encoder.set_source_srgb(SrgbRenderingIntent::Perceptual);
        encoder.set_animated(film.count, 0)?;
        let (numerator, denominator) = delay(film.fps);
        encoder.set_frame_delay(numerator, denominator)?;
        let mut writer = encoder.write_header()?;

        // Write the frames.
        let mut count = 0;
        for rgba in frames {
            writer.write_image_data(&rgba)?;
            count += 1;
        }
        film.check_whole(count)?;
        writer.finish()?;
        sink.flush()
    })
}

/// The seconds that a frame lasts, as a fraction: to a thousandth of the rate where that fits.
fn delay(fps: f32) -> (u16, u16) {
    let scales = [1_u16, 10, 100, 1000];
    let exact = |scale: &&u16| (fps * f32::from(**scale)).fract() == 0.0;
    let fits = |scale: &&u16| fps * f32::from(**scale) <= f32::from(u16::MAX);
    let scale = scales.iter().find(exact).filter(fits);
    let scale = *scale.or(scales.iter().rfind(fits)).unwrap_or(&1);
    (scale, (fps * f32::from(scale)).round() as u16)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rates_become_fractions() {
        assert_eq!(delay(24.0), (1, 24));
        assert_eq!(delay(12.5), (10, 125));
        assert_eq!(delay(23.976), (1000, 23976));
        assert_eq!(delay(999.3), (10, 9993));
    }
}
