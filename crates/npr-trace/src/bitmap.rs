//! Black and white pictures, a bit a pixel.

use super::huge_buffer::HugeBuffer;
use rayon::prelude::*;
use std::io::{self, Read};
use std::sync::{Mutex, PoisonError};

/// Most pixels of a side; beyond it pixel edges could not be numbered.
pub const SIDE_LIMIT: u32 = 32_768;

/// Bytes that a thread reads at once: memory that is used again costs nothing, while every new page does.
const READ_BYTES: usize = 1 << 16;

/// A black and white picture: ink is 1. Outside of it all is white.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Bitmap {
    width: u32,
    height: u32,
    /// Words of 64 pixels, the lowest bit leftmost; rows from the top. Bits beyond the width are 0.
    words: HugeBuffer,
}

/// Why a bitmap was not made.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum BitmapError {
    /// It is larger than can be traced.
    #[error("{width}x{height} pixels, but a bitmap has at most {SIDE_LIMIT} a side")]
    TooLarge {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
    },
    /// The data does not hold as many pixels as it should.
    #[error("{expected} bytes are needed for {width}x{height} pixels, but there are {found}")]
    Length {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
        /// Bytes that the size asks for.
        expected: usize,
        /// Bytes given.
        found: usize,
    },
}

impl Bitmap {
    /// A white picture.
    ///
    /// # Errors
    ///
    /// [`BitmapError::TooLarge`] beyond [`SIDE_LIMIT`].
    pub fn new(width: u32, height: u32) -> Result<Self, BitmapError> {
        if width.max(height) > SIDE_LIMIT {
            return Err(BitmapError::TooLarge { width, height });
        }
        let words = HugeBuffer::zeros(width.div_ceil(64) as usize * height as usize);
        Ok(Self {
            width,
            height,
            words,
        })
    }

    /// A picture from bytes, each pixel `pixel` bytes: black where `is_ink` says so of them.
    ///
    /// # Errors
    ///
    /// [`BitmapError`] where the size is beyond [`SIDE_LIMIT`] or does not go with the data.
    pub fn from_pixels<const N: usize>(
        width: u32,
        height: u32,
        data: &[u8],
        is_ink: impl Fn([u8; N]) -> bool,
    ) -> Result<Self, BitmapError> {
        let mut bitmap = Self::new(width, height)?;
        let row_bytes = width as usize * N;
        check_length(width, height, row_bytes, data)?;
        let (pixels, _) = data.as_chunks::<N>();
        let rows = pixels.chunks_exact(width.max(1) as usize);
        for (row, words) in rows.zip(bitmap.rows_mut()) {
            for (word, pixels) in words.iter_mut().zip(row.chunks(64)) {
                for (bit, pixel) in pixels.iter().enumerate() {
                    *word |= u64::from(is_ink(*pixel)) << bit;
                }
            }
        }
        Ok(bitmap)
    }

    /// A picture from grey values: black up to `black_level`, a share of white.
    ///
    /// # Errors
    ///
    /// As [`Self::from_pixels`].
    pub fn from_luminance(
        width: u32,
        height: u32,
        luminance: &[u8],
        black_level: f64,
    ) -> Result<Self, BitmapError> {
        let table = level_table(black_level, 255);
        Self::from_pixels(width, height, luminance, |[grey]: [u8; 1]| {
            table.get(usize::from(grey)).is_some_and(|ink| *ink)
        })
    }

    /// A picture from straight RGBA, laid over white: black where the mean of the channels is up to `black_level`.
    ///
    /// Not in the paper; the plain mean is what the program Potrace takes, measured on single pixels.
    ///
    /// # Errors
    ///
    /// As [`Self::from_pixels`].
    pub fn from_rgba(
        width: u32,
        height: u32,
        rgba: &[u8],
        black_level: f64,
    ) -> Result<Self, BitmapError> {
        // In whole steps: the sum of three channels times the opacity, so that no rounding decides.
        let most = 3 * 255 * 255;
        let level = threshold(black_level, most);
        Self::from_pixels(width, height, rgba, |[r, g, b, a]: [u8; 4]| {
            let sum = i64::from(r) + i64::from(g) + i64::from(b);
            let (opacity, white) = (i64::from(a), 3 * 255);
            opacity * sum + (255 - opacity) * white <= level
        })
    }

    /// A picture from packed rows as in the format PBM: the highest bit leftmost, rows padded to bytes, ink is 1.
    ///
    /// # Errors
    ///
    /// As [`Self::from_pixels`].
    pub fn from_packed(width: u32, height: u32, data: &[u8]) -> Result<Self, BitmapError> {
        let mut bitmap = Self::new(width, height)?;
        let row_bytes = width.div_ceil(8) as usize;
        check_length(width, height, row_bytes, data)?;
        let last = last_word_mask(width);
        for (row, words) in data.chunks_exact(row_bytes.max(1)).zip(bitmap.rows_mut()) {
            unpack_row(row, words, last);
        }
        Ok(bitmap)
    }

