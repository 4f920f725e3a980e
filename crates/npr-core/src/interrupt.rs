//! A flag that ends work which nobody wants any more.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Ends work that was begun: one thread raises it, another that works asks it between two steps and gives up.
///
/// Clones share the flag. The default one can never be raised, for work that is always done to its end.
///
/// ```
/// use npr_core::interrupt::{Interrupt, Interrupted};
///
/// let interrupt = Interrupt::new();
/// assert_eq!(interrupt.check(), Ok(()));
/// interrupt.clone().raise();
/// assert_eq!(interrupt.check(), Err(Interrupted));
/// ```
#[derive(Debug, Clone, Default)]
pub struct Interrupt(Option<Arc<AtomicBool>>);

/// Work was ended before it was done.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("the work was interrupted")]
pub struct Interrupted;

impl Interrupt {
    /// What can never be raised.
    pub const NEVER: Self = Self(None);

    /// A flag that is lowered.
    pub fn new() -> Self {
        Self(Some(Arc::default()))
    }

    /// Ends the work that heeds it, until it is [lowered](Self::lower). Of the default one nothing comes.
    pub fn raise(&self) {
        self.set(true);
    }

    /// Lets work go on that starts from now on.
    pub fn lower(&self) {
        self.set(false);
    }

    /// Whether work is to end.
    pub fn is_raised(&self) -> bool {
        // Nothing else is handed over by the flag.
        self.0
            .as_ref()
            .is_some_and(|flag| flag.load(Ordering::Relaxed))
    }

    /// Fails where work is to end, for `?` between two steps.
    ///
    /// # Errors
    ///
    /// [`Interrupted`] while the flag is raised.
    pub fn check(&self) -> Result<(), Interrupted> {
        match self.is_raised() {
            true => Err(Interrupted),
            false => Ok(()),
        }
    }

    fn set(&self, is_raised: bool) {
        if let Some(flag) = &self.0 {
            flag.store(is_raised, Ordering::Relaxed);
        }
    }
}

/// Whether both are the same flag, or none.
impl PartialEq for Interrupt {
    fn eq(&self, other: &Self) -> bool {
        match (&self.0, &other.0) {
            (Some(flag), Some(other)) => Arc::ptr_eq(flag, other),
            (None, None) => true,
            _ => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_clones_are_raised_and_lowered_together() {
        let interrupt = Interrupt::new();
        let clone = interrupt.clone();
        interrupt.raise();
        assert!(clone.is_raised());
        clone.lower();
        assert!(!interrupt.is_raised());
        assert!(interrupt == clone && interrupt != Interrupt::new());
    }

    #[test]
    fn the_default_one_is_never_raised() {
        let never = Interrupt::default();
        never.raise();
        assert_eq!(never.check(), Ok(()));
        assert!(never == Interrupt::default() && never != Interrupt::new());
    }
}
