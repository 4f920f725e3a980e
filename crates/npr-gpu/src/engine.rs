//! The interface of what runs a graph: the processor with the twins, or a graphics device with the shaders.

use crate::flight;
use crate::graph::{Graph, ResourceId};
use bytemuck::AnyBitPattern;
use npr_core::interrupt::{Interrupt, Interrupted};
use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

pub use crate::flight::IN_FLIGHT;

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
    /// Somebody ended the work before it was done.
    #[error(transparent)]
    Interrupted(#[from] Interrupted),
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

    /// Whether the times of a run are those of each pass. Else passes share one time, or have times that mean little.
    fn tells_passes_apart(&self) -> bool {
        true
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
    /// Fills a resource from its word `first` on with words; all others keep their values. Runs in flight do not see
    /// them. An image takes words from its start alone.
    ///
    /// # Errors
    ///
    /// [`EngineError`] where the device is lost.
    ///
    /// # Panics
    ///
    /// Where the resource has no room for them, or is an image and `first` is not 0.
    fn write_at(&mut self, id: ResourceId, first: usize, words: &[u32]) -> Result<(), EngineError>;

    /// The same from the start.
    ///
    /// # Errors
    ///
    /// As [`Session::write_at`].
    fn write(&mut self, id: ResourceId, words: &[u32]) -> Result<(), EngineError> {
        self.write_at(id, 0, words)
    }

    /// The same with words that others keep too: an engine that has its resources in the memory of the processor may
    /// read them where they are.
    ///
    /// # Errors
    ///
    /// As [`Session::write`].
    fn write_shared(&mut self, id: ResourceId, words: &Arc<Vec<u32>>) -> Result<(), EngineError> {
        self.write(id, words)
    }

    /// Makes room in a buffer for `count` elements, where it has less; nothing else of the graph changes. Runs in
    /// flight keep the memory that they started with.
    ///
    /// What a buffer held is gone where it grows: it is all zero, as at first.
    ///
    /// # Errors
    ///
    /// [`EngineError`] where the device refuses the memory or is lost; the session is as it was then.
    ///
    /// # Panics
    ///
    /// Where the resource is no buffer.
    fn grow(&mut self, id: ResourceId, count: usize) -> Result<(), EngineError>;

    /// Asks a flag between two passes of every run from now on, where the engine can end a run that has begun: the
    /// processor can, a device works on.
    fn heed(&mut self, interrupt: &Interrupt) {
        let _ = interrupt;
    }

    /// Starts a run of every node, in order, and of the reading of resources, each named once, after those that were
    /// started before. [`Session::collect`] gives what comes of it.
    ///
    /// A device works on the run from here on, in one submission, and nobody waits for it: the processor is free to
    /// prepare the next one. [`Session::write`] takes effect in runs that start later. The processor engine has done
    /// all of it when this returns, and so has a device that times its passes one by one.
    ///
    /// # Errors
    ///
    /// [`EngineError`] where the device fails or is lost, or the run is [interrupted](Self::heed); no run is started
    /// then, and what resources hold may not be read.
    ///
    /// # Panics
    ///
    /// Where [`IN_FLIGHT`] runs are started and not collected.
    fn submit(&mut self, ids: &[ResourceId]) -> Result<(), EngineError>;

    /// Waits once for the run that was started first of those that are not collected, and gives the time of its passes
    /// and what it read.
    ///
    /// # Errors
    ///
    /// [`EngineError`] where the device fails or is lost; the run counts as collected then, and nothing of it may be
    /// read.
    ///
    /// # Panics
    ///
    /// Where no run is in flight.
    fn collect(&mut self) -> Result<(Vec<PassTime>, Readings), EngineError>;

    /// How many runs are started and not collected, at most [`IN_FLIGHT`].
    fn in_flight(&self) -> usize;

    /// Reads resources as the last run left them, each named once, all at once.
    ///
    /// # Errors
    ///
    /// [`EngineError`] where the device is lost.
    ///
    /// # Panics
    ///
    /// Where a run is in flight.
    fn read_all(&mut self, ids: &[ResourceId]) -> Result<Readings, EngineError>;

    /// Runs every node once, in order, and reads resources, each named once: a device does all of it at once and is
    /// waited for once.
    ///
    /// # Errors
    ///
    /// [`EngineError`] where the device fails or is lost; nothing may be read back then.
    ///
    /// # Panics
    ///
    /// Where a run is in flight.
    fn run_reading(
        &mut self,
        ids: &[ResourceId],
    ) -> Result<(Vec<PassTime>, Readings), EngineError> {
        flight::check_none(self.in_flight());
        self.submit(ids)?;
        self.collect()
    }

    /// Runs every node once, in order.
    ///
    /// # Errors
    ///
    /// As [`Session::run_reading`].
    ///
    /// # Panics
    ///
    /// Where a run is in flight.
    fn run(&mut self) -> Result<Vec<PassTime>, EngineError> {
        Ok(self.run_reading(&[])?.0)
    }

    /// The words of a resource; texels row by row for an image.
    ///
    /// # Errors
    ///
    /// As [`Session::read_all`].
    ///
    /// # Panics
    ///
    /// Where a run is in flight.
    fn read(&mut self, id: ResourceId) -> Result<Vec<u32>, EngineError> {
        Ok(self.read_all(&[id])?.take(id))
    }
}

/// A session of any engine is a session.
impl Session for Box<dyn Session> {
    fn write_at(&mut self, id: ResourceId, first: usize, words: &[u32]) -> Result<(), EngineError> {
        self.as_mut().write_at(id, first, words)
    }

    fn write_shared(&mut self, id: ResourceId, words: &Arc<Vec<u32>>) -> Result<(), EngineError> {
        self.as_mut().write_shared(id, words)
    }

    fn grow(&mut self, id: ResourceId, count: usize) -> Result<(), EngineError> {
        self.as_mut().grow(id, count)
    }

    fn heed(&mut self, interrupt: &Interrupt) {
        self.as_mut().heed(interrupt);
    }

    fn submit(&mut self, ids: &[ResourceId]) -> Result<(), EngineError> {
        self.as_mut().submit(ids)
    }

    fn collect(&mut self) -> Result<(Vec<PassTime>, Readings), EngineError> {
        self.as_mut().collect()
    }

    fn in_flight(&self) -> usize {
        self.as_ref().in_flight()
    }

    fn read_all(&mut self, ids: &[ResourceId]) -> Result<Readings, EngineError> {
        self.as_mut().read_all(ids)
    }
}

/// The words of some resources; texels row by row for images.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Readings {
    words: BTreeMap<ResourceId, Vec<u32>>,
}

