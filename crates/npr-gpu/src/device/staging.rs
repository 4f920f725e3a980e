//! Memory that the device writes and the processor reads.

use super::gpu::Gpu;
use super::watch::TIME_LIMIT;
use crate::engine::EngineError;
use std::sync::mpsc;

/// A mappable buffer with rows of words, each padded as copies from images demand.
#[derive(Debug)]
pub(super) struct Staging {
    /// The buffer that copies go into.
    pub(super) buffer: wgpu::Buffer,
    /// Bytes from one row to the next.
    pub(super) row_bytes: usize,
    row_words: usize,
    row_count: usize,
}

impl Staging {
    /// Room for `word_count` words without gaps.
    pub(super) fn of_words(device: &wgpu::Device, word_count: usize) -> Self {
        Self::new(device, word_count, word_count * 4, 1)
    }

    /// Room for an image.
    pub(super) fn of_rows(device: &wgpu::Device, size: [u32; 2]) -> Self {
        let row_words = size[0] as usize;
        let row_bytes =
            (row_words * 4).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT as usize);
        Self::new(device, row_words, row_bytes, size[1] as usize)
    }

    fn new(device: &wgpu::Device, row_words: usize, row_bytes: usize, row_count: usize) -> Self {
        let buffer = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("staging"),
            size: ((row_bytes * row_count) as u64).max(4),
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        Self {
            buffer,
            row_bytes,
            row_words,
            row_count,
        }
    }

    /// The words, once `submission` has filled them.
    pub(super) fn words(
        &self,
        gpu: &Gpu,
        place: &str,
        submission: wgpu::SubmissionIndex,
    ) -> Result<Vec<u32>, EngineError> {
        self.map(gpu, place, submission)?;
        let view = self
            .buffer
            .slice(..)
            .get_mapped_range()
            .map_err(|error| gpu.failed(place, &error))?;
        let mut words = Vec::with_capacity(self.row_words * self.row_count);
        for row in view.chunks(self.row_bytes.max(1)).take(self.row_count) {
            let (row, _) = row[..self.row_words * 4].as_chunks();
            words.extend(row.iter().map(|bytes| u32::from_le_bytes(*bytes)));
        }
        Ok(words)
    }

    /// Waits until the processor may read.
    fn map(
        &self,
        gpu: &Gpu,
        place: &str,
        submission: wgpu::SubmissionIndex,
    ) -> Result<(), EngineError> {
        let (sender, receiver) = mpsc::channel();
        gpu.guarded(place, || {
            self.buffer
                .map_async(wgpu::MapMode::Read, .., move |result| {
                    drop(sender.send(result))
                });
        })?;
        gpu.wait(submission)?;
        // Another thread that waits for its own work may be the one that runs the callback, a little later.
        match receiver.recv_timeout(TIME_LIMIT) {
            Ok(Ok(())) => Ok(()),
            Ok(Err(error)) => Err(gpu.failed(place, &error)),
            Err(error) => Err(gpu.failed(place, &error)),
        }
    }
}
