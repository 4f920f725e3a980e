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

impl<T: Copy + Default + Send + Sync> Buckets<T> {
    /// Counting sort of one item for every element of `bucket_of`, all below `count`; O(n).
    ///
    /// Every thread reads all elements, but counts and places only those of its own strip of buckets: what is
    /// slow about a counting sort is writing all over the memory.
    ///
    /// # Panics
    ///
    /// If there are 2^32 elements.
    pub(crate) fn new(count: usize, bucket_of: &[u32], item: impl Fn(u32) -> T + Sync) -> Self {
        let item_count = u32::try_from(bucket_of.len()).expect("items have 32-bit numbers");
        let strip = count.div_ceil(rayon::current_num_threads().min(8)).max(1);
        let mut starts = vec![0u32; count + 1];
        starts[..count]
            .par_chunks_mut(strip)
            .enumerate()
            .for_each(|(number, counts)| {
                for &bucket in bucket_of {
                    let own = (bucket as usize).wrapping_sub(number * strip);
                    if let Some(count) = counts.get_mut(own) {
                        *count += 1;
                    }
                }
            });
        let mut end = 0;
        for start in &mut starts {
            end += *start;
            *start = end;
        }

        // Fill every bucket from its end, last item first, which leaves its start behind.
        let mut items = vec![T::default(); bucket_of.len()];
        let fill = |(number, (ends, items)): (usize, (&mut [u32], Strip<T>))| {
            for (item_number, &bucket) in (0..item_count).zip(bucket_of).rev() {
                let own = (bucket as usize).wrapping_sub(number * strip);
                if let Some(end) = ends.get_mut(own) {
                    *end -= 1;
                    items.items[*end as usize - items.start] = item(item_number);
                }
            }
        };
        let strips = Strip::cut(&mut items, starts[..count].chunks(strip));
        starts[..count]
            .par_chunks_mut(strip)
            .zip(strips)
            .enumerate()
            .for_each(fill);
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

/// The items of consecutive buckets, and where they start among all.
struct Strip<'a, T> {
    start: usize,
    items: &'a mut [T],
}

impl<'a, T> Strip<'a, T> {
    /// Cuts items where the last bucket of each strip ends.
    fn cut<'b>(mut items: &'a mut [T], strips: impl Iterator<Item = &'b [u32]>) -> Vec<Self> {
        let mut start = 0;
        strips
            .map(|ends| {
                let end = ends.last().map_or(start, |&end| end as usize);
                let (own, rest) = std::mem::take(&mut items).split_at_mut(end - start);
                items = rest;
                let strip = Self { start, items: own };
                start = end;
                strip
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
