//! Why lines are not found.

use npr_core::budget::OverBudget;
use npr_core::interrupt::Interrupted;

/// Why the lines of a view were not found.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum FindError {
    /// They would take more memory than the settings allow.
    #[error(transparent)]
    Memory(#[from] OverBudget),
    /// Somebody ended the work.
    #[error(transparent)]
    Interrupted(#[from] Interrupted),
}
