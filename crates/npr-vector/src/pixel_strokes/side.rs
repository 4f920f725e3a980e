//! Sides of contour pixels, linked to closed loops: the twins of `vector.mark_sides` and `vector.link_sides`.
//!
//! A side lies between a pixel with ink and one without. Sides run clockwise around ink as one sees it: along the upper
//! side to the right, down the right one, back along the lower, and up the left one.

use super::fragment::{BITS_A_WORD, holder_of};
use super::planar::Planar;
use super::segment::Segment;
use crate::rank::Link;
use bytemuck::{Pod, Zeroable};
use npr_core::gpu_layout;
use rayon::prelude::*;

/// Pixels whose sides share a word of masks: four bits each, those of the first lowest.
pub const PIXELS_A_WORD: usize = 8;

/// Steps in the four directions: right, down, left, up.
const AHEAD: [[i64; 2]; 4] = [[1, 0], [0, 1], [-1, 0], [0, -1]];

/// An image whose pixels have ink where they are not 0.
#[derive(Debug, Clone, Copy)]
pub struct Ink<'a> {
    /// Width and height.
    pub size: [u32; 2],
    /// Pixels, row by row from the top.
    pub pixels: &'a [u32],
}

impl Ink<'_> {
    /// Whether a pixel has ink; pixels beyond the picture have none.
    fn at(&self, x: i64, y: i64) -> bool {
        let [width, height] = self.size.map(i64::from);
        let is_inside = x >= 0 && y >= 0 && x < width && y < height;
        is_inside && self.pixels[(y * width + x) as usize] != 0
    }

    /// Whether each pixel has ink, a bit each, [`BITS_A_WORD`] a word.
    pub fn bits(&self) -> Vec<u32> {
        let words = self.pixels.chunks(BITS_A_WORD);
        let bit = |(place, pixel): (usize, &u32)| u32::from(*pixel != 0) << place;
        words
            .map(|pixels| pixels.iter().enumerate().map(bit).sum())
            .collect()
    }

    fn place_of(&self, pixel: u32) -> [i64; 2] {
        [pixel % self.size[0], pixel / self.size[0]].map(i64::from)
    }

    /// The sides of a pixel, a bit for each direction.
    pub fn sides_of(&self, pixel: u32) -> u32 {
        let [x, y] = self.place_of(pixel);
        if !self.at(x, y) {
            return 0;
        }
        (0..4).fold(0, |mask, direction| {
            let [dx, dy] = outward(direction);
            let is_side = !self.at(x + dx, y + dy);
            mask | u32::from(is_side) << direction
        })
    }

    /// The side that goes on where one ends, as pixel and direction.
    ///
    /// The two pixels ahead decide. With ink in the outer one, the line turns left onto that pixel, so that ink that
    /// meets in a corner is joined, whatever the inner one holds; else it goes straight on over ink in the inner one,
    /// or turns right around its own pixel. All 16 patterns of two by two pixels are covered, and in both ambiguous
    /// ones the ink is joined ("black" in Potrace's words).
    pub fn after(&self, pixel: u32, direction: u32) -> (u32, u32) {
        let ([x, y], [vx, vy], [ox, oy]) = self.frame_of(pixel, direction, 1);
        if self.at(x + vx + ox, y + vy + oy) {
            (self.number(x + vx + ox, y + vy + oy), (direction + 3) % 4)
        } else if self.at(x + vx, y + vy) {
            (self.number(x + vx, y + vy), direction)
        } else {
            (pixel, (direction + 1) % 4)
        }
    }

    /// The side that this one continues: [`Ink::after`] mirrored.
    fn before(&self, pixel: u32, direction: u32) -> (u32, u32) {
        let ([x, y], [vx, vy], [ox, oy]) = self.frame_of(pixel, direction, -1);
        if self.at(x + vx + ox, y + vy + oy) {
            (self.number(x + vx + ox, y + vy + oy), (direction + 1) % 4)
        } else if self.at(x + vx, y + vy) {
            (self.number(x + vx, y + vy), direction)
        } else {
            (pixel, (direction + 3) % 4)
        }
    }

    /// A pixel's place, the step along a side, forwards or backwards, and the step out of it.
    fn frame_of(&self, pixel: u32, direction: u32, sign: i64) -> ([i64; 2], [i64; 2], [i64; 2]) {
        let along = AHEAD[direction as usize % 4].map(|step| step * sign);
        (self.place_of(pixel), along, outward(direction))
    }

    fn number(&self, x: i64, y: i64) -> u32 {
        (y * i64::from(self.size[0]) + x) as u32
    }
}

