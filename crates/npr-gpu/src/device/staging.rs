//! Memory that the device writes and the processor reads.

use super::gpu::Gpu;
use crate::engine::EngineError;
use rayon::prelude::*;
use std::sync::mpsc;

/// Words that one thread copies at a time.
const PIECE_WORDS: usize = 1 << 16;

/// What a message calls the copying of results.
const READING: &str = "the reading of results";

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

    /// Words that it has room for.
    pub(super) fn word_count(&self) -> usize {
        self.row_words * self.row_count
    }

    /// The words of several, once `submission` has filled them; waits once for all.
    pub(super) fn words_of<'a>(
        gpu: &Gpu,
        stagings: impl Iterator<Item = &'a Self>,
        submission: wgpu::SubmissionIndex,
    ) -> Result<Vec<Vec<u32>>, EngineError> {
        // Ask for all of them, then wait.
        let asked = stagings.map(|staging| {
            let (sender, receiver) = mpsc::channel();
            gpu.guarded(READING, || {
                let tell = move |result| drop(sender.send(result));
                staging.buffer.map_async(wgpu::MapMode::Read, .., tell);
            })?;
            Ok((staging, receiver))
        });
        let asked: Vec<_> = asked.collect::<Result<_, EngineError>>()?;
        gpu.wait(submission)?;

        // Copy what came. Another thread that waits for its own work may be the one that runs the callback, a little
        // later.
        let words = asked.into_iter().map(|(staging, receiver)| {
            match receiver.recv_timeout(gpu.time_limit()) {
                Ok(Ok(())) => staging.copied(gpu),
                Ok(Err(error)) => Err(gpu.failed(READING, &error)),
                Err(error) => Err(gpu.failed(READING, &error)),
            }
        });
        words.collect()
    }

    /// The words of the buffer, which the processor may read until this returns.
    ///
    /// Parallel: most of the time goes to memory that is touched for the first time.
    fn copied(&self, gpu: &Gpu) -> Result<Vec<u32>, EngineError> {
        let mut words = vec![0; self.word_count()];
        {
            let view = self
                .buffer
                .slice(..)
                .get_mapped_range()
                .map_err(|error| gpu.failed(READING, &error))?;
            let is_dense = self.row_bytes == self.row_words * 4;
            let (piece_words, piece_bytes) = match is_dense {
                true => (PIECE_WORDS, PIECE_WORDS * 4),
                false => (self.row_words, self.row_bytes),
            };
            let pieces = words.par_chunks_mut(piece_words.max(1));
            let filled = pieces.zip(view.par_chunks(piece_bytes.max(1)));
            filled.for_each(|(words, bytes)| {
                let (bytes, _) = bytes.as_chunks();
                for (word, bytes) in words.iter_mut().zip(bytes) {
                    *word = u32::from_le_bytes(*bytes);
                }
            });
        }
        self.buffer.unmap();
        Ok(words)
    }
}
