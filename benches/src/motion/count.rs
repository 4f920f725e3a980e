//! How often things happen in a sequence of frames, by cause.

use std::collections::BTreeMap;

/// How often something happened, and where most of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Count {
    /// Samples or ends.
    pub count: usize,
    /// Events that they belong to.
    pub events: usize,
    /// The largest event: samples or ends, number of the pair of frames, place in the later one.
    pub largest: (usize, usize, [f64; 2]),
}

/// What happened, by cause.
pub type Counts<T> = BTreeMap<T, Count>;

/// Adds an event of `count` samples or ends.
pub(super) fn add<T: Ord>(
    counts: &mut Counts<T>,
    cause: T,
    count: usize,
    (pair, place): (usize, [f64; 2]),
) {
    let entry = counts.entry(cause).or_insert(Count {
        count: 0,
        events: 0,
        largest: (0, 0, [0.0; 2]),
    });
    entry.count += count;
    entry.events += 1;
    if count > entry.largest.0 {
        entry.largest = (count, pair, place);
    }
}