/// The step from a pixel over its side: a quarter turn to the left of the way along it.
fn outward(direction: u32) -> [i64; 2] {
    AHEAD[(direction as usize + 3) % 4]
}

/// A side of a pixel with ink, and what shows there.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct Side {
    /// Four times the pixel plus the direction.
    pub code: u32,
    /// Number of the segment that inked the pixel.
    pub segment: u32,
    /// Reversed depth of what shows there, as bits.
    pub nearest: u32,
    /// From the start of the segment to its end, on the fine grid.
    pub extent: Planar,
}
gpu_layout!(Side {
    code,
    segment,
    nearest,
    extent
});

/// A picture whose ink was drawn by segments.
#[derive(Debug, Clone, Copy)]
pub struct InkPicture<'a> {
    /// Number of the segment of every pixel, plus one.
    pub ink: Ink<'a>,
    /// Its reversed depth as bits; empty where depths do not matter.
    pub nearest: &'a [u32],
    /// All segments; empty where they do not matter.
    pub segments: &'a [Segment],
}

impl<'a> From<Ink<'a>> for InkPicture<'a> {
    /// A picture of ink alone, without depths and directions.
    fn from(ink: Ink<'a>) -> Self {
        Self {
            ink,
            nearest: &[],
            segments: &[],
        }
    }
}

impl InkPicture<'_> {
    /// A side, and what its pixel shows.
    fn side(&self, pixel: u32, direction: u32) -> Side {
        let segment = self.ink.pixels[pixel as usize] - 1;
        let extent = self.segments.get(segment as usize).map(Segment::extent);
        let [x, y] = extent.unwrap_or_default();
        Side {
            code: 4 * pixel + direction,
            segment,
            nearest: self.nearest.get(pixel as usize).copied().unwrap_or(0),
            extent: Planar { x, y },
        }
    }
}

/// The sides of every [`PIXELS_A_WORD`] pixels of a picture of `size`, a bit for each direction of each pixel, and how
/// many there are. `ink` holds a bit for each pixel, [`BITS_A_WORD`] a word, and none beyond the last.
pub fn mark_sides([width, _]: [u32; 2], ink: &[u32], masks: &mut [u32], counts: &mut [u32]) {
    let word_at =
        |index: i64| usize::try_from(index).map_or(0, |i| ink.get(i).copied().unwrap_or(0));
    let ink_from = |pixel: i64| {
        let word = pixel.div_euclid(BITS_A_WORD as i64);
        let both = u64::from(word_at(word)) | u64::from(word_at(word + 1)) << BITS_A_WORD;
        (both >> pixel.rem_euclid(BITS_A_WORD as i64)) as u32
    };
    let outputs = masks.par_iter_mut().with_min_len(512).zip(counts);
    outputs.enumerate().for_each(|(word, (mask, count))| {
        // Pass over pixels without ink.
        (*mask, *count) = (0, 0);
        let first = word * PIXELS_A_WORD;
        let here = ink[first / BITS_A_WORD] >> (first % BITS_A_WORD) & 0xff;
        if here == 0 {
            return;
        }

        // Take the ink beside all eight: shifts of rows are neighbours.
        let at = first as i64;
        let beside = [at - i64::from(width), at + 1, at + i64::from(width), at - 1].map(ink_from);

        // Mark the directions in which there is none, or no pixel.
        for place in (0..PIXELS_A_WORD).filter(|place| here >> place & 1 != 0) {
            let column = (first + place) as u32 % width;
            let is_inside = [true, column + 1 < width, true, column > 0];
            for (direction, (ink, is_inside)) in beside.into_iter().zip(is_inside).enumerate() {
                let is_side = !is_inside || ink >> place & 1 == 0;
                *mask |= u32::from(is_side) << (4 * place + direction);
            }
        }
        *count = mask.count_ones();
    });
}

