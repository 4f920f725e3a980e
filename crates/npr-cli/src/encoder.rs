//! Encodes frames as PNG files.

use crate::fault::{Exit, Fault};
use png::{BitDepth, ColorType, Encoder, SrgbRenderingIntent};
use std::io::{self, Write};

/// A PNG file of sRGB bytes with straight alpha, row by row from the top.
///
/// Without `keep_alpha`, a picture that is opaque everywhere is stored as RGB. The same pixels give the
/// same bytes: there is no time stamp and no name of a program inside. O(pixels).
pub fn png(size: [u32; 2], rgba: &[u8], keep_alpha: bool) -> Result<Vec<u8>, Fault> {
    let is_opaque = || rgba.chunks_exact(4).all(|pixel| pixel[3] == 255);
    let color = if keep_alpha || !is_opaque() {
        ColorType::Rgba
    } else {
        ColorType::Rgb
    };
    let mut file = Vec::new();
    let encoded = encode(size, color, &mut file, |take| take(rgba));
    encoded
        .map_err(|error| Fault::new(Exit::Failed, format!("cannot encode the picture: {error}")))?;
    Ok(file)
}

/// Writes a PNG file from RGBA rows that `fill` hands over from the top, one or more whole rows at a time. Neither the
/// picture nor the file has to fit into memory. The bytes equal those of [`png`], however the rows are grouped.
pub fn encode(
    size: [u32; 2],
    color: ColorType,
    sink: &mut dyn Write,
    fill: impl FnOnce(&mut dyn FnMut(&[u8]) -> io::Result<()>) -> io::Result<()>,
) -> io::Result<()> {
    // Write the header: eight bits a channel, in sRGB.
    let mut encoder = Encoder::new(sink, size[0], size[1]);
    encoder.set_color(color);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_source_srgb(SrgbRenderingIntent::Perceptual);
    let mut writer = encoder.write_header()?;

    // Write rows as they are handed over.
    let mut rows = writer.stream_writer()?;
    fill(&mut |rgba| {
        for row in rgba.chunks_exact(size[0] as usize * 4) {
            match color {
                ColorType::Rgb => rows.write_all(&without_alpha(row))?,
                _ => rows.write_all(row)?,
            }
        }
        Ok(())
    })?;
    rows.finish()?;
    writer.finish()?;
    Ok(())
}

fn without_alpha(rgba: &[u8]) -> Vec<u8> {
    rgba.chunks_exact(4)
        .flat_map(|pixel| [pixel[0], pixel[1], pixel[2]])
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn color_type(file: &[u8]) -> u8 {
        file[25]
    }

    #[test]
    fn only_opaque_pictures_lose_their_alpha() {
        let opaque = [9, 9, 9, 255];
        let of = |rgba: &[u8], keep| color_type(&png([1, 1], rgba, keep).expect("one pixel"));
        assert_eq!(of(&opaque, false), ColorType::Rgb as u8);
        assert_eq!(of(&opaque, true), ColorType::Rgba as u8);
        assert_eq!(of(&[9, 9, 9, 254], false), ColorType::Rgba as u8);
    }

    #[test]
    fn the_file_says_srgb_and_no_time() {
        let file = png([1, 1], &[0; 4], true).expect("one pixel");
        let has = |chunk: &[u8]| file.windows(4).any(|window| window == chunk);
        assert!(has(b"sRGB") && !has(b"tIME") && !has(b"tEXt"));
    }
}
