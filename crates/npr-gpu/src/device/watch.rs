//! The reports of a device outside of any call.

use crate::engine::EngineError;
use std::sync::{Arc, OnceLock};
use std::time::Duration;

/// How long any call waits for the device before it counts as lost.
pub const TIME_LIMIT: Duration = Duration::from_secs(30);

/// The reports of a device outside of any call; the first of each kind counts.
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
    pub(super) fn lose(&self, reason: &str) {
        self.lost.get_or_init(|| one_line(reason));
    }

    /// Fails if anything was reported so far.
    pub(super) fn verdict(&self) -> Result<(), EngineError> {
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

/// A driver's message without its line breaks, cut to a length that fits a report.
pub(super) fn one_line(message: &str) -> String {
    let words: Vec<&str> = message.split_whitespace().collect();
    words.join(" ").chars().take(400).collect()
}
