//! A running total of planned memory, asked before every allocation that depends on input.

/// More memory was asked for than the limit allows.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{what} needs {needed_bytes} bytes, but only {left_bytes} of {limit_bytes} bytes are left")]
pub struct OverBudget {
    /// What asked for it, for the message.
    pub what: String,
    /// How many bytes it asked for; `u64::MAX` where the size itself overflows.
    pub needed_bytes: u64,
    /// How many were left.
    pub left_bytes: u64,
    /// The limit as set.
    pub limit_bytes: u64,
}

/// How much memory may still be planned.
#[derive(Debug, Clone)]
pub struct Budget {
    limit_bytes: u64,
    used_bytes: u64,
}

impl Budget {
    /// A budget of `limit_bytes`, none of it used.
    pub fn new(limit_bytes: u64) -> Self {
        Self {
            limit_bytes,
            used_bytes: 0,
        }
    }

    /// Plans `count` elements of `element_bytes` each for `what`, with checked arithmetic.
    ///
    /// # Errors
    ///
    /// [`OverBudget`] when that is more than is left; nothing is planned then.
    pub fn take(
        &mut self,
        what: &str,
        count: usize,
        element_bytes: usize,
    ) -> Result<(), OverBudget> {
        let needed = (count as u64).saturating_mul(element_bytes as u64);
        let left = self.limit_bytes - self.used_bytes;
        if needed > left {
            return Err(OverBudget {
                what: what.to_owned(),
                needed_bytes: needed,
                left_bytes: left,
                limit_bytes: self.limit_bytes,
            });
        }
        self.used_bytes += needed;
        Ok(())
    }

    /// Bytes planned so far.
    pub fn used_bytes(&self) -> u64 {
        self.used_bytes
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn never_grants_more_than_its_limit(
            limit in 0u64..10_000, asks in prop::collection::vec((0usize..5_000, 0usize..50), 0..20),
        ) {
            let mut budget = Budget::new(limit);
            let mut granted = 0u64;
            for (count, size) in asks {
                if budget.take("test", count, size).is_ok() {
                    granted += (count * size) as u64;
                }
            }
            prop_assert!(granted <= limit);
            prop_assert_eq!(granted, budget.used_bytes());
        }
    }

    #[test]
    fn a_size_that_overflows_is_refused() {
        let mut budget = Budget::new(u64::MAX);
        assert!(budget.take("first byte", 1, 1).is_ok());
        assert!(budget.take("all of it", usize::MAX, 64).is_err());
    }
}
