//! Reduces pictures to few colours, for tracing.

use crate::fault::{Exit, Fault};
use npr_trace::IndexPicture;
use palette::Srgb;
use quantette::{ImageRef, PaletteSize, Pipeline};
use std::collections::BTreeMap;

/// The picture in at most `most` colours. It keeps its own colours where there are no more; else the method of
/// [Wu 1991] chooses colours in OKLab, without dither.
///
/// `rgba` has straight alpha. A pixel less than half opaque becomes transparent; the others count as opaque. 16 bytes
/// a pixel, O(pixels).
pub fn reduce(size: [u32; 2], rgba: &[u8], most: u16) -> Result<IndexPicture, Fault> {
    let [width, height] = size;
    let (pixels, _) = rgba.as_chunks::<4>();
    let opaque: Vec<[u8; 3]> = pixels.iter().filter_map(opaque_color).collect();
    let (palette, numbers) = match own_colors(&opaque, usize::from(most)) {
        Some(own) => own,
        None => found_colors(&opaque, most)?,
    };
    drop(opaque);
    let mut numbers = numbers.into_iter();
    let index = |pixel: &[u8; 4]| match opaque_color(pixel) {
        Some(_) => numbers.next().map_or(IndexPicture::NONE, u16::from),
        None => IndexPicture::NONE,
    };
    let indices = pixels.iter().map(index).collect();
    let picture = IndexPicture::new(width, height, palette, indices);
    picture.map_err(|error| Fault::new(Exit::Input, error))
}

/// The colour of a pixel that is at least half opaque; `None` for others.
fn opaque_color(&[r, g, b, a]: &[u8; 4]) -> Option<[u8; 3]> {
    (a >= 128).then_some([r, g, b])
}

/// A palette, and for every pixel the index of its colour there.
type Numbered = (Vec<[u8; 3]>, Vec<u8>);

/// The palette of all colours that occur, sorted; `None` where there are more than `most`, which is at most 256.
fn own_colors(pixels: &[[u8; 3]], most: usize) -> Option<Numbered> {
    let mut numbers = BTreeMap::new();
    for run in pixels.chunk_by(|a, b| a == b) {
        numbers.insert(run[0], 0u8);
        if numbers.len() > most {
            return None;
        }
    }
    for (number, to) in (0u8..=u8::MAX).zip(numbers.values_mut()) {
        *to = number;
    }
    let number = |run: &[[u8; 3]]| vec![numbers.get(&run[0]).copied().unwrap_or(0); run.len()];
    let numbered = pixels.chunk_by(|a, b| a == b).flat_map(number).collect();
    Some((numbers.into_keys().collect(), numbered))
}

/// A palette of at most `most` colours by the method of [Wu 1991]. A pixel gets the colour of its part of the colour
/// space.
pub fn found_colors(pixels: &[[u8; 3]], most: u16) -> Result<Numbered, Fault> {
    let broken = |error: &dyn std::fmt::Display| Fault::new(Exit::Failed, error);
    let size = PaletteSize::try_from(most).map_err(|error| broken(&error))?;
    let pixels = palette::cast::from_array_slice::<Srgb<u8>>(pixels);
    let count = pixels.len() as u32;
    let image = ImageRef::new(count, 1, pixels).map_err(|error| broken(&error))?;
    // Counting equal pixels first takes less memory than colours of three floats for each.
    let pipeline = Pipeline::new().palette_size(size).ditherer(None);
    let indexed = pipeline.dedup(true).input_image(image);
    let (palette, numbers) = indexed.output_srgb8_indexed_image().into_parts();
    let bytes = |color: Srgb<u8>| [color.red, color.green, color.blue];
    Ok((palette.into_iter().map(bytes).collect(), numbers))
}
