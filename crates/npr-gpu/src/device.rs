//! The engine that runs the shaders on a graphics device, through wgpu.
//!
//! It asks for what every WebGPU device has and for nothing else, apart from a clock where there is one. Every call
//! that may fail runs inside error scopes, every wait ends after [`TIME_LIMIT`], and once the device is lost every
//! call says so instead of returning what was left in memory.

mod adapter;
mod clock;
mod gpu;
mod image;
mod memory;
mod pipeline;
mod session;
mod staging;
mod step;
#[cfg(any(test, feature = "testing"))]
pub mod testing;
mod watch;

pub use adapter::{AdapterChoice, AdapterKind, AdapterSummary, adapters};
pub use gpu::Traffic;
pub use watch::TIME_LIMIT;

use crate::engine::{Engine, EngineError, Session};
use crate::graph::Graph;
use gpu::Gpu;
use pipeline::PipelineCache;
use session::DeviceSession;
use std::sync::{Arc, Mutex, PoisonError};
use watch::Watch;

/// A graphics device, ready to run graphs.
///
/// Shaders are compiled when a graph first needs them and kept as long as the device. Sessions keep the device alive.
#[derive(Debug)]
pub struct Device {
    gpu: Arc<Gpu>,
    pipelines: PipelineCache,
    times_apart: bool,
}

impl Device {
    /// Opens the best adapter that `choice` admits: discrete before integrated before virtual before software.
    ///
    /// Takes some tens of milliseconds.
    ///
    /// # Errors
    ///
    /// [`EngineError::NoDevice`] where no adapter fits, or none of those that fit can be opened.
    pub fn open(choice: AdapterChoice) -> Result<Self, EngineError> {
        let (adapter, device, queue) = adapter::open(choice)?;
        let watch = Watch::over(&device);
        let gpu = Gpu {
            device,
            queue,
            adapter,
            watch,
            traffic: Mutex::default(),
        };
        Ok(Self {
            gpu: Arc::new(gpu),
            pipelines: PipelineCache::default(),
            times_apart: false,
        })
    }

    /// The same device with times of passes that can be believed.
    ///
    /// Devices without a clock of their own, and software, whose clock stamps passes before they have run, submit and
    /// wait for every pass alone from now on; a frame takes a little longer. Hardware with a clock stays as it is.
    #[must_use]
    pub fn timing_passes(self) -> Self {
        Self {
            times_apart: self.gpu.adapter.is_software() || !self.has_clock(),
            ..self
        }
    }

    /// How often it was given work so far, and waited for.
    pub fn traffic(&self) -> Traffic {
        *self
            .gpu
            .traffic
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
    }

    /// The adapter that this device belongs to.
    pub fn adapter(&self) -> &AdapterSummary {
        &self.gpu.adapter
    }

    /// Whether pass times come from the device's own clock.
    pub fn has_clock(&self) -> bool {
        self.gpu
            .device
            .features()
            .contains(wgpu::Features::TIMESTAMP_QUERY)
    }

    /// Gives the device up at once: every session of it reports [`EngineError::Lost`] from here on.
    pub fn destroy(&self) {
        self.gpu.device.destroy();
    }
}

impl Engine for Device {
    fn describe(&self) -> String {
        self.gpu.adapter.to_string()
    }

    fn prepare(&self, graph: Graph) -> Result<Box<dyn Session>, EngineError> {
        let session =
            DeviceSession::new(self.gpu.clone(), &self.pipelines, graph, self.times_apart)?;
        Ok(Box::new(session))
    }
}
