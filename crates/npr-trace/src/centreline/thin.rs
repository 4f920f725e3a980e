//! Ink thinned to lines one pixel thin.

use crate::Bitmap;
use rayon::prelude::*;

/// Words that one task looks at, so that threads are worth their while.
const TASK_WORDS: usize = 512;

/// Sides from which ink is taken, in turn.
const SIDES: [Side; 4] = [Side::North, Side::South, Side::West, Side::East];

#[derive(Clone, Copy)]
enum Side {
    North,
    South,
    West,
    East,
}

/// The ink of a bitmap, thinned to lines one pixel thin.
///
/// What is left is part of the ink, hangs together as the ink does (ink by sides and corners, white by sides), and
/// has as many holes. No pixel can be taken away any more but ends of lines and those that hold it together. Ends of
/// lines two pixels wide and less are not shortened; those of wider ones by up to half their width.
///
/// Layers of pixels are taken from one side after the other [Rosenfeld 1975]: those white on that side that are
/// simple (their ring changes from white to ink once [Hilditch 1969]) and have two neighbours or more. Within a layer
/// all are taken at once, 64 by logic on words, on all threads; the result is the same for any number of them. Time
/// grows with the words that hold an edge of the ink, times half the width of lines.
pub fn thin(bitmap: &Bitmap) -> Bitmap {
    let mut ink = Words::of(bitmap);
    let mut active: Vec<usize> = (0..ink.words.len())
        .filter(|at| ink.words[*at] != 0)
        .collect();
    let mut mark = vec![0u64; ink.words.len().div_ceil(64)];
    while !active.is_empty() {
        let mut changed = Vec::new();
        for side in SIDES {
            // Take off what may go on one side, all at once.
            let taken: Vec<u64> = active
                .par_iter()
                .with_min_len(TASK_WORDS)
                .map(|at| ink.removable(*at, side))
                .collect();
            for (at, taken) in active.iter().zip(taken) {
                if taken != 0 {
                    ink.words[*at] &= !taken;
                    changed.push(*at);
                }
            }
        }

        // Look next time only where something changed.
        active = ink.around(&changed, &mut mark);
    }
    ink.bitmap(bitmap)
}

/// Rows of words, with a white one above, below, and on the right of each row.
struct Words {
    words: Vec<u64>,
    stride: usize,
}

impl Words {
    fn of(bitmap: &Bitmap) -> Self {
        let stride = bitmap.width().div_ceil(64) as usize + 1;
        let rows = bitmap.height() as usize + 2;
        let mut words = vec![0; stride * rows + 1];
        for y in 0..bitmap.height() as usize {
            let row = bitmap.row(y);
            // One word further, so that the first has one before it.
            let start = (y + 1) * stride + 1;
            words[start..start + row.len()].copy_from_slice(row);
        }
        Self { words, stride }
    }

    /// The ink as a bitmap of another one's size.
    fn bitmap(&self, like: &Bitmap) -> Bitmap {
        let mut thinned = like.clone();
        for y in 0..like.height() {
            let start = (y as usize + 1) * self.stride + 1;
            for (word, before) in like.row(y as usize).iter().enumerate() {
                let mut gone = before & !self.words[start + word];
                while gone != 0 {
                    thinned.set(word as u32 * 64 + gone.trailing_zeros(), y, false);
                    gone &= gone - 1;
                }
            }
        }
        thinned
    }

    /// Pixels left of those of a word, at the word, and right of them.
    fn row_around(&self, at: usize) -> [u64; 3] {
        let here = self.words[at];
        [
            here << 1 | self.words[at - 1] >> 63,
            here,
            here >> 1 | self.words[at + 1] << 63,
        ]
    }

    /// Pixels of a word that may be taken from a side.
    fn removable(&self, at: usize, side: Side) -> u64 {
        let [w, here, e] = self.row_around(at);
        if here == 0 {
            return 0;
        }
        let [nw, n, ne] = self.row_around(at - self.stride);
        let [sw, s, se] = self.row_around(at + self.stride);
        let open = !match side {
            Side::North => n,
            Side::South => s,
            Side::West => w,
            Side::East => e,
        };
        let candidates = here & open;
        if candidates == 0 {
            return 0;
        }
        // Count places where the ring around a pixel turns from white to ink; a white corner between ink does not
        // count.
        let a = !e & (ne | n);
        let b = !n & (nw | w);
        let c = !w & (sw | s);
        let d = !s & (se | e);
        let once = (a ^ b ^ c ^ d) & !(a & b | c & d);
        let (mut one, mut two) = (0, 0);
        for neighbour in [e, ne, n, nw, w, sw, s, se] {
            two |= one & neighbour;
            one |= neighbour;
        }
        candidates & once & two
    }

    /// Words with ink in which something may have become removable, in order.
    fn around(&self, changed: &[usize], mark: &mut [u64]) -> Vec<usize> {
        // Mark words around every change.
        for at in changed {
            for row in [at - self.stride, *at, at + self.stride] {
                for word in row - 1..=row + 1 {
                    mark[word / 64] |= 1 << (word % 64);
                }
            }
        }

        // List each of them once.
        let mut found = Vec::with_capacity(changed.len());
        for at in changed {
            for row in [at - self.stride, *at, at + self.stride] {
                for word in row - 1..=row + 1 {
                    let bit = 1 << (word % 64);
                    let is_new = mark[word / 64] & bit != 0;
                    mark[word / 64] &= !bit;
                    if is_new && self.words[word] != 0 {
                        found.push(word);
                    }
                }
            }
        }
        found.sort_unstable();
        found
    }
}
