//! The image of a brush: texels, their levels, and where they come from.

use rayon::prelude::*;

/// Most pixels per side of a picture.
pub const PICTURE_SIDE_MAX: u32 = 4096;

/// Most texels across and along an image.
const SIDES_MAX: [u32; 2] = [2048, 128];

/// Why a picture cannot be the image of a brush.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum BrushError {
    /// A picture without pixels, or with more than are taken.
    #[error("a brush picture has 1 to 4096 pixels per side, not {width} x {height}")]
    Size {
        /// Pixels per row.
        width: u32,
        /// Rows.
        height: u32,
    },
    /// Pixels are missing or left over.
    #[error("a brush picture of {width} x {height} has {pixel_count} pixels")]
    PixelCount {
        /// Pixels per row.
        width: u32,
        /// Rows.
        height: u32,
        /// Pixels that were given.
        pixel_count: usize,
    },
}

/// Height of the nap and share of ink at a texel, 0..255 each.
pub(super) type Texel = [u8; 2];

/// The image of a brush.
#[derive(Debug, Clone, PartialEq)]
pub struct BrushImage {
    /// Texels along and across the stroke, powers of two.
    size: [u32; 2],
    /// How often its width the image is long.
    length: f32,
    /// Row by row from the left side of the stroke.
    texels: Vec<Texel>,
}

impl BrushImage {
    /// An image of `size` texels, powers of two, which a function of their number along and across gives.
    pub(super) fn of(size: [u32; 2], texel: impl Fn(u32, u32) -> Texel + Sync) -> Self {
        let rows = (0..size[1]).into_par_iter();
        let row = |y: u32| (0..size[0]).map(|x| texel(x, y)).collect::<Vec<_>>();
        Self {
            size,
            length: size[0] as f32 / size[1] as f32,
            texels: rows.flat_map_iter(row).collect(),
        }
    }

    /// The image that a picture gives, sRGB bytes with straight alpha, row by row: its height lies across the stroke.
    ///
    /// How bright it is says how high the nap stands, its alpha how much ink there is. It is brought to the nearest
    /// powers of two, at most 2048 x 128. O(pixels).
    ///
    /// # Errors
    ///
    /// If the picture has no pixels, more than [`PICTURE_SIDE_MAX`] per side, or a different number than its size says.
    pub fn from_picture([width, height]: [u32; 2], rgba: &[u8]) -> Result<Self, BrushError> {
        // Check the picture.
        let fits = |side: u32| (1..=PICTURE_SIDE_MAX).contains(&side);
        if !fits(width) || !fits(height) {
            return Err(BrushError::Size { width, height });
        }
        if rgba.len() != width as usize * height as usize * 4 {
            let pixel_count = rgba.len() / 4;
            return Err(BrushError::PixelCount {
                width,
                height,
                pixel_count,
            });
        }

        // Average the pixels under every texel, those without ink for nothing.
        let from = [width, height];
        let size = [0, 1].map(|i| nearest_power(from[i]).min(SIDES_MAX[i]));
        let covered = |at: u32, axis: usize| {
            let first = at * from[axis] / size[axis];
            let end = (at + 1) * from[axis] / size[axis];
            first..end.max(first + 1)
        };
        let mut image = Self::of(size, |x, y| {
            let (mut ink, mut nap, mut count) = (0.0, 0.0, 0.0_f32);
            for row in covered(y, 1) {
                for column in covered(x, 0) {
                    let at = 4 * (row as usize * width as usize + column as usize);
                    let [r, g, b, a] = [0, 1, 2, 3].map(|i| f32::from(rgba[at + i]));
                    nap += (r + g + b) / 3.0 * a;
                    ink += a;
                    count += 1.0;
                }
            }
            [nap / ink.max(1.0), ink / count].map(|v| (v + 0.5) as u8)
        });
        image.length = width as f32 / height as f32;
        Ok(image)
    }

    /// Texels along and across the stroke, powers of two.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// How many widths of the stroke the image is long.
    pub fn length(&self) -> f32 {
        self.length
    }

