//! What strokes are called: as in the frame before, each name once.

use super::remembered::Line;
use super::votes::Tally;
use crate::stroke::Stroke;
use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};

/// Least share of a stroke's votes that makes it the one that was called so.
const LEAST_SHARE: f64 = 0.3;

/// Bits of an identity below those that tell apart strokes on the same mesh edge.
const OWN_BITS: u32 = 45;

/// Gives strokes the identities of the lines that they were: that with most samples on each line takes its identity,
/// and what is left has its own, made of mesh edges.
///
/// An own one that is taken gets the first free number above it. Ties are broken by own identities, so the order of
/// strokes decides only between two with the same.
pub(super) fn settle_ids(strokes: &mut [Stroke], tallies: &[Tally], lines: &[Line]) {
    // Count how much of every identity each stroke has.
    let mut claims: Vec<(Reverse<usize>, u64, u64, usize)> = Vec::new();
    for (index, tally) in tallies.iter().enumerate() {
        let mut counts: BTreeMap<u64, usize> = BTreeMap::new();
        for (count, line) in &tally.lines {
            *counts.entry(lines[*line as usize].id).or_default() += count;
        }
        let least = LEAST_SHARE * tally.vote_count as f64;
        let large = counts
            .into_iter()
            .filter(|(_, count)| *count as f64 >= least);
        claims.extend(large.map(|(id, count)| (Reverse(count), strokes[index].id, id, index)));
    }
    claims.sort_unstable();

    // Give each to the first that asks and has none.
    let mut ids: Vec<Option<u64>> = vec![None; strokes.len()];
    let mut used: BTreeSet<u64> = BTreeSet::new();
    for (_, _, id, index) in claims {
        if ids[index].is_none() && used.insert(id) {
            ids[index] = Some(id);
        }
    }

    // Name the others by themselves.
    let mut left: Vec<usize> = (0..strokes.len())
        .filter(|index| ids[*index].is_none())
        .collect();
    left.sort_by_key(|index| (strokes[*index].id, *index));
    for index in left {
        let own = strokes[index].id;
        let mut numbers = (0_u64..).map(|number| own.wrapping_add(number << OWN_BITS));
        ids[index] = numbers.find(|id| used.insert(*id));
    }
    for (stroke, id) in strokes.iter_mut().zip(ids) {
        stroke.id = id.unwrap_or(stroke.id);
    }
}
