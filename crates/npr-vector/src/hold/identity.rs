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

/// One that asks for an identity.
pub(super) struct Claimant {
    /// Its own one.
    pub own: u64,
    /// How many of its samples were of each in the frame before.
    pub counts: BTreeMap<u64, usize>,
}

/// Gives strokes the identities of the lines that they were: that with most samples on each line takes its identity,
/// and what is left has its own, made of mesh edges.
///
/// A stroke that is a part of a line takes over from strokes, one that is a whole line from lines: so what was in parts
/// is called as its line was. An own one that is taken gets the first free number above it. Ties are broken by own
/// identities, so the order of strokes decides only between two with the same.
pub(super) fn settle_ids(strokes: &mut [Stroke], tallies: &[Tally], lines: &[Line]) {
    let claimants = strokes.iter().zip(tallies).map(|(stroke, tally)| Claimant {
        own: stroke.id,
        counts: tally.counts(|line| match stroke.part {
            Some(_) => lines[line].id,
            None => lines[line].whole_id,
        }),
    });
    let ids = settled(&claimants.collect::<Vec<_>>());
    for (stroke, id) in strokes.iter_mut().zip(ids) {
        stroke.id = id;
    }
}

/// The identity of each claimant, none twice: of the frame before to the one that has most of it, else its own.
pub(super) fn settled(claimants: &[Claimant]) -> Vec<u64> {
    // Let each ask for those that it has much of.
    let mut claims: Vec<(Reverse<usize>, u64, u64, usize)> = Vec::new();
    for (index, claimant) in claimants.iter().enumerate() {
        let least = LEAST_SHARE * claimant.counts.values().sum::<usize>() as f64;
        let large = claimant
            .counts
            .iter()
            .filter(|(_, count)| **count as f64 >= least);
        claims.extend(large.map(|(id, count)| (Reverse(*count), claimant.own, *id, index)));
    }
    claims.sort_unstable();

    // Give each to the first that asks and has none.
    let mut ids: Vec<Option<u64>> = vec![None; claimants.len()];
    let mut used: BTreeSet<u64> = BTreeSet::new();
    for (_, _, id, index) in claims {
        if ids[index].is_none() && used.insert(id) {
            ids[index] = Some(id);
        }
    }

    // Name the others by themselves.
    let mut left: Vec<usize> = (0..claimants.len())
        .filter(|index| ids[*index].is_none())
        .collect();
    left.sort_by_key(|index| (claimants[*index].own, *index));
    for index in left {
        let own = claimants[index].own;
        let mut numbers = (0_u64..).map(|number| own.wrapping_add(number << OWN_BITS));
        ids[index] = numbers.find(|id| used.insert(*id));
    }
    let own = ids.into_iter().zip(claimants);
    own.map(|(id, claimant)| id.unwrap_or(claimant.own))
        .collect()
}
