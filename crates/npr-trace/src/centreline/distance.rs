//! How far ink is from white.

use crate::Bitmap;

/// The square of the distance from a pixel's middle to the nearest white one's; 0 of a white pixel. Outside of the
/// picture all is white.
///
/// The Euclidean distance transform at one place, exact. Rows are looked at from the pixel's outwards, 64 pixels at a
/// time, until they are further away than what was found: O(d + d^2 / 64) for distance d, and no memory. Lines need
/// the distance along their middle only.
pub fn distance2(bitmap: &Bitmap, x: u32, y: u32) -> u64 {
    let mut best = u64::MAX;
    for down in 0..=u64::from(bitmap.height()) {
        let down2 = down * down;
        if down2 >= best {
            break;
        }
        for row in [i64::from(y) - down as i64, i64::from(y) + down as i64] {
            // The nearest white pixel of the row counts only if it is nearer than what is known.
            let words = usize::try_from(row).map_or(&[][..], |row| bitmap.row(row));
            let across = white_beside(words, x as usize, best - down2);
            best = best.min(down2 + across * across);
        }
    }
    best
}

/// How far the nearest white pixel of a row lies from a place in it; [`FAR`] where the square exceeds `limit2`.
fn white_beside(words: &[u64], x: usize, limit2: u64) -> u64 {
    let (at, bit) = (x / 64, x % 64);
    let Some(here) = words.get(at) else {
        return 0;
    };

    // Look right, then left, a word at a time.
    let right = search(
        !here >> bit,
        64 - bit as u64,
        limit2,
        u64::trailing_zeros,
        |step| words.get(at + step).copied(),
    );
    let left = search(
        !here << (63 - bit),
        bit as u64 + 1,
        limit2,
        u64::leading_zeros,
        |step| words.get(at.checked_sub(step)?).copied(),
    );
    right.min(left)
}

/// Steps to the first bit of white, which begins with a part of a word and goes on with whole ones; `next` gives ink.
fn search(
    first: u64,
    covered: u64,
    limit2: u64,
    zeros: impl Fn(u64) -> u32,
    next: impl Fn(usize) -> Option<u64>,
) -> u64 {
    // The first word may hold it.
    if first != 0 {
        return u64::from(zeros(first));
    }

    // Go on until the reach exceeds the limit.
    let mut reach = covered;
    for step in 1.. {
        if reach * reach > limit2 {
            return FAR;
        }
        match next(step) {
            Some(u64::MAX) => reach += 64,
            Some(ink) => return reach + u64::from(zeros(!ink)),
            None => return reach,
        }
    }
    FAR
}

/// Further than any side, with a square that fits.
const FAR: u64 = 1 << 30;
