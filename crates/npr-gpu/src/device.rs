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
pub use watch::TIME_LIMIT;

use crate::engine::{Engine, EngineError, Session};
use crate::graph::Graph;
use gpu::Gpu;
use pipeline::PipelineCache;
use session::DeviceSession;
use std::sync::Arc;
use watch::Watch;

/// A graphics device, ready to run graphs.
///
/// Shaders are compiled when a graph first needs them and kept as long as the device. Sessions keep the device alive.
#[derive(Debug)]
pub struct Device {
    gpu: Arc<Gpu>,
    pipelines: PipelineCache,
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
        };
        Ok(Self {
            gpu: Arc::new(gpu),
            pipelines: PipelineCache::default(),
        })
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
        let session = DeviceSession::new(self.gpu.clone(), &self.pipelines, graph)?;
        Ok(Box::new(session))
    }
}
