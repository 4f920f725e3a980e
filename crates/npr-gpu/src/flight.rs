//! Runs of a session that are started and not collected.

use std::collections::VecDeque;

/// Most runs of a session that are started and not collected: a device works on one while the processor prepares the
/// next and takes what the one before left.
pub const IN_FLIGHT: usize = 2;

/// The runs of a session that are started and not collected, the one that started first in front.
#[derive(Debug)]
pub(crate) struct Flight<R>(VecDeque<R>);

impl<R> Flight<R> {
    /// No runs.
    pub fn new() -> Self {
        Self(VecDeque::with_capacity(IN_FLIGHT))
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.0.len()
    }

    /// Checks that another run may start.
    ///
    /// # Panics
    ///
    /// Where [`IN_FLIGHT`] runs are in flight.
    pub fn check_room(&self) {
        assert!(
            self.count() < IN_FLIGHT,
            "{IN_FLIGHT} runs are in flight: collect the first before another starts"
        );
    }

    /// Adds a run that was started.
    pub fn push(&mut self, run: R) {
        self.0.push_back(run);
    }

    /// Takes the run that started first.
    ///
    /// # Panics
    ///
    /// Where none is in flight.
    pub fn pop(&mut self) -> R {
        let first = self.0.pop_front();
        first.unwrap_or_else(|| panic!("no run is in flight: submit one before you collect it"))
    }
}

/// Checks that nobody still waits for a run.
///
/// # Panics
///
/// Where runs are in flight.
pub(crate) fn check_none(in_flight: usize) {
    assert!(
        in_flight == 0,
        "runs are in flight ({in_flight}): collect them first"
    );
}