    /// Reads packed rows, as [`Self::from_packed`] takes them, in the place of what the picture shows.
    ///
    /// All threads read and unpack in turns, so that bytes need not be held; what follows the rows is not read.
    ///
    /// # Errors
    ///
    /// What `source` says, or that it ends before the rows do.
    pub fn read_packed(&mut self, source: impl Read + Send) -> io::Result<()> {
        // Share the rows out in turns.
        let row_bytes = self.width.div_ceil(8) as usize;
        let stride = self.row_words().max(1);
        let row_count = (READ_BYTES / row_bytes.max(1)).max(1);
        let last = last_word_mask(self.width);
        let unread = Mutex::new((source, self.words.chunks_mut(row_count * stride)));

        // Let one thread read at a time.
        let read_next = |bytes: &mut Vec<u8>| {
            let mut unread = unread.lock().unwrap_or_else(PoisonError::into_inner);
            let (source, parts) = &mut *unread;
            let Some(words) = parts.next() else {
                return Ok(None);
            };
            bytes.resize(words.len() / stride * row_bytes, 0);
            source.read_exact(bytes).map(|()| Some(words))
        };

        // Let all unpack what they have read.
        let threads = (0..rayon::current_num_threads()).into_par_iter();
        threads.with_max_len(1).try_for_each(|_| {
            let mut bytes = Vec::new();
            while let Some(words) = read_next(&mut bytes)? {
                let rows = bytes.chunks_exact(row_bytes);
                for (row, words) in rows.zip(words.chunks_exact_mut(stride)) {
                    unpack_row(row, words, last);
                }
            }
            Ok(())
        })
    }

    /// Pixels across.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Pixels down.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Whether a pixel is ink; none is outside the picture.
    pub fn is_ink(&self, x: i64, y: i64) -> bool {
        let inside = (0..i64::from(self.width)).contains(&x);
        let row = usize::try_from(y).map(|y| self.row(y)).unwrap_or(&[]);
        inside
            && row
                .get(x as usize / 64)
                .is_some_and(|word| word >> (x as usize % 64) & 1 == 1)
    }

    /// Makes a pixel ink or white. Places outside the picture are passed over.
    pub fn set(&mut self, x: u32, y: u32, ink: bool) {
        if x >= self.width || y >= self.height {
            return;
        }
        let at = y as usize * self.row_words() + x as usize / 64;
        if let Some(word) = self.words.get_mut(at) {
            let bit = 1 << (x % 64);
            *word = if ink { *word | bit } else { *word & !bit };
        }
    }

    /// Turns ink into white and white into ink.
    pub fn invert(&mut self) {
        let last = last_word_mask(self.width);
        for words in self.rows_mut() {
            for word in words.iter_mut() {
                *word = !*word;
            }
            if let Some(word) = words.last_mut() {
                *word &= last;
            }
        }
    }

    /// Words of a row, the lowest bit of each leftmost; none below the picture.
    pub fn row(&self, y: usize) -> &[u64] {
        let stride = self.row_words();
        let start = y.saturating_mul(stride);
        self.words
            .get(start..start.saturating_add(stride))
            .unwrap_or(&[])
    }

    fn row_words(&self) -> usize {
        self.width.div_ceil(64) as usize
    }

    fn rows_mut(&mut self) -> impl Iterator<Item = &mut [u64]> {
        let stride = self.row_words().max(1);
        self.words.chunks_exact_mut(stride)
    }
}

/// Words of a packed row; of the last one the bits of a mask.
fn unpack_row(row: &[u8], words: &mut [u64], last: u64) {
    let (eights, rest) = row.as_chunks();
    for (word, eight) in words.iter_mut().zip(eights) {
        *word = u64::from_be_bytes(*eight).reverse_bits();
    }
    let Some(word) = words.last_mut() else {
        return;
    };
    if !rest.is_empty() {
        let mut eight = [0; 8];
        for (to, byte) in eight.iter_mut().zip(rest) {
            *to = *byte;
        }
        *word = u64::from_be_bytes(eight).reverse_bits();
    }
    *word &= last;
}

/// Bits of a row's last word that are pixels.
fn last_word_mask(width: u32) -> u64 {
    match width % 64 {
        0 => u64::MAX,
        used => (1 << used) - 1,
    }
}

fn check_length(width: u32, height: u32, row_bytes: usize, data: &[u8]) -> Result<(), BitmapError> {
    // Sides are within their limit, so this cannot overflow.
    let expected = row_bytes * height as usize;
    if data.len() == expected {
        return Ok(());
    }
    Err(BitmapError::Length {
        width,
        height,
        expected,
        found: data.len(),
    })
}

