//! The device's own clock: two time stamps per pass.

use super::gpu::Gpu;
use super::staging::Staging;
use std::time::Duration;

/// Queries for the time stamps of a number of passes.
#[derive(Debug)]
pub(super) struct Clock {
    queries: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    pass_count: u32,
    tick_ns: f64,
}

impl Clock {
    /// A clock for passes numbered below `pass_count`; `None` where the device has none, or not for so many.
    pub(super) fn new(gpu: &Gpu, pass_count: usize) -> Option<Self> {
        // Go without where the device cannot time so many passes.
        let has_clock = gpu
            .device
            .features()
            .contains(wgpu::Features::TIMESTAMP_QUERY);
        if !has_clock || pass_count == 0 || pass_count > wgpu::QUERY_SET_MAX_QUERIES as usize / 2 {
            return None;
        }

        // Make room for two time stamps a pass.
        let pass_count = pass_count as u32;
        let queries = gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
            label: Some("clock"),
            ty: wgpu::QueryType::Timestamp,
            count: 2 * pass_count,
        });
        let resolved = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("clock"),
            size: 16 * u64::from(pass_count),
            usage: wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        });
        let tick_ns = f64::from(gpu.queue.get_timestamp_period());
        Some(Self {
            queries,
            resolved,
            pass_count,
            tick_ns,
        })
    }

    /// Stamps for compute pass `pass`.
    pub(super) fn compute_stamps(&self, pass: u32) -> wgpu::ComputePassTimestampWrites<'_> {
        wgpu::ComputePassTimestampWrites {
            query_set: &self.queries,
            beginning_of_pass_write_index: Some(2 * pass),
            end_of_pass_write_index: Some(2 * pass + 1),
        }
    }

    /// Stamps for draw pass `pass`.
    pub(super) fn draw_stamps(&self, pass: u32) -> wgpu::RenderPassTimestampWrites<'_> {
        wgpu::RenderPassTimestampWrites {
            query_set: &self.queries,
            beginning_of_pass_write_index: Some(2 * pass),
            end_of_pass_write_index: Some(2 * pass + 1),
        }
    }

    /// Room for all stamps, where the processor can read them.
    pub(super) fn staging(&self, gpu: &Gpu) -> Staging {
        Staging::of_words(&gpu.device, 4 * self.pass_count as usize)
    }

    /// Records the copy of all stamps to such room; every pass must have run.
    pub(super) fn stage(&self, encoder: &mut wgpu::CommandEncoder, staging: &Staging) {
        encoder.resolve_query_set(&self.queries, 0..2 * self.pass_count, &self.resolved, 0);
        let bytes = 16 * u64::from(self.pass_count);
        encoder.copy_buffer_to_buffer(&self.resolved, 0, &staging.buffer, 0, bytes);
    }

    /// How long each pass took, by the words of all stamps.
    pub(super) fn times(&self, words: &[u32]) -> Vec<Duration> {
        let stamp = |low: u32, high: u32| u64::from(low) | u64::from(high) << 32;
        let (passes, _) = words.as_chunks::<4>();
        let ticks = passes
            .iter()
            .map(|&[a, b, c, d]| stamp(c, d).saturating_sub(stamp(a, b)));
        ticks
            .map(|ticks| Duration::from_nanos((ticks as f64 * self.tick_ns) as u64))
            .collect()
    }
}
