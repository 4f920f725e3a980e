//! Which path lies in which.

use super::decompose::PixelLoop;

/// For every loop the number of the innermost one around it; none where there is none.
///
/// `loops` are in the order of [`decompose`](super::decompose()), which puts every loop after those around it; loops left out, as specks are, count as
/// not there. `size` is the bitmap's, in pixels.
///
/// The upright edge next to a loop's start on the left belongs to the loop around it or to one beside it, which has the same
/// around it. O(pixels / 64 + steps).
pub fn nest<'a>(
    size: [u32; 2],
    loops: impl Iterator<Item = PixelLoop<'a>> + Clone,
) -> Vec<Option<u32>> {
    let mut edges = Uprights::new(size);
    for pixels in loops.clone() {
        for (place, _) in uprights(&pixels) {
            edges.set(place);
        }
    }
    // Ask for the edge on the left of every start.
    let left: Vec<Option<[u32; 2]>> = loops.clone().map(|l| edges.left_of(l.start)).collect();
    let mut asked: Vec<[u32; 2]> = left.iter().flatten().map(|[x, y]| [*y, *x]).collect();
    asked.sort_unstable();
    asked.dedup();
    edges.bits.fill(0);
    for [y, x] in &asked {
        edges.set([*x, *y]);
    }
    // Find whose they are, and whether the inside is on their right.
    let mut owners = vec![(0u32, false); asked.len()];
    for (number, pixels) in (0..).zip(loops) {
        for (place @ [x, y], is_down) in uprights(&pixels) {
            if !edges.has(place) {
                continue;
            }
            let found = asked.binary_search(&[y, x]);
            if let Some(owner) = found.ok().and_then(|at| owners.get_mut(at)) {
                *owner = (number, is_down);
            }
        }
    }
    let mut parents: Vec<Option<u32>> = Vec::with_capacity(left.len());
    for place in left {
        let owner = place.and_then(|[x, y]| owners.get(asked.binary_search(&[y, x]).ok()?));
        parents.push(owner.and_then(|(number, is_around)| {
            if *is_around {
                return Some(*number);
            }
            parents.get(*number as usize).copied().flatten()
        }));
    }
    parents
}

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
struct Uprights {
    stride: usize,
    bits: Vec<u64>,
}

impl Uprights {
    fn new([width, height]: [u32; 2]) -> Self {
        let stride = width as usize / 64 + 1;
        Self {
            stride,
            bits: vec![0; stride * height as usize],
        }
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
