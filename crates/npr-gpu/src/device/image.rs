//! A picture on the device.

use super::gpu::Gpu;
use super::staging::Staging;
use crate::pass::Format;

/// A texture with the views that passes use.
#[derive(Debug)]
pub(super) struct Image {
    texture: wgpu::Texture,
    /// Each layer alone.
    pub(super) layers: Vec<wgpu::TextureView>,
    /// All layers.
    pub(super) all: wgpu::TextureView,
    /// What a texel holds.
    pub(super) format: Format,
    size: [u32; 2],
}

impl Image {
    /// A zeroed image. One without texels still gets one, so that it can be bound.
    pub(super) fn new(gpu: &Gpu, name: &str, format: Format, size: [u32; 2], layers: u32) -> Self {
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some(name),
            size: extent(size.map(|side| side.max(1)), layers),
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: texture_format(format),
            usage: usages(format),
            view_formats: &[],
        });
        let view = |dimension, first, count| {
            texture.create_view(&wgpu::TextureViewDescriptor {
                dimension: Some(dimension),
                base_array_layer: first,
                array_layer_count: Some(count),
                ..wgpu::TextureViewDescriptor::default()
            })
        };
        let alone = |layer| view(wgpu::TextureViewDimension::D2, layer, 1);
        Self {
            layers: (0..layers).map(alone).collect(),
            all: view(wgpu::TextureViewDimension::D2Array, 0, layers),
            texture,
            format,
            size,
        }
    }

    /// Overwrites the first texels: whole layers, then whole rows, then the start of the next one.
    pub(super) fn write(&self, queue: &wgpu::Queue, texels: &[u32]) {
        let [width, height] = self.size.map(|side| side as usize);
        for (layer, texels) in (0..).zip(texels.chunks((width * height).max(1))) {
            let (rows, rest) = texels.split_at(texels.len() / width * width);
            let row_count = (rows.len() / width) as u32;
            self.write_rectangle(queue, [layer, 0], [self.size[0], row_count], rows);
            self.write_rectangle(queue, [layer, row_count], [rest.len() as u32, 1], rest);
        }
    }

    fn write_rectangle(
        &self,
        queue: &wgpu::Queue,
        [layer, top]: [u32; 2],
        size: [u32; 2],
        texels: &[u32],
    ) {
        if texels.is_empty() {
            return;
        }
        let rows = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(size[0] * 4),
            rows_per_image: None,
        };
        queue.write_texture(
            self.corner(layer, top),
            bytemuck::cast_slice(texels),
            rows,
            extent(size, 1),
        );
    }

    /// Room for a copy of all texels, which the processor can read.
    pub(super) fn staging(&self, device: &wgpu::Device) -> Staging {
        let [width, height] = self.size;
        Staging::of_rows(device, [width, height * self.layers.len() as u32])
    }

    /// Records the copy to such room.
    pub(super) fn stage(&self, encoder: &mut wgpu::CommandEncoder, staging: &Staging) {
        if self.size[0] > 0 && self.size[1] > 0 {
            let target = wgpu::TexelCopyBufferInfo {
                buffer: &staging.buffer,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(staging.row_bytes as u32),
                    rows_per_image: Some(self.size[1]),
                },
            };
            let all = extent(self.size, self.layers.len() as u32);
            encoder.copy_texture_to_buffer(self.corner(0, 0), target, all);
        }
    }

    fn corner(&self, layer: u32, top: u32) -> wgpu::TexelCopyTextureInfo<'_> {
        wgpu::TexelCopyTextureInfo {
            texture: &self.texture,
            mip_level: 0,
            origin: wgpu::Origin3d {
                x: 0,
                y: top,
                z: layer,
            },
            aspect: wgpu::TextureAspect::All,
        }
    }
}

/// The texture format of a [`Format`].
pub(super) fn texture_format(format: Format) -> wgpu::TextureFormat {
    match format {
        Format::U32 => wgpu::TextureFormat::R32Uint,
        Format::Rgba8 => wgpu::TextureFormat::Rgba8Unorm,
        Format::Depth => wgpu::TextureFormat::Depth32Float,
    }
}

/// Everything that WebGPU lets a format be used for; depth cannot be copied into.
fn usages(format: Format) -> wgpu::TextureUsages {
    let usages = wgpu::TextureUsages::TEXTURE_BINDING
        | wgpu::TextureUsages::RENDER_ATTACHMENT
        | wgpu::TextureUsages::COPY_SRC;
    if format == Format::Depth {
        usages
    } else {
        usages | wgpu::TextureUsages::COPY_DST
    }
}

fn extent(size: [u32; 2], layers: u32) -> wgpu::Extent3d {
    wgpu::Extent3d {
        width: size[0],
        height: size[1],
        depth_or_array_layers: layers,
    }
}
