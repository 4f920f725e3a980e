//! The buffers and images behind the resources of a graph.

use super::gpu::Gpu;
use super::image::Image;
use super::staging::Staging;
use crate::engine::EngineError;
use crate::graph::{Kind, Resource};
use crate::pass::Access;

/// The memory of a resource on the device.
#[derive(Debug)]
pub(super) enum Memory {
    /// An array or a uniform; at least one element, since empty buffers cannot be bound.
    Buffer(wgpu::Buffer),
    /// A picture.
    Image(Image),
}

impl Memory {
    /// Zeroed memory for a resource.
    ///
    /// `more` adds usages of a buffer besides binding and copying.
    pub(super) fn new(
        gpu: &Gpu,
        resource: &Resource,
        more: wgpu::BufferUsages,
    ) -> Result<Self, EngineError> {
        // Refuse what the limits rule out, then take the memory.
        check_size(&gpu.device.limits(), resource)?;
        let made = gpu.scoped(|| match resource.kind {
            Kind::Uniform { size } => Self::Buffer(new_buffer(
                gpu,
                resource.name,
                size,
                wgpu::BufferUsages::UNIFORM,
            )),
            Kind::Buffer { stride, count } => Self::Buffer(new_buffer(
                gpu,
                resource.name,
                stride * count.max(1),
                wgpu::BufferUsages::STORAGE | more,
            )),
            Kind::Image {
                format,
                size,
                layers,
            } => Self::Image(Image::new(gpu, resource.name, format, size, layers)),
        });

        // Tell a device that is full from one that failed.
        made.map_err(|error| match error {
            wgpu::Error::OutOfMemory { .. } => out_of_memory(resource),
            other => gpu.failed(resource.name, &other),
        })
    }

    /// How the memory is bound to a slot.
    pub(super) fn binding(&self, access: Access) -> wgpu::BindingResource<'_> {
        match (self, access) {
            (Self::Buffer(buffer), _) => buffer.as_entire_binding(),
            (Self::Image(image), Access::Layered(_)) => {
                wgpu::BindingResource::TextureView(&image.all)
            }
            (Self::Image(image), _) => wgpu::BindingResource::TextureView(&image.layers[0]),
        }
    }

    /// The image, where it is one.
    pub(super) fn image(&self) -> Option<&Image> {
        match self {
            Self::Buffer(_) => None,
            Self::Image(image) => Some(image),
        }
    }

    /// Overwrites it from a word on; an image from its start.
    pub(super) fn write_at(&self, queue: &wgpu::Queue, first: usize, words: &[u32]) {
        match self {
            Self::Buffer(buffer) => {
                queue.write_buffer(buffer, 4 * first as u64, bytemuck::cast_slice(words));
            }
            Self::Image(image) => image.write(queue, words),
        }
    }

    /// Room for a copy of the first `word_count` words, which the processor can read.
    pub(super) fn staging(&self, gpu: &Gpu, word_count: usize) -> Staging {
        match self {
            Self::Buffer(_) => Staging::of_words(&gpu.device, word_count),
            Self::Image(image) => image.staging(&gpu.device),
        }
    }

    /// Records the copy to such room.
    pub(super) fn stage(&self, encoder: &mut wgpu::CommandEncoder, staging: &Staging) {
        match self {
            Self::Buffer(buffer) => {
                let bytes = staging.buffer.size().min(buffer.size());
                encoder.copy_buffer_to_buffer(buffer, 0, &staging.buffer, 0, bytes);
            }
            Self::Image(image) => image.stage(encoder, staging),
        }
    }
}

fn new_buffer(gpu: &Gpu, name: &str, bytes: usize, usage: wgpu::BufferUsages) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(name),
        size: (bytes as u64).next_multiple_of(4),
        usage: usage | wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

/// Refuses resources that the limits rule out, before the driver sees them.
fn check_size(limits: &wgpu::Limits, resource: &Resource) -> Result<(), EngineError> {
    let bytes = resource.word_count() as u64 * 4;
    let fits = match resource.kind {
        Kind::Uniform { .. } => bytes <= limits.max_uniform_buffer_binding_size,
        Kind::Buffer { .. } => bytes <= limits.max_storage_buffer_binding_size,
        Kind::Image { size, layers, .. } => {
            let most = [
                limits.max_texture_dimension_2d,
                limits.max_texture_array_layers,
            ];
            return check_sides(most, resource, size, layers);
        }
    };
    if fits {
        Ok(())
    } else {
        Err(out_of_memory(resource))
    }
}

fn check_sides(
    [most, most_layers]: [u32; 2],
    resource: &Resource,
    [width, height]: [u32; 2],
    layers: u32,
) -> Result<(), EngineError> {
    let reason = if width > most || height > most {
        format!("an image of {width} x {height} is larger than {most} on a side")
    } else if layers > most_layers {
        format!("an image of {layers} layers has more than {most_layers}")
    } else {
        return Ok(());
    };
    Err(EngineError::Failed {
        place: resource.name.to_owned(),
        reason,
    })
}

fn out_of_memory(resource: &Resource) -> EngineError {
    EngineError::OutOfMemory {
        resource: resource.name,
        bytes: resource.word_count() as u64 * 4,
    }
}
