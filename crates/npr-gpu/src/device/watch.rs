//! The reports of a device outside of any call.

use crate::engine::EngineError;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::time::Duration;

/// How long any call waits for the device before it counts as lost.
pub const TIME_LIMIT: Duration = Duration::from_secs(30);

/// The same of a device that computes on the processor: it compiles passes while it is waited for, which takes half a
/// minute where all processors are busy.
pub const SOFTWARE_TIME_LIMIT: Duration = Duration::from_secs(180);

/// What is said of a device that the program itself gave up.
pub(super) const GIVEN_UP: &str = "it was given up";

/// The reports of a device outside of any call; the first of each kind counts.
#[derive(Debug, Default)]
pub(super) struct Watch {
    lost: OnceLock<String>,
    uncaptured: OnceLock<String>,
    /// What a device is asked by whose handlers are another's.
    probe: Option<Probe>,
}

/// A buffer of a word that a device can map as long as it is not lost.
#[derive(Debug)]
struct Probe(Mutex<wgpu::Buffer>);

impl Watch {
    /// A watch with both handlers installed.
    pub(super) fn over(device: &wgpu::Device) -> Arc<Self> {
        let watch = Arc::new(Self::default());
        let on_loss = watch.clone();
        device.set_device_lost_callback(move |reason, message| {
            let given_up = reason == wgpu::DeviceLostReason::Destroyed;
            on_loss.lose(if given_up { GIVEN_UP } else { &message });
        });
        let on_error = watch.clone();
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            on_error
                .uncaptured
                .get_or_init(|| one_line(&error.to_string()));
        }));
        watch
    }

    /// A watch over a device whose handlers belong to another: it asks the device itself.
    pub(super) fn beside(device: &wgpu::Device) -> Arc<Self> {
        Arc::new(Self {
            probe: Some(Probe::new(device)),
            ..Self::default()
        })
    }

    /// Whether it asks the device, which then needs no poll.
    pub(super) fn asks(&self) -> bool {
        self.probe.is_some()
    }

    /// Marks the device as lost.
    pub(super) fn lose(&self, reason: &str) {
        self.lost.get_or_init(|| one_line(reason));
    }

    /// Fails if anything was reported so far.
    pub(super) fn verdict(&self) -> Result<(), EngineError> {
        let is_known = self.lost.get().is_some();
        if !is_known && self.probe.as_ref().is_some_and(|probe| !probe.answers()) {
            self.lose("it takes no more work");
        }
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

impl Probe {
    fn new(device: &wgpu::Device) -> Self {
        let buffer = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("probe"),
            size: 4,
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        Self(Mutex::new(buffer))
    }

    /// Whether the device is still there. Nothing is submitted, and nothing of the host's is called.
    ///
    /// A lost device refuses to map at once; any other starts to, which is called off.
    fn answers(&self) -> bool {
        let buffer = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let refused = Arc::new(AtomicBool::new(false));
        let on_refusal = refused.clone();
        buffer
            .slice(..)
            .map_async(wgpu::MapMode::Read, move |mapped| {
                on_refusal.store(mapped.is_err(), Ordering::Relaxed);
            });
        let is_refused = refused.load(Ordering::Relaxed);
        if !is_refused {
            buffer.unmap();
        }
        !is_refused
    }
}

/// A driver's message without its line breaks, cut to a length that fits a report.
pub(super) fn one_line(message: &str) -> String {
    let words: Vec<&str> = message.split_whitespace().collect();
    words.join(" ").chars().take(400).collect()
}
