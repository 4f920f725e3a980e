//! Tones from a picture: any row of pixels, hard or soft, as a ramp [Suzuki 2004, section 3.2]. The twin of
//! `lib/tone_row`.
//!
//! The picture is read once. Passes read a row of [`ROW_LENGTH`] tones in the texture store, so a tone costs one
//! look-up whatever the picture holds.

use bytemuck::{Pod, Zeroable};
use npr_core::color::linear_from_byte;
use npr_core::math;

/// Number of tones in a row: steps lie within 1/2048 of their place in the picture.
pub const ROW_LENGTH: usize = 1024;

/// Most pixels of a picture along a side.
pub const ROW_PICTURE_MAX: u32 = 4096;

/// Words of a tone in the texture store.
const TONE_WORDS: usize = 4;

/// One tone of a row.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct RowTone {
    /// Factor on linear light: red, green and blue.
    pub light: [f32; 3],
    /// The last place of the row up to which all tones from here on are the same.
    pub same_until: u32,
}

/// Why a picture cannot be a ramp.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum RowError {
    /// It has no pixels, too many, or stands upright.
    #[error(
        "a ramp runs from left to right in a picture 1 to 4096 pixels wide and not higher than wide, \
         not {width} x {height}"
    )]
    Size {
        /// Pixels per row.
        width: u32,
        /// Rows.
        height: u32,
    },
    /// Pixels are missing or left over.
    #[error("a ramp picture of {width} x {height} has {byte_count} bytes of pixels")]
    ByteCount {
        /// Pixels per row.
        width: u32,
        /// Rows.
        height: u32,
        /// Bytes that were given, four to a pixel.
        byte_count: usize,
    },
}

/// The tones of a picture's middle row; its left end faces away from the light, its right end towards it.
///
/// Pixels are sRGB bytes with alpha, row by row; each is decoded to linear light and is what the surface's linear
/// light is multiplied by, so white leaves colours as they are. Alpha is not looked at. With `softness` 0 a place has
/// the tone of the pixel under it, so steps stay hard. Else steps are as soft as those of
/// [`ramp_light`](crate::ramp::ramp_light): they blend over that part of the ramp, 0..0.5. The row goes on beyond its
/// ends. O(places * pixels) at worst.
///
/// # Errors
///
/// [`RowError`] for a picture without pixels, of more than [`ROW_PICTURE_MAX`] a side, higher than wide, or with
/// other than four bytes to a pixel.
pub fn tone_row(size: [u32; 2], rgba: &[u8], softness: f32) -> Result<Vec<RowTone>, RowError> {
    check(size, rgba)?;
    let [width, height] = size.map(|side| side as usize);
    let row = &rgba[height / 2 * width * 4..][..width * 4];
    let pixels: Vec<[f32; 3]> = row.chunks_exact(4).map(linear).collect();
    let light = |place: usize| {
        let x = (place as f32 + 0.5) / ROW_LENGTH as f32;
        if softness > 0.0 {
            softened(&pixels, softness, x)
        } else {
            // The pixel that the middle of the place lies in.
            pixels[(2 * place + 1) * width / (2 * ROW_LENGTH)]
        }
    };
    let mut tones: Vec<RowTone> = (0..ROW_LENGTH)
        .map(|place| RowTone {
            light: light(place),
            same_until: place as u32,
        })
        .collect();
    for place in (0..ROW_LENGTH - 1).rev() {
        if tones[place].light == tones[place + 1].light {
            tones[place].same_until = tones[place + 1].same_until;
        }
    }
    Ok(tones)
}

fn check([width, height]: [u32; 2], rgba: &[u8]) -> Result<(), RowError> {
    if height == 0 || height > width || width > ROW_PICTURE_MAX {
        return Err(RowError::Size { width, height });
    }
    let byte_count = rgba.len();
    if byte_count != width as usize * height as usize * TONE_WORDS {
        return Err(RowError::ByteCount {
            width,
            height,
            byte_count,
        });
    }
    Ok(())
}

fn linear(pixel: &[u8]) -> [f32; 3] {
    std::array::from_fn(|i| linear_from_byte(pixel[i]))
}

/// The tone at `x` where every step between two pixels is a smooth one, `softness` wide.
fn softened(pixels: &[[f32; 3]], softness: f32, x: f32) -> [f32; 3] {
    let step_at = |i: usize| i as f32 / pixels.len() as f32;
    let half = softness * 0.5;
    let passed = |i: usize| math::smoothstep(step_at(i) - half, step_at(i) + half, x);
    let first = pixels.len() as f32 * (x - half);
    let first = (first as usize).min(pixels.len() - 1);
    let mut light = pixels[first];
    for i in first + 1..pixels.len() {
        let share = passed(i);
        if share == 0.0 {
            break;
        }
        light = std::array::from_fn(|k| light[k] + (pixels[i][k] - pixels[i - 1][k]) * share);
    }
    light
}

/// The words of a row, as passes read it.
pub fn row_words(tones: &[RowTone]) -> &[u32] {
    bytemuck::cast_slice(tones)
}

/// Place in a row of the ramp coordinate `x`.
fn row_place(x: f32) -> usize {
    ((x.max(0.0) * ROW_LENGTH as f32) as usize).min(ROW_LENGTH - 1)
}

