//! Items gathered by a number: the first step of every sort in this crate that has to be fast.

use std::ops::Range;

use rayon::prelude::*;

/// Items of buckets `0..count`, in ascending order of their own numbers within each.
#[derive(Debug)]
pub(crate) struct Buckets<T> {
    /// Where each bucket starts in `items`; one more than there are buckets.
    starts: Vec<u32>,
    items: Vec<T>,
}

/// Consecutive buckets.
pub(crate) struct Run<'a, T> {
    buckets: &'a Buckets<T>,
    range: Range<usize>,
}

impl<T> Run<'_, T> {
    /// Visits each bucket that holds anything: where it starts among all items, and what it holds.
    pub(crate) fn for_each(&self, mut visit: impl FnMut(usize, &[T])) {
        for bounds in self.buckets.starts[self.range.start..=self.range.end].windows(2) {
            let [from, to] = [bounds[0] as usize, bounds[1] as usize];
            if from < to {
                visit(from, &self.buckets.items[from..to]);
            }
        }
    }
}

impl<T: Copy + Default + Sync> Buckets<T> {
    /// Counting sort of one item for every element of `bucket_of`, O(n).
    ///
    /// # Panics
    ///
    /// If an element is not below `count`, or there are 2^32 elements.
    pub(crate) fn new(count: usize, bucket_of: &[u32], item: impl Fn(u32) -> T) -> Self {
        assert!(
            u32::try_from(bucket_of.len()).is_ok(),
            "items have 32-bit numbers"
        );
        let mut starts = vec![0u32; count + 1];
        for &bucket in bucket_of {
            starts[bucket as usize] += 1;
        }
        let mut end = 0;
        for start in &mut starts {
            end += *start;
            *start = end;
        }
        // Fill every bucket from its end, last item first, which leaves its start behind.
        let mut items = vec![T::default(); bucket_of.len()];
        for (number, &bucket) in bucket_of.iter().enumerate().rev() {
            let start = &mut starts[bucket as usize];
            *start -= 1;
            items[*start as usize] = item(number as u32);
        }
        Self { starts, items }
    }

    /// What `visit` makes of runs of buckets, in order; which run holds what does not depend on threads.
    pub(crate) fn gather<R: Send>(&self, visit: impl Fn(Run<T>) -> R + Sync) -> Vec<R> {
        const RUN: usize = 8192;
        let count = self.starts.len() - 1;
        (0..count.div_ceil(RUN))
            .into_par_iter()
            .map(|run| {
                let range = run * RUN..((run + 1) * RUN).min(count);
                visit(Run {
                    buckets: self,
                    range,
                })
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn agrees_with_a_stable_sort(bucket_of in prop::collection::vec(0u32..20_000, 0..200)) {
            let buckets = Buckets::new(20_000, &bucket_of, |item| item);
            let mut expected: Vec<u32> = (0..bucket_of.len() as u32).collect();
            expected.sort_by_key(|&item| bucket_of[item as usize]);
            prop_assert_eq!(&buckets.items, &expected);

            let groups = buckets.gather(|run| {
                let mut groups = Vec::new();
                run.for_each(|start, items| groups.push((start, items.to_vec())));
                groups
            });
            let mut start = 0;
            for (found, items) in groups.into_iter().flatten() {
                prop_assert_eq!(found, start);
                prop_assert!(items.iter().all(|&i| bucket_of[i as usize] == bucket_of[items[0] as usize]));
                start += items.len();
            }
            prop_assert_eq!(start, bucket_of.len());
        }
    }

    #[test]
    fn no_items_leave_empty_buckets() {
        let buckets = Buckets::<u32>::new(0, &[], |item| item);
        assert!(buckets.gather(|_| ()).is_empty());
    }
}
