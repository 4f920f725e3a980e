//! Hatching from pictures: a scanned pen, a screen tone, a photograph of cloth.

use npr_core::math;
use rayon::prelude::*;

use super::drawing::{Drawing, SPACING_TEXELS};
use super::tile::{HatchError, HatchTile, SIDE_MIN, check_side, mirror, pack, sides};

/// Most pixels per side of a picture.
pub const PICTURE_SIDE_MAX: usize = 4096;

/// A grey picture that repeats in both directions; its dark parts become strokes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Picture<'a> {
    /// Pixels per row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Luminance, 0 black to 1 white, row by row; NaN counts as white.
    pub luminance: &'a [f32],
    /// Whether the picture is laid over itself by half a turn, so that charts of a surface may be glued turned. Not
    /// needed if texture coordinates place it.
    pub turned: bool,
}

/// Softening, as a part of a grey step, that gives plain black and white an order to fill up in.
const TIE_BREAK: f32 = 1.0 / 512.0;

/// A tile of `side` texels per side that repeats `picture`; its strokes keep their width at any distance.
///
/// Finer levels repeat the picture twice as often, so its strokes keep their size on screen; between two levels both
/// pictures are blended. Once the picture fills the tile, no coarser one exists and strokes shrink: the tile should be
/// some times larger than the picture, which is resampled to the nearest power of two. Only the order of its greys
/// counts: tone is linear whatever their values.
///
/// # Errors
///
/// If `side` is not one that [`levels`](super::levels) takes, the picture has no pixels, more than
/// [`PICTURE_SIDE_MAX`] per side, or a different number than its sides say.
pub fn from_image(side: u32, picture: &Picture) -> Result<HatchTile, HatchError> {
    check_side(side)?;
    check_picture(picture)?;
    let pyramid = Pyramid::new(picture, side_in_tile(picture, side));
    let draw = |drawing| pyramid.draw(drawing);
    Ok(HatchTile {
        side,
        spacing_texels: SPACING_TEXELS as f32,
        levels: sides(side).map(|side| pack(side, &draw)).collect(),
    })
}

fn check_picture(picture: &Picture) -> Result<(), HatchError> {
    let (width, height) = (picture.width, picture.height);
    let fits = |side: usize| (1..=PICTURE_SIDE_MAX).contains(&side);
    if !fits(width) || !fits(height) {
        return Err(HatchError::PictureSize { width, height });
    }
    let pixel_count = picture.luminance.len();
    if pixel_count != width * height {
        return Err(HatchError::PixelCount {
            width,
            height,
            pixel_count,
        });
    }
    Ok(())
}

/// The power of two nearest to the picture's larger side, within the tile's.
fn side_in_tile(picture: &Picture, side: u32) -> u32 {
    let larger = picture.width.max(picture.height) as u32;
    let above = larger.next_power_of_two();
    let nearest = if 4 * larger < 3 * above {
        above / 2
    } else {
        above
    };
    nearest.clamp(SIDE_MIN, side)
}

/// The picture on `side * side` texels, with ties broken by its surroundings, laid over its half turn if wanted.
fn heights(picture: &Picture, side: usize) -> Vec<f32> {
    let plain = resample(picture, side);
    let radius = (side / 32).max(1);
    let soft = box_blur(&box_blur(&plain, side, radius), side, radius);
    let broken: Vec<f32> = plain
        .iter()
        .zip(&soft)
        .map(|(p, s)| p + TIE_BREAK * s)
        .collect();
    if !picture.turned {
        return broken;
    }
    let turned = broken.iter().rev();
    broken.iter().zip(turned).map(|(p, q)| p.min(*q)).collect()
}

/// Mean luminance of the pixels under each texel; the nearest pixel if texels are smaller.
fn resample(picture: &Picture, side: usize) -> Vec<f32> {
    let pixels = |texel: usize, count: usize| {
        let from = texel * count / side;
        from..((texel + 1) * count / side).max(from + 1)
    };
    let texel = |i: usize| {
        let (columns, rows) = (
            pixels(i % side, picture.width),
            pixels(i / side, picture.height),
        );
        let count = (columns.len() * rows.len()) as f32;
        let row = |y: usize| {
            columns
                .clone()
                .map(move |x| grey(picture.luminance[y * picture.width + x]))
        };
        rows.flat_map(row).sum::<f32>() / count
    };
    (0..side * side).into_par_iter().map(texel).collect()
}

/// Luminance clamped to 0..1; NaN becomes white.
fn grey(luminance: f32) -> f32 {
    if luminance.is_nan() {
        1.0
    } else {
        luminance.clamp(0.0, 1.0)
    }
}

/// Mean of the square of texels around each, on a tile that repeats: rows first, then turned, twice.
fn box_blur(texels: &[f32], side: usize, radius: usize) -> Vec<f32> {
    let across = |texels: &[f32]| -> Vec<f32> {
        let mean = |x: usize, y: usize| {
            let window =
                (0..=2 * radius).map(|d| texels[y * side + (x + side + d - radius) % side]);
            window.sum::<f32>() / (2 * radius + 1) as f32
        };
        (0..side * side)
            .into_par_iter()
            .map(|i| mean(i / side, i % side))
            .collect()
    };
    across(&across(texels))
}

/// A picture at its own size and at every half of it, down to the coarsest level.
struct Pyramid {
    side: u32,
    turned: bool,
    halves: Vec<Vec<f32>>,
}

