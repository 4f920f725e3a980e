//! Memory that the results of a run are copied to before they are read.

use super::clock::Clock;
use super::gpu::Gpu;
use super::memory::Memory;
use super::staging::Staging;
use crate::engine::EngineError;
use crate::graph::{Graph, Kind, ResourceId};
use std::collections::BTreeMap;

/// Memory that the results of a run are copied to before they are read, kept from run to run.
///
/// Each of two runs in flight has one of its own: the second may have run before the first is read.
#[derive(Debug, Default)]
pub(super) struct Room {
    results: BTreeMap<ResourceId, Staging>,
    stamps: Option<Staging>,
}

impl Room {
    /// Makes place for copies of resources, where it was not made before or is too small by now.
    pub(super) fn fit_results(
        &mut self,
        gpu: &Gpu,
        (graph, memory): (&Graph, &[Memory]),
        ids: &[ResourceId],
    ) -> Result<(), EngineError> {
        for id in ids {
            let resource = graph.resource(*id);
            let has_place = self.results.get(id).is_some_and(|place| {
                // Only buffers grow.
                let grew = matches!(resource.kind, Kind::Buffer { .. })
                    && place.word_count() < resource.word_count();
                !grew
            });
            if !has_place {
                let make = || memory[id.index()].staging(gpu, resource.word_count());
                let made = gpu.guarded(resource.name, make)?;
                self.results.insert(*id, made);
            }
        }
        Ok(())
    }

    /// Makes place for the stamps of a clock, where there is one and it was not made before.
    pub(super) fn fit_stamps(
        &mut self,
        gpu: &Gpu,
        clock: Option<&Clock>,
    ) -> Result<(), EngineError> {
        if let (Some(clock), None) = (clock, &self.stamps) {
            self.stamps = Some(gpu.guarded("the clock", || clock.staging(gpu))?);
        }
        Ok(())
    }

    /// Records the copies of resources, for which there is place.
    pub(super) fn stage_results(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        memory: &[Memory],
        ids: &[ResourceId],
    ) {
        for id in ids {
            memory[id.index()].stage(encoder, &self.results[id]);
        }
    }

    /// Records the copy of the stamps of a clock, for which there is place; every pass must have run.
    pub(super) fn stage_stamps(&self, encoder: &mut wgpu::CommandEncoder, clock: &Clock) {
        if let Some(stamps) = &self.stamps {
            clock.stage(encoder, stamps);
        }
    }

    /// Where resources were copied to, in this order.
    pub(super) fn results(&self, ids: &[ResourceId]) -> impl Iterator<Item = &Staging> {
        ids.iter().map(|id| &self.results[id])
    }

    /// Where the stamps of the clock were copied to, if there is one.
    pub(super) fn stamps(&self) -> Option<&Staging> {
        self.stamps.as_ref()
    }

    /// How many copies it has place for.
    #[cfg(test)]
    pub(super) fn count(&self) -> usize {
        self.results.len() + usize::from(self.stamps.is_some())
    }
}