/// Links every side to those before and after it.
///
/// `starts` is the scan of the words' numbers of sides and `extent[0]` their sum. Sides come by pixel, then by
/// direction. Each element after the sum becomes a loop of its own. O(sides).
///
/// Differs: the publication leaves sides on the picture's border out and draws the border as a line to make up for
/// it; here there is no ink beyond the picture, and loops close along its border.
pub fn link_sides(
    extent: &[u32],
    picture: &InkPicture<'_>,
    masks: &[u32],
    starts: &[u32],
    sides: &mut [Side],
    links: &mut [Link],
) {
    // Find the number of a side from its pixel and direction.
    let ink = &picture.ink;
    let index_of = |(pixel, direction): (u32, u32)| {
        let (word, place) = (pixel as usize / PIXELS_A_WORD, pixel % PIXELS_A_WORD as u32);
        let before = masks[word] & ((1 << (4 * place + direction)) - 1);
        starts[word] + before.count_ones()
    };

    // Link the sides, and make a loop of every element beyond them.
    let count = extent[0];
    let outputs = sides.par_iter_mut().zip(links).enumerate();
    outputs.for_each(|(element, (side, link))| {
        let element = element as u32;
        *side = Side::default();
        link.next = element;
        link.prev = element;
        link.key = 0;
        if element < count {
            let word = holder_of(starts, element);
            let bit = nth_bit(masks[word as usize], element - starts[word as usize]);
            let (pixel, direction) = (PIXELS_A_WORD as u32 * word + bit / 4, bit % 4);
            *side = picture.side(pixel, direction);
            link.next = index_of(ink.after(pixel, direction));
            link.prev = index_of(ink.before(pixel, direction));
            link.key = key_of(ink.place_of(pixel).map(|v| v as u32), direction);
        }
    });
}

/// The index of the set bit of a mask before which `rank` other bits are set.
fn nth_bit(mask: u32, rank: u32) -> u32 {
    let mut left = mask;
    for _ in 0..rank {
        left &= left.wrapping_sub(1);
    }
    left.trailing_zeros()
}

/// The key by which ranking starts a loop at the side with the greatest Morton code, as published.
///
/// Ranking starts at the least hash of a key, so this is the key whose hash is the code's complement.
pub fn key_of([x, y]: [u32; 2], direction: u32) -> u32 {
    unmix_bits(!morton([2 * x + (direction >> 1), 2 * y + (direction & 1)]))
}

/// Bits of two 16-bit numbers in turns, those of the first lowest [Morton 1966].
pub fn morton([x, y]: [u32; 2]) -> u32 {
    let spread = |number: u32| {
        let mut v = number & 0xffff;
        v = (v | v << 8) & 0x00ff_00ff;
        v = (v | v << 4) & 0x0f0f_0f0f;
        v = (v | v << 2) & 0x3333_3333;
        (v | v << 1) & 0x5555_5555
    };
    spread(x) | spread(y) << 1
}

/// The number that [`npr_core::math::mix_bits`] maps to this one.
fn unmix_bits(number: u32) -> u32 {
    let mut x = number;
    x = (x ^ (x >> 16)).wrapping_mul(0x4302_1123);
    x = (x ^ (x >> 15) ^ (x >> 30)).wrapping_mul(0x1d69_e2a5);
    x ^ (x >> 16)
}
