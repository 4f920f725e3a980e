//! How far two pictures of one size differ.

use npr_render::Frame;
use std::fmt;

/// Side of the blocks whose mean difference is judged, in pixels.
const BLOCK: usize = 8;

/// How far two pictures differ, in steps of 255. Never judge by a mean over the whole picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Agreement {
    /// Share of pixels of which no channel differs by more than the tolerance, 0..1.
    pub within: f64,
    /// Largest mean difference of any channel over any block of 8x8 pixels.
    pub worst_block: f64,
    /// Top left pixel of that block.
    pub worst_at: [usize; 2],
    /// Largest difference of any channel of any pixel.
    pub largest: u8,
}

impl Agreement {
    /// Compares two pictures; pixels within `tolerance` of 255 in every channel count as equal.
    ///
    /// # Panics
    ///
    /// Where the sizes differ.
    pub fn between(one: &Frame, two: &Frame, tolerance: u8) -> Self {
        assert_eq!(one.size, two.size, "pictures of one size are compared");
        let apart: Vec<[u8; 4]> = one
            .rgba
            .chunks_exact(4)
            .zip(two.rgba.chunks_exact(4))
            .map(|(a, b)| std::array::from_fn(|i| a[i].abs_diff(b[i])))
            .collect();
        let largest_of = |pixel: &[u8; 4]| pixel.iter().copied().max().unwrap_or(0);
        let within = apart.iter().filter(|pixel| largest_of(pixel) <= tolerance);
        let (worst_block, worst_at) = worst_block(&apart, one.size[0] as usize);
        Self {
            within: within.count() as f64 / apart.len() as f64,
            worst_block,
            worst_at,
            largest: apart.iter().map(largest_of).max().unwrap_or(0),
        }
    }

    /// Whether the two engines agree as promised: 99.8 % of pixels, and no block beyond 6 of 255.
    pub fn holds(&self) -> bool {
        self.within >= 0.998 && self.worst_block <= 6.0
    }
}

impl fmt::Display for Agreement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y] = self.worst_at;
        write!(
            f,
            "{:8.4} % alike, worst block {:6.2} at {x},{y}, largest {}",
            self.within * 100.0,
            self.worst_block,
            self.largest
        )
    }
}

/// The largest mean over the pixels of a block, of any channel, and where the block lies.
fn worst_block(apart: &[[u8; 4]], width: usize) -> (f64, [usize; 2]) {
    let height = apart.len() / width;
    let mut worst = (0.0, [0, 0]);
    for top in (0..height).step_by(BLOCK) {
        for left in (0..width).step_by(BLOCK) {
            let mean = block_mean(apart, width, [left, top]);
            if mean > worst.0 {
                worst = (mean, [left, top]);
            }
        }
    }
    worst
}

/// The mean of the channel that differs most in the block at `corner`.
fn block_mean(apart: &[[u8; 4]], width: usize, corner: [usize; 2]) -> f64 {
    let right = (corner[0] + BLOCK).min(width);
    let (mut sums, mut count) = ([0u32; 4], 0u32);
    for row in apart.chunks(width).skip(corner[1]).take(BLOCK) {
        for pixel in &row[corner[0]..right] {
            count += 1;
            for (sum, apart) in sums.iter_mut().zip(pixel) {
                *sum += u32::from(*apart);
            }
        }
    }
    f64::from(sums.into_iter().max().unwrap_or(0)) / f64::from(count)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grey(size: [u32; 2], at: impl Fn(usize) -> u8) -> Frame {
        let count = (size[0] * size[1]) as usize;
        Frame {
            size,
            rgba: (0..count).flat_map(|i| [at(i), 0, 0, 255]).collect(),
            ..Frame::default()
        }
    }

    #[test]
    fn a_picture_agrees_with_itself() {
        let frame = grey([20, 10], |i| i as u8);
        let agreement = Agreement::between(&frame, &frame, 0);
        assert_eq!((agreement.within, agreement.worst_block), (1.0, 0.0));
    }

    #[test]
    fn a_differing_block_is_found_where_it_lies() {
        let (plain, marked) = (
            grey([20, 10], |_| 9),
            grey([20, 10], |i| if i % 20 >= 16 && i < 20 { 41 } else { 9 }),
        );
        let agreement = Agreement::between(&plain, &marked, 2);
        assert_eq!(agreement.worst_at, [16, 0]);
        assert_eq!(agreement.worst_block, 4.0);
        assert_eq!(agreement.within, 0.98);
        assert_eq!(agreement.largest, 32);
        assert!(!agreement.holds());
    }
}
