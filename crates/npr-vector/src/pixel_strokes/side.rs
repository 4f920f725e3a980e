//! Sides of contour pixels, linked to closed loops: the twins of `vector.mark_sides` and `vector.link_sides`.
//!
//! A side lies between a pixel with ink and one without. Sides run clockwise around ink as one sees it: along the upper
//! side to the right, down the right one, back along the lower, and up the left one.

use super::fragment::holder_of;
use crate::rank::Link;
use rayon::prelude::*;

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

/// The sides of every pixel, a bit for each direction, and how many there are.
pub fn mark_sides(ink: &Ink<'_>, masks: &mut [u32], counts: &mut [u32]) {
    let outputs = masks.par_iter_mut().with_min_len(4096).zip(counts);
    outputs.enumerate().for_each(|(pixel, (mask, count))| {
        *mask = ink.sides_of(pixel as u32);
        *count = mask.count_ones();
    });
}

/// Links every side to those before and after it.
///
/// `starts` is the scan of the pixels' numbers of sides and `extent[0]` their sum. A side is written as four times its
/// pixel plus its direction; sides come by pixel, then by direction. Each element after the sum becomes a loop of its
/// own. O(sides).
///
/// Differs: the publication leaves sides on the picture's border out and draws the border as a line to make up for
/// it; here there is no ink beyond the picture, and loops close along its border.
pub fn link_sides(
    extent: &[u32],
    ink: &Ink<'_>,
    masks: &[u32],
    starts: &[u32],
    sides: &mut [u32],
    links: &mut [Link],
) {
    // Find the number of a side from its pixel and direction.
    let index_of = |(pixel, direction): (u32, u32)| {
        let before = masks[pixel as usize] & ((1 << direction) - 1);
        starts[pixel as usize] + before.count_ones()
    };

    // Link the sides, and make a loop of every element beyond them.
    let count = extent[0];
    let outputs = sides.par_iter_mut().zip(links).enumerate();
    outputs.for_each(|(element, (side, link))| {
        let element = element as u32;
        *side = 0;
        link.next = element;
        link.prev = element;
        link.key = 0;
        if element < count {
            let pixel = holder_of(starts, element);
            let direction = nth_bit(masks[pixel as usize], element - starts[pixel as usize]);
            *side = 4 * pixel + direction;
            link.next = index_of(ink.after(pixel, direction));
            link.prev = index_of(ink.before(pixel, direction));
            link.key = key_of(ink.place_of(pixel).map(|v| v as u32), direction);
        }
    });
}

/// The index of the set bit of a mask before which `rank` other bits are set.
fn nth_bit(mask: u32, rank: u32) -> u32 {
    let mut left = rank;
    let mut found = 0;
    for bit in 0..4 {
        if mask >> bit & 1 != 0 {
            if left == 0 {
                found = bit;
                break;
            }
            left -= 1;
        }
    }
    found
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
