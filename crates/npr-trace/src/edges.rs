//! The pixel edges of a bitmap: sides between ink and white.

use super::bitmap::Bitmap;
use super::huge_buffer::HugeBuffer;
use rayon::prelude::*;

/// Columns and rows of nothing around the picture, so that the 8x8 pixels around any corner can be asked for.
const PAD: usize = 8;

/// Least rows that are worth another thread.
const LEAST_ROWS: usize = 64;

/// Which sides of pixels lie between different colours; walked paths take theirs away.
///
/// Corners are numbered from the top left one, `x` to the right and `y` down. An *upright* edge runs from the corner
/// `(x, y)` down to `(x, y + 1)`, a *level* edge from `(x, y)` right to `(x + 1, y)`.
#[derive(Debug, Clone)]
pub(super) struct EdgeMap {
    /// Words of a row.
    stride: usize,
    /// Words of the upright edges; those of the level ones follow.
    half: usize,
    words: HugeBuffer,
}

impl EdgeMap {
    /// All pixel edges of a bitmap. O(pixels / 64).
    pub fn new(bitmap: &Bitmap) -> Self {
        let (width, height) = (bitmap.width(), bitmap.height());
        let stride = (width as usize + 2 * PAD).div_ceil(64) + 1;
        let rows = height as usize + 2 * PAD;
        let half = stride * rows;
        let mut words = HugeBuffer::zeros(2 * half);
        let white = vec![0; width.div_ceil(64) as usize];
        // A stretch for every thread, since new pages that lie close together are not given to two threads at once.
        let least = (rows / rayon::current_num_threads()).max(LEAST_ROWS);
        let (upright, level) = words.split_at_mut(half);
        let uprights = upright.par_chunks_mut(stride);
        let rows = uprights.zip(level.par_chunks_mut(stride));
        rows.enumerate()
            .with_min_len(least)
            .for_each(|(row, (upright, level))| {
                // Rows outside the picture are white.
                let pixels = |y: Option<usize>| match y.map_or(&[][..], |y| bitmap.row(y)) {
                    [] => &white[..],
                    words => words,
                };
                if let Some(y) = row.checked_sub(PAD).filter(|y| *y <= height as usize) {
                    set_row(pixels(y.checked_sub(1)), pixels(Some(y)), upright, level);
                }
            });
        Self {
            stride,
            half,
            words,
        }
    }

    /// Its memory, more than two bits a pixel; all zero where every edge was taken.
    pub fn into_words(self) -> HugeBuffer {
        self.words
    }

    #[inline]
    fn place(&self, x: u32, y: u32) -> (usize, u32) {
        let column = x as usize + PAD;
        (
            (y as usize + PAD) * self.stride + column / 64,
            column as u32 % 64,
        )
    }

    /// Whether an edge leads from the corner in a direction: 0 right, 1 up, 2 left, 3 down.
    #[inline]
    pub fn leads(&self, x: u32, y: u32, direction: u8) -> bool {
        let (word, bit) = self.place(x, y);
        let word = match direction & 3 {
            0 => self.words[self.half + word] >> bit,
            // The column before is in the word before where the bit is the first.
            2 if bit == 0 => self.words[self.half + word - 1] >> 63,
            2 => self.words[self.half + word] >> (bit - 1),
            1 => self.words[word - self.stride] >> bit,
            _ => self.words[word] >> bit,
        };
        word & 1 == 1
    }

    /// 1 if a level edge leads to the right from the corner `dx` columns and `dy` rows away, else 0.
    #[inline]
    pub fn is_level_around(&self, x: u32, y: u32, dx: i32, dy: i32) -> u64 {
        let column = (x as usize + PAD).wrapping_add_signed(dx as isize);
        let row = (y as usize + PAD).wrapping_add_signed(dy as isize);
        self.words[self.half + row * self.stride + column / 64] >> (column % 64) & 1
    }

    /// The seven upright edges between the eight pixels around the corner's column, in the row `dy` below the corner.
    #[inline]
    pub fn upright_around(&self, x: u32, y: u32, dy: i32) -> u64 {
        let column = x as usize + PAD - 3;
        let row = (y as usize + PAD).wrapping_add_signed(dy as isize);
        let at = row * self.stride + column / 64;
        let bit = column % 64;
        // Two shifts, since one by 64 is none.
        let both = self.words[at] >> bit | self.words[at + 1] << 1 << (63 - bit);
        both & 0x7f
    }

    /// Takes the edge away that leads from the corner in a direction.
    #[inline]
    pub fn take(&mut self, x: u32, y: u32, direction: u8) {
        let (x, y) = match direction & 3 {
            1 => (x, y.wrapping_sub(1)),
            2 => (x.wrapping_sub(1), y),
            _ => (x, y),
        };
        let (word, bit) = self.place(x, y);
        if direction & 1 == 1 {
            self.words[word] &= !(1 << bit);
        } else {
            self.words[self.half + word] &= !(1 << bit);
        }
    }

    /// The first upright edge at or after a place, rows before columns; its upper corner.
    pub fn next_upright(&self, [x, y]: [u32; 2]) -> Option<[u32; 2]> {
        let (upright, _) = self.words.split_at(self.half);
        let (mut word, bit) = self.place(x, y);
        let mut bits = *upright.get(word)? & (u64::MAX << bit);
        while bits == 0 {
            word += 1;
            bits = *upright.get(word)?;
        }
        let column = word % self.stride * 64 + bits.trailing_zeros() as usize;
        Some([(column - PAD) as u32, (word / self.stride - PAD) as u32])
    }
}

/// Sets the edges of a row of pixels, and those between it and the row above it, which has as many words.
fn set_row(above: &[u64], row: &[u64], upright: &mut [u64], level: &mut [u64]) {
    // Every word of edges takes pixels of two words, the first and the last one of none besides.
    let (Some((first_above, last_above)), Some((first, last))) = (ends(above), ends(row)) else {
        return;
    };
    let mut edges = upright.iter_mut().zip(level);
    if let Some((upright, level)) = edges.next() {
        (*upright, *level) = edges_between([0, first_above], [0, first]);
    }
    let pairs = above.windows(2).zip(row.windows(2));
    for ((above, here), (upright, level)) in pairs.zip(&mut edges) {
        (*upright, *level) = edges_between([above[0], above[1]], [here[0], here[1]]);
    }
    if let Some((upright, level)) = edges.next() {
        (*upright, *level) = edges_between([last_above, 0], [last, 0]);
    }
}

fn ends(words: &[u64]) -> Option<(u64, u64)> {
    Some((*words.first()?, *words.last()?))
}

/// Upright and level edges of a word of the map, from two words each of the pixels above and of its own.
#[inline]
fn edges_between(above: [u64; 2], here: [u64; 2]) -> (u64, u64) {
    let [pixels_above, pixels] = [above, here].map(|[a, b]| b << PAD | a >> (64 - PAD));
    let before = here[1] << (PAD + 1) | here[0] >> (63 - PAD);
    (pixels ^ before, pixels ^ pixels_above)
}
