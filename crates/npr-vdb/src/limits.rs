//! What reading may cost at most.

use crate::fault::Fault;

/// How much memory reading may take before a file is refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// Bytes of one grid, its dense copy included; default 4 GiB. The file's own bytes do not count.
    pub memory_bytes: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            memory_bytes: 4 << 30,
        }
    }
}

/// What may still be planned.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Budget {
    limit_bytes: u64,
    used_bytes: u64,
}

impl Budget {
    pub(crate) fn new(limits: &Limits) -> Self {
        Self {
            limit_bytes: limits.memory_bytes,
            used_bytes: 0,
        }
    }

    /// Plans `count` elements of type `T`.
    pub(crate) fn take<T>(&mut self, what: &'static str, count: usize) -> Result<(), Fault> {
        let needed = (count as u64).saturating_mul(size_of::<T>() as u64);
        let planned = self.used_bytes.saturating_add(needed);
        if planned > self.limit_bytes {
            return Err(Fault::Memory {
                what,
                bytes: planned,
                limit: self.limit_bytes,
            });
        }
        self.used_bytes = planned;
        Ok(())
    }

    /// Plans `count` more elements of a list that grows by doubling.
    pub(crate) fn grow<T>(&mut self, what: &'static str, count: usize) -> Result<(), Fault> {
        self.take::<T>(what, count.saturating_mul(2))
    }

    /// An empty list with room for `count` elements, planned first.
    pub(crate) fn list<T>(&mut self, what: &'static str, count: usize) -> Result<Vec<T>, Fault> {
        self.take::<T>(what, count)?;
        let mut list = Vec::new();
        list.try_reserve_exact(count)
            .map_err(|_| Fault::OutOfMemory {
                what,
                bytes: (count as u64).saturating_mul(size_of::<T>() as u64),
            })?;
        Ok(list)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig { cases: 1000, ..ProptestConfig::default() })]

        #[test]
        fn never_grants_more_than_its_limit(limit in 0u64..10_000, asks in prop::collection::vec(0usize..800, 0..20)) {
            let mut budget = Budget::new(&Limits { memory_bytes: limit });
            let granted: usize = asks.into_iter().filter(|&count| budget.take::<[u8; 12]>("test", count).is_ok()).sum();
            prop_assert!(granted as u64 * 12 <= limit);
        }
    }

    #[test]
    fn sizes_that_overflow_are_refused() {
        let mut budget = Budget::new(&Limits {
            memory_bytes: u64::MAX - 1,
        });
        assert!(budget.grow::<[u8; 64]>("test", usize::MAX).is_err());
        assert!(budget.list::<[u8; 64]>("test", usize::MAX / 8).is_err());
    }
}
