//! The engine that runs the shaders on a graphics device, through wgpu.
//!
//! It asks for what every WebGPU device has and for nothing else, apart from a clock where there is one. Every call
//! that may fail runs inside error scopes, every wait ends after [`TIME_LIMIT`], or [`SOFTWARE_TIME_LIMIT`], and once
//! the device is lost every call says so instead of returning what was left in memory.

mod adapter;
mod clock;
mod gpu;
mod image;
mod inlay;
mod memory;
mod pipeline;
mod room;
mod session;
mod staging;
mod step;
#[cfg(any(test, feature = "testing"))]
pub mod testing;
mod watch;

pub use adapter::{AdapterChoice, AdapterKind, AdapterSummary, adapters};
pub use gpu::Traffic;
pub use inlay::{DepthTarget, Inlay, Target, TargetFormat};
pub use session::DeviceSession;
pub use watch::{SOFTWARE_TIME_LIMIT, TIME_LIMIT};
pub use wgpu;

use crate::engine::{Engine, EngineError, Session};
use crate::graph::Graph;
use gpu::Gpu;
use pipeline::PipelineCache;
use std::sync::{Arc, Mutex, PoisonError};
use watch::{GIVEN_UP, Watch};

/// A graphics device, ready to run graphs.
///
/// Shaders are compiled when a graph first needs them and kept as long as the device. Sessions keep the device alive.
/// A clone is the same device.
#[derive(Debug, Clone)]
pub struct Device {
    gpu: Arc<Gpu>,
    pipelines: Arc<PipelineCache>,
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
        Ok(Self::of(adapter, device, queue, watch))
    }

    /// A device that another program opened and goes on using: sessions record into its encoders
    /// ([`DeviceSession::record`]) or run by themselves.
    ///
    /// The handlers of the program for errors and for loss stay its own: all that is made here is made inside error
    /// scopes, and loss is found by asking the device. Nothing is global, and nothing is polled until a session runs
    /// by itself.
    ///
    /// # Errors
    ///
    /// [`EngineError::NoDevice`] where the device was opened with less than the least limits of WebGPU, which are
    /// `wgpu::Limits::default()`, or the adapter lacks what every WebGPU adapter has; the first thing that is missing
    /// is named. [`EngineError::Lost`] where the device is lost already.
    pub fn from_wgpu(
        adapter: &wgpu::Adapter,
        device: wgpu::Device,
        queue: wgpu::Queue,
    ) -> Result<Self, EngineError> {
        let summary = AdapterSummary::of(adapter);
        if let Some(lacking) = adapter::lacking(adapter, &device.limits()) {
            let reason = format!("{} lacks {lacking}", summary.name);
            return Err(EngineError::NoDevice { reason });
        }
        let watch = Watch::beside(&device);
        let device = Self::of(summary, device, queue, watch);
        device.gpu.check()?;
        Ok(device)
    }

    fn of(
        adapter: AdapterSummary,
        device: wgpu::Device,
        queue: wgpu::Queue,
        watch: Arc<Watch>,
    ) -> Self {
        let gpu = Gpu {
            device,
            queue,
            adapter,
            watch,
            traffic: Mutex::default(),
        };
        Self {
            gpu: Arc::new(gpu),
            pipelines: Arc::default(),
            times_apart: false,
        }
    }

    /// Makes the resources of a graph, as [`Engine::prepare`] does, in a session that can be recorded.
    ///
    /// # Errors
    ///
    /// As [`Engine::prepare`].
    pub fn session(&self, graph: Graph) -> Result<DeviceSession, EngineError> {
        DeviceSession::new(self.gpu.clone(), &self.pipelines, graph, self.times_apart)
    }

    /// The same device with times of passes that can be believed.
    ///
    /// Devices without a clock of their own, and software, whose clock stamps passes before they have run, submit and
    /// wait for every pass alone from now on; a frame takes a little longer. Hardware with a clock stays as it is.
    #[must_use]
    pub fn timing_passes(self) -> Self {
        Self {
            times_apart: !self.has_true_clock(),
            ..self
        }
    }

    /// Whether it has a clock that stamps passes when they run.
    fn has_true_clock(&self) -> bool {
        self.has_clock() && !self.gpu.adapter.is_software()
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
        // wgpu tells of it once nothing is in flight any more.
        self.gpu.watch.lose(GIVEN_UP);
        self.gpu.device.destroy();
    }
}

impl Engine for Device {
    fn describe(&self) -> String {
        self.gpu.adapter.to_string()
    }

    fn tells_passes_apart(&self) -> bool {
        self.times_apart || self.has_true_clock()
    }

    fn prepare(&self, graph: Graph) -> Result<Box<dyn Session>, EngineError> {
        Ok(Box::new(self.session(graph)?))
    }
}