/// The greatest whole value that counts as black, of values up to `most`; less than none for what is no number.
fn threshold(black_level: f64, most: i64) -> i64 {
    let level = black_level * most as f64;
    if level >= 0.0 {
        // A level written with few digits means the whole value next to it.
        (level + 1e-9).floor().min(most as f64) as i64
    } else {
        -1
    }
}

/// Whether each value up to `most` counts as black.
fn level_table(black_level: f64, most: i64) -> Vec<bool> {
    let level = threshold(black_level, most);
    (0..=most).map(|value| value <= level).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use npr_core::math::mix_bits;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        #[test]
        fn what_is_set_is_read(
            width in 1u32..150, height in 1u32..9,
            spots in prop::collection::vec((0u32..160, 0u32..10, any::<bool>()), 0..40),
        ) {
            let mut bitmap = Bitmap::new(width, height).expect("small");
            let mut plain = vec![false; (width * height) as usize];
            for (x, y, ink) in spots {
                bitmap.set(x, y, ink);
                if x < width && y < height {
                    plain[(y * width + x) as usize] = ink;
                }
            }
            let mut inverted = bitmap.clone();
            inverted.invert();
            let grey: Vec<u8> = plain.iter().map(|ink| if *ink { 127 } else { 128 }).collect();
            prop_assert_eq!(&Bitmap::from_luminance(width, height, &grey, 0.5).expect("fits"), &bitmap);
            let rgba: Vec<u8> = plain.iter().flat_map(|ink| [0, 0, 0, if *ink { 128 } else { 127 }]).collect();
            prop_assert_eq!(&Bitmap::from_rgba(width, height, &rgba, 0.5).expect("fits"), &bitmap);
            for y in -1..=i64::from(height) {
                for x in -1..=i64::from(width) {
                    let inside = (0..i64::from(width)).contains(&x) && (0..i64::from(height)).contains(&y);
                    let ink = inside && plain[(y * i64::from(width) + x) as usize];
                    prop_assert_eq!(bitmap.is_ink(x, y), ink);
                    prop_assert_eq!(inverted.is_ink(x, y), inside && !ink);
                }
            }
        }

        #[test]
        fn packed_rows_are_read(
            width in 1u32..150, height in 1u32..5, bytes in prop::collection::vec(any::<u8>(), 100),
        ) {
            let row = width.div_ceil(8) as usize;
            let data = &bytes[..row * height as usize];
            let bitmap = Bitmap::from_packed(width, height, data).expect("fits");
            let mut read = Bitmap::new(width, height).expect("small");
            read.set(0, 0, true);
            read.read_packed(&bytes[..]).expect("enough");
            prop_assert_eq!(&read, &bitmap);
            prop_assert!(read.read_packed(&data[1..]).is_err());
            for y in 0..height as usize {
                for x in 0..width as usize {
                    let ink = data[y * row + x / 8] >> (7 - x % 8) & 1 == 1;
                    prop_assert_eq!(bitmap.is_ink(x as i64, y as i64), ink);
                }
            }
        }
    }

    #[test]
    fn long_rows_are_read_by_any_number_of_threads() {
        let (width, height) = (1203, 900);
        let bytes: Vec<u8> = (0..151 * height).map(|i| mix_bits(i) as u8).collect();
        let plain = Bitmap::from_packed(width, height, &bytes).expect("fits");
        for threads in [1, 3] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
            let mut bitmap = Bitmap::new(width, height).expect("small");
            let pool = pool.build().expect("threads");
            let read = pool.install(|| bitmap.read_packed(&bytes[..]));
            assert!(read.is_ok() && bitmap == plain, "{threads}");
        }
        let mut bitmap = Bitmap::new(width, height).expect("small");
        let error = bitmap.read_packed(&bytes[1..]).expect_err("a byte less");
        assert_eq!(error.kind(), io::ErrorKind::UnexpectedEof);
    }

    #[test]
    fn sizes_are_checked() {
        assert!(Bitmap::new(0, 0).is_ok() && Bitmap::new(SIDE_LIMIT, 1).is_ok());
        assert!(matches!(
            Bitmap::new(1, SIDE_LIMIT + 1),
            Err(BitmapError::TooLarge { .. })
        ));
        let short = Bitmap::from_luminance(2, 2, &[0; 3], 0.5);
        assert!(matches!(
            short,
            Err(BitmapError::Length { expected: 4, .. })
        ));
    }

    #[test]
    fn a_level_that_is_no_number_leaves_all_white() {
        for (level, ink) in [(f64::NAN, false), (-0.1, false), (0.0, true), (2.0, true)] {
            let bitmap = Bitmap::from_luminance(1, 1, &[0], level).expect("fits");
            assert_eq!(bitmap.is_ink(0, 0), ink, "{level}");
        }
    }
}