impl Pyramid {
    fn new(picture: &Picture, side: u32) -> Self {
        let own = heights(picture, side as usize);
        let halves = sides(side).skip(1).scan(own.clone(), |finer, side| {
            *finer = halve(finer, side as usize);
            Some(finer.clone())
        });
        Self {
            side,
            turned: picture.turned,
            halves: std::iter::once(own.clone()).chain(halves).collect(),
        }
    }

    /// Heights of one drawing: the picture repeated at its own size, blended with one twice as large.
    fn draw(&self, drawing: Drawing) -> Vec<f32> {
        if drawing.side <= self.side {
            return self.halves[(self.side / drawing.side).ilog2() as usize].clone();
        }
        let side = drawing.side;
        let blend = |i: u32| {
            let (x, y) = (i % side, i / side);
            let own = self.halves[0][(y % self.side * self.side + x % self.side) as usize];
            math::mix(own, self.doubled(x, y), drawing.octave())
        };
        let mut heights: Vec<f32> = (0..side * side).into_par_iter().map(blend).collect();
        if self.turned {
            mirror(&mut heights);
        }
        heights
    }

    /// Height of the picture at twice its size, interpolated from four pixels.
    fn doubled(&self, x: u32, y: u32) -> f32 {
        let own = &self.halves[0];
        let near = |i: u32| i / 2 % self.side;
        let far = |i: u32| (i / 2 + self.side - 1 + 2 * (i % 2)) % self.side;
        let at = |x: u32, y: u32| own[(y * self.side + x) as usize];
        let row = |y: u32| math::mix(at(near(x), y), at(far(x), y), 0.25);
        math::mix(row(near(y)), row(far(y)), 0.25)
    }
}

/// Means of two by two texels; `side` is that of the result. Opposite corners are added first, so that a half turn
/// gives the same bits.
fn halve(finer: &[f32], side: usize) -> Vec<f32> {
    let at = |x: usize, y: usize| finer[y * 2 * side + x];
    let mean = |i: usize| {
        let (x, y) = (2 * (i % side), 2 * (i / side));
        0.25 * ((at(x, y) + at(x + 1, y + 1)) + (at(x + 1, y) + at(x, y + 1)))
    };
    (0..side * side).map(mean).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn picture(width: usize, height: usize, luminance: &[f32]) -> Picture<'_> {
        Picture {
            width,
            height,
            luminance,
            turned: false,
        }
    }

    /// Part of a level's texels with a channel below `share`.
    fn inked(level: &[[u8; 4]], channel: usize, share: f32) -> f32 {
        let dark = level
            .iter()
            .filter(|texel| f32::from(texel[channel]) < 255.0 * share);
        dark.count() as f32 / level.len() as f32
    }

    #[test]
    fn unfit_pictures_are_refused() {
        let refused = |side, picture| from_image(side, &picture).unwrap_err().to_string();
        assert_eq!(
            refused(64, picture(0, 4, &[])),
            "a hatch picture has 1 to 4096 pixels per side, not 0 x 4"
        );
        assert_eq!(
            refused(64, picture(5000, 1, &[0.0; 5000])),
            "a hatch picture has 1 to 4096 pixels per side, not 5000 x 1"
        );
        assert_eq!(
            refused(64, picture(2, 2, &[0.0; 3])),
            "a hatch picture of 2 x 2 has 3 pixels"
        );
        assert_eq!(
            refused(65, picture(1, 1, &[0.0])),
            "a hatch tile has a power of two from 16 to 1024 texels per side, not 65"
        );
    }

    #[test]
    fn plain_black_and_white_gets_a_linear_tone() {
        let bars: Vec<f32> = (0..32 * 32)
            .map(|i| if i % 8 < 3 { 0.0 } else { 1.0 })
            .collect();
        let tile = from_image(128, &picture(32, 32, &bars)).unwrap();
        for level in &tile.levels {
            for (channel, share) in (0..4).flat_map(|c| [0.2, 0.375, 0.7].map(|share| (c, share))) {
                let got = inked(level, channel, share);
                // A column is of one grey: shares come in eighths.
                assert!((got - share).abs() < 0.13, "{got} is not {share}");
            }
        }
        assert_eq!(inked(&tile.levels[0], 0, 0.375), 0.375);
    }

    #[test]
    fn strokes_keep_their_size_until_the_picture_fills_the_tile() {
        let wedge: Vec<f32> = (0..16 * 16).map(|i| (i % 16) as f32 / 16.0).collect();
        let tile = from_image(64, &picture(16, 16, &wedge)).unwrap();
        let row = |level: usize| tile.levels[level][..16].to_vec();
        let first = |level: usize| row(level).iter().map(|texel| texel[0]).collect::<Vec<_>>();
        assert_eq!(first(0), first(1));
        assert_eq!(first(1), first(2));
        assert_eq!(tile.levels.len(), 3);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        #[test]
        fn any_picture_gives_a_tile(
            width in 1usize..40, height in 1usize..40, power in 4u32..7, turned: bool, seed: u32,
        ) {
            let odd = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e30];
            let grey = |i: usize| match npr_core::random::hash(seed, i as u32, 0) {
                hash if hash % 16 < 4 => odd[hash as usize % 16],
                hash => npr_core::random::unit(hash),
            };
            let luminance: Vec<f32> = (0..width * height).map(grey).collect();
            let picture = Picture { turned, ..picture(width, height, &luminance) };
            let tile = from_image(1 << power, &picture).unwrap();
            for level in &tile.levels {
                prop_assert!(level.iter().flatten().all(|&channel| channel != 0 && channel != 255));
                prop_assert!(!turned || level.iter().eq(level.iter().rev()));
            }
        }
    }
}
