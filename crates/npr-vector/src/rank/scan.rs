//! Prefix sums, and their use: putting marked elements in a row.
//!
//! Where an order shows in the picture, elements are numbered by sums, never by which comes first to a shared counter.

use rayon::prelude::*;

/// Elements that one invocation adds up.
pub const RUN: usize = 8;

/// Elements that one workgroup of 64 invocations adds up.
pub const BLOCK: usize = 64 * RUN;

/// Sums of all values before each within its block, and the sum of every block: the twin of `vector.scan_blocks`.
///
/// Sums are those of 32-bit numbers and wrap. After the sum of the last block, zeros fill `sums` up to a whole block,
/// as far as there is room, so that sums of sums may be taken in whole blocks.
///
/// Differs: an invocation adds up a run, and a workgroup the sums of runs; sums of integers are the same in any order.
pub fn scan_blocks(values: &[u32], prefixes: &mut [u32], sums: &mut [u32]) {
    let (sums, behind) = sums.split_at_mut(values.len().div_ceil(BLOCK).min(sums.len()));
    let whole = sums.len().next_multiple_of(BLOCK) - sums.len();
    behind.iter_mut().take(whole).for_each(|sum| *sum = 0);
    let blocks = values
        .par_chunks(BLOCK)
        .zip(prefixes.par_chunks_mut(BLOCK).zip(sums));
    blocks.for_each(|(values, (prefixes, sum))| {
        *sum = 0;
        for (prefix, value) in prefixes.iter_mut().zip(values) {
            *prefix = *sum;
            *sum = sum.wrapping_add(*value);
        }
    });
}

/// Adds to every prefix the sum of all blocks before its own: the twin of `vector.scan_add`.
pub fn scan_add(prefixes_in: &[u32], offsets: &[u32], prefixes_out: &mut [u32]) {
    let blocks = prefixes_in
        .par_chunks(BLOCK)
        .zip(prefixes_out.par_chunks_mut(BLOCK).zip(offsets));
    blocks.for_each(|(from, (to, offset))| {
        for (to, from) in to.iter_mut().zip(from) {
            *to = from.wrapping_add(*offset);
        }
    });
}

/// Writes the indices of marked elements in a row: the twin of `vector.compact`.
///
/// `slots` is the scan of `flags`, which are 0 and 1. Entries after the last index keep their values; indices that the
/// list has no room for are left out, and the sum of all flags tells how many there were.
pub fn compact(flags: &[u32], slots: &[u32], list: &mut [u32]) {
    for (element, (flag, slot)) in (0..).zip(flags.iter().zip(slots)) {
        if *flag != 0 && (*slot as usize) < list.len() {
            list[*slot as usize] = element;
        }
    }
}

/// The sum of all values before each, and the sum of all: [`scan_blocks`] and [`scan_add`], level upon level.
///
/// ```
/// let (prefixes, sum) = npr_vector::rank::scan::exclusive_scan(&[3, 0, 2]);
/// assert_eq!((prefixes, sum), (vec![0, 3, 3], 5));
/// ```
pub fn exclusive_scan(values: &[u32]) -> (Vec<u32>, u32) {
    let mut prefixes = vec![0; values.len()];
    let mut sums = vec![0; values.len().div_ceil(BLOCK)];
    scan_blocks(values, &mut prefixes, &mut sums);
    if sums.len() <= 1 {
        return (prefixes, sums.first().copied().unwrap_or_default());
    }
    let (offsets, total) = exclusive_scan(&sums);
    let mut whole = vec![0; values.len()];
    scan_add(&prefixes, &offsets, &mut whole);
    (whole, total)
}
