//! A device, and the detection of its failures.
//!
//! After a loss, wgpu's creations, writes and submits report nothing: only the callback and failing maps do. So a
//! [`Watch`] is installed before anything else, and every call asks it. A device of a host program keeps the handlers
//! of the host: there the watch asks the device.

use super::adapter::AdapterSummary;
use super::watch::{SOFTWARE_TIME_LIMIT, TIME_LIMIT, Watch, one_line};
use crate::engine::EngineError;
use npr_core::decoding::guard;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

/// What sessions share: the device, its queue, and its watch.
#[derive(Debug)]
pub(super) struct Gpu {
    pub(super) device: wgpu::Device,
    pub(super) queue: wgpu::Queue,
    pub(super) adapter: AdapterSummary,
    pub(super) watch: Arc<Watch>,
    /// How often work was submitted and waited for.
    pub(super) traffic: Mutex<Traffic>,
}

/// How often a device was given work, and how often the processor waited for it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Traffic {
    /// Submissions of commands.
    pub submits: usize,
    /// Waits for a submission.
    pub waits: usize,
}

impl Gpu {
    /// Fails if the device is lost, or reported an error outside of any call.
    pub(super) fn check(&self) -> Result<(), EngineError> {
        match self.watch.asks() {
            true => self.watch.verdict(),
            false => self.poll(wgpu::PollType::Poll),
        }
    }

    /// How long any call waits for the device before it counts as lost.
    pub(super) fn time_limit(&self) -> Duration {
        match self.adapter.is_software() {
            true => SOFTWARE_TIME_LIMIT,
            false => TIME_LIMIT,
        }
    }

    /// Waits for a submission, at most [`Self::time_limit`].
    pub(super) fn wait(&self, submission: wgpu::SubmissionIndex) -> Result<(), EngineError> {
        self.check()?;
        self.count(|traffic| traffic.waits += 1);
        self.poll(wgpu::PollType::Wait {
            submission_index: Some(submission),
            timeout: Some(self.time_limit()),
        })
    }

    fn count(&self, change: impl FnOnce(&mut Traffic)) {
        change(&mut self.traffic.lock().unwrap_or_else(PoisonError::into_inner));
    }

    fn poll(&self, kind: wgpu::PollType) -> Result<(), EngineError> {
        // wgpu 30 panics in here when the driver answers a wait with "device lost".
        match guard(|| self.device.poll(kind)) {
            Ok(Ok(_)) => {}
            Ok(Err(error)) => self.watch.lose(&error.to_string()),
            Err(_) => self.watch.lose("the driver stopped while waited for"),
        }
        self.watch.verdict()
    }

    /// Runs `work` and fails with the first error that the device reports meanwhile; the error names `place`.
    pub(super) fn guarded<T>(
        &self,
        place: &str,
        work: impl FnOnce() -> T,
    ) -> Result<T, EngineError> {
        self.scoped(work)
            .map_err(|error| self.failed(place, &error))
    }

    /// Records commands and submits them; gives what `record` made and the submission to wait for.
    pub(super) fn submit<T>(
        &self,
        place: &str,
        record: impl FnOnce(&mut wgpu::CommandEncoder) -> T,
    ) -> Result<(T, wgpu::SubmissionIndex), EngineError> {
        self.count(|traffic| traffic.submits += 1);
        self.guarded(place, || {
            let label = wgpu::CommandEncoderDescriptor { label: Some(place) };
            let mut encoder = self.device.create_command_encoder(&label);
            let made = record(&mut encoder);
            (made, self.queue.submit([encoder.finish()]))
        })
    }

    /// Runs `work` inside error scopes for everything that can be caught.
    pub(super) fn scoped<T>(&self, work: impl FnOnce() -> T) -> Result<T, wgpu::Error> {
        let filters = [
            wgpu::ErrorFilter::Internal,
            wgpu::ErrorFilter::OutOfMemory,
            wgpu::ErrorFilter::Validation,
        ];
        let scopes = filters.map(|filter| self.device.push_error_scope(filter));
        let made = work();
        // All scopes must close, in the reverse order of opening.
        let errors: Vec<_> = scopes
            .into_iter()
            .rev()
            .filter_map(|scope| pollster::block_on(scope.pop()))
            .collect();
        errors.into_iter().next().map_or(Ok(made), Err)
    }

    /// The error to return for one that wgpu reported: the loss of the device, if that caused it.
    pub(super) fn failed(&self, place: &str, error: &dyn std::error::Error) -> EngineError {
        let failure = EngineError::Failed {
            place: place.to_owned(),
            reason: one_line(&error.to_string()),
        };
        self.check().err().unwrap_or(failure)
    }
}