fn tone_at(texels: &[u32], row: u32, x: f32) -> RowTone {
    let at = row as usize + TONE_WORDS * row_place(x);
    let [r, g, b] = [0, 1, 2].map(|i| f32::from_bits(texels[at + i]));
    RowTone {
        light: [r, g, b],
        same_until: texels[at + 3],
    }
}

/// Factor on a surface's linear light at coordinate `x`, 0..1, of the row that starts at `row` of the texture store.
pub fn row_light(texels: &[u32], row: u32, x: f32) -> [f32; 3] {
    tone_at(texels, row, x).light
}

/// Whether a row has one tone over all of `range`.
pub fn row_is_even(texels: &[u32], row: u32, range: [f32; 2]) -> bool {
    tone_at(texels, row, range[0]).same_until as usize >= row_place(range[1])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ramp::{Level, ramp_light};
    use proptest::prelude::*;

    fn greys(bytes: &[u8]) -> Vec<u8> {
        bytes.iter().flat_map(|byte| [*byte; 4]).collect()
    }

    fn row(bytes: &[u8], softness: f32) -> Vec<RowTone> {
        tone_row([bytes.len() as u32, 1], &greys(bytes), softness).unwrap()
    }

    #[test]
    fn a_picture_of_two_pixels_is_a_ramp_of_two_tones() {
        let tones = row(&[0, 255], 0.0);
        let at = |x| row_light(row_words(&tones), 0, x);
        assert_eq!(
            [0.0, 0.499, 0.5, 1.0].map(|x| at(x)[0]),
            [0.0, 0.0, 1.0, 1.0]
        );
        assert!(row_is_even(row_words(&tones), 0, [-0.1, 0.49]));
        assert!(!row_is_even(row_words(&tones), 0, [0.49, 0.51]));
        assert!(row_is_even(row_words(&tones), 0, [0.5, 1.3]));
    }

    #[test]
    fn bytes_are_decoded_to_linear_light() {
        let tones = tone_row([1, 1], &[255, 188, 0, 7], 0.0).unwrap();
        let [r, g, b] = tones[500].light;
        assert_eq!([r, b], [1.0, 0.0]);
        assert!((g - 0.5).abs() < 0.005, "{g}");
    }

    #[test]
    fn the_middle_row_counts() {
        let rgba = [greys(&[0; 3]), greys(&[255; 3]), greys(&[0; 3])].concat();
        let tones = tone_row([3, 3], &rgba, 0.0).unwrap();
        assert!(tones.iter().all(|tone| tone.light == [1.0; 3]));
    }

    #[test]
    fn pictures_that_are_no_ramp_are_refused() {
        let told = |size: [u32; 2], count: usize| {
            let rgba = vec![0; count];
            tone_row(size, &rgba, 0.0).unwrap_err().to_string()
        };
        for size in [[0, 0], [4, 0], [1, 4], [5000, 1]] {
            let told = told(size, 0);
            let wanted = format!("not higher than wide, not {} x {}", size[0], size[1]);
            assert!(told.ends_with(&wanted), "{told}");
        }
        assert_eq!(
            told([2, 1], 9),
            "a ramp picture of 2 x 1 has 9 bytes of pixels"
        );
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        /// A picture means what a ramp with a stop for every pixel means, where that has as many.
        #[test]
        fn a_picture_is_the_ramp_of_its_pixels(
            bytes in prop::collection::vec(any::<u8>(), 1..=8), softness in prop_oneof![Just(0.0f32), 0.01f32..0.5],
            place in 0..ROW_LENGTH,
        ) {
            let tones = row(&bytes, softness);
            let levels: Vec<Level> = bytes.iter().enumerate().map(|(i, byte)| Level {
                light: [linear_from_byte(*byte); 3],
                at: i as f32 / bytes.len() as f32,
            }).collect();
            let x = (place as f32 + 0.5) / ROW_LENGTH as f32;
            // Steps that overlap melt in another way.
            prop_assume!(softness <= 1.0 / bytes.len() as f32);
            let [wanted, got] = [ramp_light(&levels, softness, x)[0], tones[place].light[0]];
            prop_assert!((wanted - got).abs() < 1e-5, "{} is not {}", got, wanted);
        }

        #[test]
        fn an_even_range_holds_one_tone(
            bytes in prop::collection::vec(0u8..3, 1..20), low in -0.1f32..1.1, width in 0f32..0.5, at in 0f32..1.0,
            softness in 0f32..0.1,
        ) {
            let tones = row(&bytes, softness);
            let words = row_words(&tones);
            if row_is_even(words, 0, [low, low + width]) {
                prop_assert_eq!(row_light(words, 0, low), row_light(words, 0, low + width * at));
            }
        }

        #[test]
        fn tones_stay_within_their_picture(size in prop::array::uniform2(0u32..40), softness in 0f32..0.5, byte: u8) {
            let rgba = greys(&vec![byte; (size[0] * size[1]) as usize]);
            if let Ok(tones) = tone_row(size, &rgba, softness) {
                let wanted = linear_from_byte(byte);
                prop_assert!(tones.iter().all(|tone| (tone.light[0] - wanted).abs() < 1e-6));
            }
        }
    }
}