impl Readings {
    /// Takes the words of a resource out.
    ///
    /// # Panics
    ///
    /// When it was not read, or taken before.
    pub fn take(&mut self, id: ResourceId) -> Vec<u32> {
        let words = self.words.remove(&id);
        words.unwrap_or_else(|| panic!("{id:?} was not read, or taken before"))
    }

    /// The words of a resource.
    ///
    /// # Panics
    ///
    /// As [`Readings::take`].
    pub fn words(&self, id: ResourceId) -> &[u32] {
        let words = self.words.get(&id);
        words.unwrap_or_else(|| panic!("{id:?} was not read, or taken before"))
    }

    /// Takes the first `count` elements of a resource out.
    ///
    /// # Panics
    ///
    /// As [`Readings::take`].
    pub fn take_first<T: AnyBitPattern>(&mut self, id: ResourceId, count: usize) -> Vec<T> {
        let mut words = self.take(id);
        words.truncate(count * size_of::<T>() / 4);
        bytemuck::cast_slice(&words).to_vec()
    }

    /// Takes the first word of a resource out, a count.
    ///
    /// # Panics
    ///
    /// As [`Readings::take`].
    pub fn take_count(&mut self, id: ResourceId) -> usize {
        self.take(id).first().map_or(0, |count| *count as usize)
    }
}

impl FromIterator<(ResourceId, Vec<u32>)> for Readings {
    fn from_iter<I: IntoIterator<Item = (ResourceId, Vec<u32>)>>(pairs: I) -> Self {
        Self {
            words: pairs.into_iter().collect(),
        }
    }
}