    /// How many levels its words hold: each is half as large, until one side is a single texel.
    pub fn levels(&self) -> u32 {
        self.size[0].min(self.size[1]).ilog2() + 1
    }

    /// The height of the nap and the share of ink at a texel, 0..255.
    pub fn texel(&self, x: u32, y: u32) -> [u8; 2] {
        self.texels[(y * self.size[0] + x) as usize]
    }

    /// All levels as words, the finest first, row by row: the height of the nap in the lowest byte, ink in the next.
    pub fn words(&self) -> Vec<u32> {
        let mut words = Vec::with_capacity(self.texels.len() * 4 / 3);
        let mut level: Vec<[f32; 2]> = self.texels.iter().map(|t| t.map(f32::from)).collect();
        let mut size = self.size;
        for _ in 0..self.levels() {
            let packed = level.iter().map(|t| t.map(|v| (v + 0.5) as u32));
            words.extend(packed.map(|[nap, ink]| nap | ink << 8));
            (level, size) = halved(&level, size);
        }
        words
    }
}

/// The mean of every four texels; of the last level nothing.
fn halved(texels: &[[f32; 2]], [width, height]: [u32; 2]) -> (Vec<[f32; 2]>, [u32; 2]) {
    let size = [width / 2, height / 2];
    let places = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| (2 * x, 2 * y)));
    let mean = |(x, y): (u32, u32)| {
        let at = |dx: u32, dy: u32| texels[((y + dy) * width + x + dx) as usize];
        let four = [at(0, 0), at(1, 0), at(0, 1), at(1, 1)];
        [0, 1].map(|i| four.iter().map(|texel| texel[i]).sum::<f32>() / 4.0)
    };
    (places.map(mean).collect(), size)
}

/// The power of two nearest to a number.
fn nearest_power(number: u32) -> u32 {
    let above = number.next_power_of_two();
    if 4 * number < 3 * above {
        above / 2
    } else {
        above
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_picture_gives_nap_by_brightness_and_ink_by_alpha() {
        let rgba = [
            [255, 255, 255, 255],
            [0, 0, 0, 128],
            [90, 90, 90, 0],
            [60, 60, 60, 255],
        ]
        .concat();
        let image = BrushImage::from_picture([2, 2], &rgba).unwrap();
        let texels = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(x, y)| image.texel(x, y));
        assert_eq!(texels, [[255, 255], [0, 128], [0, 0], [60, 255]]);
    }

    #[test]
    fn pictures_that_are_none_are_refused() {
        for size in [[0, 4], [4, 0], [5000, 2], [2, 5000]] {
            assert!(BrushImage::from_picture(size, &[]).is_err());
        }
        assert!(BrushImage::from_picture([4, 4], &[0; 60]).is_err());
    }

    proptest! {
        /// Levels hold the mean of the image, whatever its sides.
        #[test]
        fn levels_keep_the_mean(
            width in 1u32..70, height in 1u32..70, bytes in prop::collection::vec(any::<u8>(), 70 * 70 * 4),
        ) {
            let rgba = &bytes[..(width * height * 4) as usize];
            let image = BrushImage::from_picture([width, height], rgba).unwrap();
            let [along, across] = image.size();
            prop_assert!(along.is_power_of_two() && across.is_power_of_two());
            prop_assert!(image.length() == width as f32 / height as f32);
            let words = image.words();
            let mut start = 0;
            let mean = |words: &[u32], shift: u32| {
                words.iter().map(|word| f64::from(word >> shift & 255)).sum::<f64>() / words.len() as f64
            };
            for level in 0..image.levels() {
                let count = ((along >> level) * (across >> level)) as usize;
                let texels = &words[start..start + count];
                for shift in [0, 8] {
                    let first = mean(&words[..(along * across) as usize], shift);
                    prop_assert!((mean(texels, shift) - first).abs() <= 1.0);
                }
                start += count;
            }
            prop_assert_eq!(start, words.len());
        }
    }
}
