//! The interface of what runs a graph: the processor with the twins, or a graphics device with the shaders.

use crate::graph::{Graph, ResourceId};
use std::time::Duration;

/// Why an engine could not do its work.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum EngineError {
    /// There is no graphics device to run on.
    #[error("no graphics device: {reason}")]
    NoDevice {
        /// What the driver said.
        reason: String,
    },
    /// The device refused memory for a resource.
    #[error("the graphics device has no room for '{resource}' ({bytes} bytes)")]
    OutOfMemory {
        /// Name of the resource.
        resource: &'static str,
        /// Its size.
        bytes: u64,
    },
    /// The device stopped working.
    #[error("the graphics device was lost: {reason}")]
    Lost {
        /// What the driver said.
        reason: String,
    },
    /// The device does not do what every WebGPU device must.
    #[error("the graphics device failed at {place}: {reason}")]
    Failed {
        /// The pass or resource.
        place: String,
        /// What the driver said.
        reason: String,
    },
}

/// How long one pass took.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PassTime {
    /// Name of the pass.
    pub name: &'static str,
    /// Wall time on the processor, device time on a device that has a clock.
    pub time: Duration,
}

/// An engine that runs graphs.
pub trait Engine {
    /// One line for people: which processor or device, which driver.
    fn describe(&self) -> String;

    /// Whether passes run as their twins, so that plain functions with the same results may replace them.
    fn runs_twins(&self) -> bool {
        false
    }

    /// Makes the resources of a graph, all zero, ready to run as often as wanted.
    ///
    /// # Errors
    ///
    /// [`EngineError`] where the device refuses; the processor engine never does.
    fn prepare(&self, graph: Graph) -> Result<Box<dyn Session>, EngineError>;
}

/// A graph with its memory.
pub trait Session {
    /// Fills a resource from the start with words; later words keep their values.
    ///
    /// # Errors
    ///
    /// [`EngineError`] where the device is lost.
    fn write(&mut self, id: ResourceId, words: &[u32]) -> Result<(), EngineError>;

    /// Runs every node once, in order.
    ///
    /// # Errors
    ///
    /// [`EngineError`] where the device fails or is lost; nothing may be read back then.
    fn run(&mut self) -> Result<Vec<PassTime>, EngineError>;

    /// The words of a resource; texels row by row for an image.
    ///
    /// # Errors
    ///
    /// [`EngineError`] where the device is lost.
    fn read(&mut self, id: ResourceId) -> Result<Vec<u32>, EngineError>;
}
