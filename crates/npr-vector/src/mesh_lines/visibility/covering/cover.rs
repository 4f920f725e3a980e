//! The covered parts of a line, joined where they meet.

/// Number of parts that are collected before they are joined.
const BATCH: usize = 64;

/// Parts of a line, joined where they meet.
#[derive(Debug, Default)]
pub(super) struct Cover {
    /// Joined parts: ascending, apart from each other.
    pub(super) joined: Vec<[f64; 2]>,
    /// Parts found since the last joining.
    pub(super) found: Vec<[f64; 2]>,
    /// Gaps shorter than this need no test: nobody would see them.
    pub(super) unseen: f64,
}

impl Cover {
    /// Adds a part. O(log n) on average.
    pub(super) fn add(&mut self, part: Option<[f64; 2]>) {
        self.found.extend(part);
        // The longer the list, the rarer it is gone through.
        if self.found.len() >= BATCH.max(self.joined.len()) || part.is_some_and(is_long) {
            self.join();
        }
    }

    pub(super) fn join(&mut self) {
        let mut parts = std::mem::take(&mut self.joined);
        parts.append(&mut self.found);
        parts.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
        for part in parts {
            match self.joined.last_mut() {
                Some(last) if part[0] <= last[1] => last[1] = last[1].max(part[1]),
                _ => self.joined.push(part),
            }
        }
    }

    /// Whether a part is covered by joined parts, except for gaps too short to see.
    pub(super) fn holds(&self, [from, to]: [f64; 2]) -> bool {
        let first = self.joined.partition_point(|part| part[1] <= from);
        let mut reached = from;
        for [start, end] in &self.joined[first..] {
            if *start - reached > self.unseen || to - reached <= self.unseen {
                break;
            }
            reached = *end;
        }
        to - reached <= self.unseen
    }
}

/// Whether a part is joined at once, so that what it covers is not tested again.
fn is_long([from, to]: [f64; 2]) -> bool {
    to - from > 1.0 / 16.0
}
