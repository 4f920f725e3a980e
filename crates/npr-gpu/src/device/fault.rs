//! Noticing what goes wrong on a device.
//!
//! After a loss, wgpu's creations, writes and submits report nothing: only the callback and failing maps do. So a
//! [`Watch`] is installed before anything else, and every call asks it.

use super::Gpu;
use crate::engine::EngineError;
use npr_core::decoding::guard;
use std::sync::{Arc, OnceLock};
use std::time::Duration;

/// How long any call waits for the device before it counts as lost.
pub const TIME_LIMIT: Duration = Duration::from_secs(30);

/// What the device reported outside of any call; the first of each kind counts.
#[derive(Debug, Default)]
pub(super) struct Watch {
    lost: OnceLock<String>,
    uncaptured: OnceLock<String>,
}

impl Watch {
    /// A watch with both handlers installed.
    pub(super) fn over(device: &wgpu::Device) -> Arc<Self> {
        let watch = Arc::new(Self::default());
        let on_loss = watch.clone();
        device.set_device_lost_callback(move |reason, message| {
            let given_up = reason == wgpu::DeviceLostReason::Destroyed;
            on_loss.lose(if given_up {
                "it was given up"
            } else {
                &message
            });
        });
        let on_error = watch.clone();
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            on_error
                .uncaptured
                .get_or_init(|| one_line(&error.to_string()));
        }));
        watch
    }

    /// Marks the device as lost.
    fn lose(&self, reason: &str) {
        self.lost.get_or_init(|| one_line(reason));
    }

    /// Fails if anything was reported so far.
    fn verdict(&self) -> Result<(), EngineError> {
        if let Some(reason) = self.lost.get() {
            return Err(EngineError::Lost {
                reason: reason.clone(),
            });
        }
        match self.uncaptured.get() {
            Some(reason) => Err(EngineError::Failed {
                place: "an unchecked call".to_owned(),
                reason: reason.clone(),
            }),
            None => Ok(()),
        }
    }
}

impl Gpu {
    /// Fails if the device is lost or reported an error that no call took.
    pub(super) fn check(&self) -> Result<(), EngineError> {
        self.poll(wgpu::PollType::Poll)
    }

    /// Waits for a submission, at most [`TIME_LIMIT`].
    pub(super) fn wait(&self, submission: wgpu::SubmissionIndex) -> Result<(), EngineError> {
        self.check()?;
        self.poll(wgpu::PollType::Wait {
            submission_index: Some(submission),
            timeout: Some(TIME_LIMIT),
        })
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

    /// Runs `work` and fails with the first error that the device reports meanwhile, `place` named in it.
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

    /// The error to return for what wgpu reported: the loss of the device, if that is behind it.
    pub(super) fn failed(&self, place: &str, error: &dyn std::error::Error) -> EngineError {
        let failure = EngineError::Failed {
            place: place.to_owned(),
            reason: one_line(&error.to_string()),
        };
        self.check().err().unwrap_or(failure)
    }
}

/// A driver's message without its line breaks, cut to a length that fits a report.
fn one_line(message: &str) -> String {
    let words: Vec<&str> = message.split_whitespace().collect();
    words.join(" ").chars().take(400).collect()
}
