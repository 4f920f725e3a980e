//! Loops in the batches that they are found in.

use super::decompose::{Loops, PixelLoop};
use std::sync::Arc;

/// Batches of loops, which are numbered through.
///
/// Threads that work on a batch hold it too. It is freed where it was made, with all others: threads that free each
/// other's memory wait for each other.
#[derive(Debug, Default)]
pub(super) struct Batches {
    parts: Vec<Arc<Loops>>,
    /// The number of each one's first loop.
    firsts: Vec<usize>,
    count: usize,
    step_count: usize,
}

impl Batches {
    /// Puts a batch behind the others.
    pub fn push(&mut self, mut batch: Loops) -> Arc<Loops> {
        batch.shrink();
        self.firsts.push(self.count);
        self.count += batch.len();
        self.step_count += batch.step_count();
        let batch = Arc::new(batch);
        self.parts.push(Arc::clone(&batch));
        batch
    }

    /// How many loops there are.
    pub fn len(&self) -> usize {
        self.count
    }

    /// Steps of all loops.
    pub fn step_count(&self) -> usize {
        self.step_count
    }

    /// The loop of a number.
    pub fn get(&self, number: usize) -> Option<PixelLoop<'_>> {
        let after = self.firsts.partition_point(|first| *first <= number);
        let part = after.checked_sub(1)?;
        self.parts.get(part)?.get(number - self.firsts.get(part)?)
    }

    /// All loops in order.
    pub fn iter(&self) -> impl Iterator<Item = PixelLoop<'_>> + Clone {
        self.parts.iter().flat_map(|batch| batch.iter())
    }
}
