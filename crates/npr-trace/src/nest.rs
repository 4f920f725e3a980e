//! Which path lies in which.

use super::decompose::PixelLoop;
use super::huge_buffer::HugeBuffer;

/// No loop.
pub(super) const NONE: u32 = u32::MAX;

/// For every loop the number of the innermost one around it; none where there is none.
///
/// `loops` are in the order of [`decompose`](super::decompose()), which puts every loop after those around it; loops
/// left out, as specks are, count as not there. `size` is the bitmap's, in pixels.
///
/// The upright edge next to a loop's start on the left belongs to the loop around it or to one beside it, which has
/// the same around it. O(pixels / 64 + steps).
pub fn nest<'a>(
    size: [u32; 2],
    loops: impl Iterator<Item = PixelLoop<'a>> + Clone,
) -> Vec<Option<u32>> {
    let words = HugeBuffer::zeros(2 * Uprights::words_of(size));
    let parents = parents(size, loops, words).into_iter();
    parents
        .map(|parent| (parent != NONE).then_some(parent))
        .collect()
}

/// [`nest`], with [`NONE`] for none: eight bytes a loop at once, and two bits a pixel, in zeros that are there: twice
/// [`Uprights::words_of`] at least.
pub(super) fn parents<'a>(
    size: [u32; 2],
    loops: impl Iterator<Item = PixelLoop<'a>> + Clone,
    mut words: HugeBuffer,
) -> Vec<u32> {
    debug_assert!(words.iter().all(|word| *word == 0), "no bit is set");
    let count = Uprights::words_of(size);
    let (edges, asked) = words[..2 * count].split_at_mut(count);
    let [mut edges, mut asked] = [edges, asked].map(|bits| Uprights::within(bits, size));
    for pixels in loops.clone() {
        for (place, _) in uprights(&pixels) {
            edges.set(place);
        }
    }
    // Ask for the edge on the left of every start.
    let mut count = 0;
    for pixels in loops.clone() {
        count += 1;
        if let Some(place) = edges.left_of(pixels.start) {
            asked.set(place);
        }
    }
    // Find whose they are, and whether the inside is on their right.
    let (ranks, asked_count) = asked.ranks();
    let mut owners = vec![NONE; asked_count];
    for (number, pixels) in (0..).zip(loops.clone()) {
        for (place, is_down) in uprights(&pixels) {
            if asked.has(place)
                && let Some(owner) = owners.get_mut(asked.rank(&ranks, place))
            {
                *owner = number << 1 | u32::from(is_down);
            }
        }
    }
    let mut parents = Vec::with_capacity(count);
    for pixels in loops {
        let place = edges.left_of(pixels.start);
        let owner = place.and_then(|place| owners.get(asked.rank(&ranks, place)).copied());
        parents.push(match owner {
            None | Some(NONE) => NONE,
            Some(owner) if owner & 1 == 1 => owner >> 1,
            Some(owner) => parents.get((owner >> 1) as usize).copied().unwrap_or(NONE),
        });
    }
    parents
}

/// Words of a block at whose start edges are counted.
const RANK_WORDS: usize = 8;

/// The upright edges of a loop by their upper corners, and whether the loop runs down along them.
fn uprights(pixels: &PixelLoop<'_>) -> impl Iterator<Item = ([u32; 2], bool)> {
    let steps = pixels.corners().zip(pixels.steps);
    steps.filter_map(|([x, y], direction)| match direction {
        1 => Some(([x as u32, (y - 1) as u32], false)),
        3 => Some(([x as u32, y as u32], true)),
        _ => None,
    })
}

/// A bit for every upright edge.
struct Uprights<'a> {
    stride: usize,
    bits: &'a mut [u64],
}

impl<'a> Uprights<'a> {
    /// None yet; in as many words as they need, which are zero.
    fn within(bits: &'a mut [u64], [width, _]: [u32; 2]) -> Self {
        let stride = Self::row_words(width);
        Self { stride, bits }
    }

    /// Words that the edges of a picture need.
    fn words_of([width, height]: [u32; 2]) -> usize {
        Self::row_words(width) * height as usize
    }

    fn row_words(width: u32) -> usize {
        width as usize / 64 + 1
    }

    fn word(&self, [x, y]: [u32; 2]) -> usize {
        y as usize * self.stride + x as usize / 64
    }

    fn set(&mut self, place: [u32; 2]) {
        let word = self.word(place);
        if let Some(word) = self.bits.get_mut(word) {
            *word |= 1 << (place[0] % 64);
        }
    }

    fn has(&self, place: [u32; 2]) -> bool {
        let word = self.bits.get(self.word(place));
        word.is_some_and(|word| word >> (place[0] % 64) & 1 == 1)
    }

    /// How many edges there are before every block of words, and in all.
    fn ranks(&self) -> (Vec<u32>, usize) {
        let mut before = 0;
        let blocks = self.bits.chunks(RANK_WORDS);
        let ranks = blocks.map(|words| {
            let rank = before;
            before += ones(words);
            rank
        });
        (ranks.collect(), before as usize)
    }

    /// How many edges there are before one.
    fn rank(&self, ranks: &[u32], place: [u32; 2]) -> usize {
        let word = self.word(place);
        let block = word / RANK_WORDS;
        let bits = self.bits.get(word).copied().unwrap_or(0);
        let inside = (bits & ((1 << (place[0] % 64)) - 1)).count_ones();
        let before = ones(self.bits.get(block * RANK_WORDS..word).unwrap_or(&[]));
        let rank = ranks.get(block);
        rank.map_or(0, |rank| (rank + before + inside) as usize)
    }

    /// The next edge to the left in the same row.
    fn left_of(&self, [x, y]: [u32; 2]) -> Option<[u32; 2]> {
        let start = y as usize * self.stride;
        let words = self.bits.get(start..=start + x as usize / 64)?;
        let mut mask = (1u64 << (x % 64)) - 1;
        for (index, word) in words.iter().enumerate().rev() {
            let bits = word & mask;
            if bits != 0 {
                return Some([index as u32 * 64 + bits.ilog2(), y]);
            }
            mask = u64::MAX;
        }
        None
    }
}

/// Bits that are set.
fn ones(words: &[u64]) -> u32 {
    words.iter().map(|word| word.count_ones()).sum()
}
