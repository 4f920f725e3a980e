//! The textures that a host program without a window draws into.

use super::super::inlay::{DepthTarget, Target, TargetFormat};

/// The textures that a host program without a window draws into, and reads.
#[derive(Debug)]
pub struct Canvas {
    color: wgpu::TextureView,
    depth: Option<wgpu::TextureView>,
    /// What samples are resolved into, where there are several.
    resolved: Option<wgpu::TextureView>,
    size: [u32; 2],
    format: TargetFormat,
}

impl Canvas {
    /// A canvas of a format with four bytes a pixel.
    pub fn new(device: &wgpu::Device, size: [u32; 2], format: TargetFormat) -> Self {
        let view = |format, samples| {
            let texture = device.create_texture(&wgpu::TextureDescriptor {
                label: Some("canvas"),
                size: extent(size),
                mip_level_count: 1,
                sample_count: samples,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
                view_formats: &[],
            });
            texture.create_view(&wgpu::TextureViewDescriptor::default())
        };
        Self {
            color: view(format.color, format.samples),
            depth: format.depth.map(|depth| view(depth.format, format.samples)),
            resolved: (format.samples > 1).then(|| view(format.color, 1)),
            size,
            format,
        }
    }

    /// What is drawn into.
    pub fn target(&self) -> Target<'_> {
        Target {
            color: &self.color,
            depth: self.depth.as_ref(),
        }
    }

    /// A pipeline that draws triangles into it by the only entry points of a shader, whichever way they face.
    pub fn pipeline(
        &self,
        device: &wgpu::Device,
        wgsl: &str,
        vertices: wgpu::VertexBufferLayout<'_>,
    ) -> wgpu::RenderPipeline {
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("canvas"),
            source: wgpu::ShaderSource::Wgsl(wgsl.into()),
        });
        let depth = |depth: DepthTarget| wgpu::DepthStencilState {
            format: depth.format,
            depth_write_enabled: Some(true),
            depth_compare: Some(depth.compare),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        };
        device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("canvas"),
            layout: None,
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: None,
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &[Some(vertices)],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: self.format.depth.map(depth),
            multisample: wgpu::MultisampleState {
                count: self.format.samples,
                ..wgpu::MultisampleState::default()
            },
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: None,
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: &[Some(self.format.color.into())],
            }),
            multiview_mask: None,
            cache: None,
        })
    }

    /// Starts a pass that clears the colours, and depths to the farthest; without a colour it keeps what they hold.
    pub fn begin<'a>(
        &self,
        encoder: &'a mut wgpu::CommandEncoder,
        clear: Option<wgpu::Color>,
    ) -> wgpu::RenderPass<'a> {
        let color = wgpu::RenderPassColorAttachment {
            view: &self.color,
            depth_slice: None,
            resolve_target: self.resolved.as_ref(),
            ops: operations(clear),
        };
        let far = match self.format.depth.map(|depth| depth.compare) {
            Some(wgpu::CompareFunction::Greater | wgpu::CompareFunction::GreaterEqual) => 0.0,
            _ => 1.0,
        };
        let depth = |view| wgpu::RenderPassDepthStencilAttachment {
            view,
            depth_ops: Some(operations(clear.map(|_| far))),
            stencil_ops: None,
        };
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("canvas"),
            color_attachments: &[Some(color)],
            depth_stencil_attachment: self.depth.as_ref().map(depth),
            ..wgpu::RenderPassDescriptor::default()
        })
    }

    /// Submits what was recorded, and reads the colours: four bytes a pixel, row by row.
    ///
    /// # Errors
    ///
    /// Where the device is lost.
    pub fn submit_and_read(
        &self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        mut encoder: wgpu::CommandEncoder,
    ) -> Result<Vec<u8>, Box<dyn std::error::Error>> {
        // Copy rows to where the processor can read them, each at a multiple of 256 bytes.
        let [width, height] = self.size;
        let row_bytes = (width * 4).next_multiple_of(256);
        let buffer = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("canvas"),
            size: u64::from(row_bytes * height),
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(row_bytes),
            rows_per_image: None,
        };
        let to = wgpu::TexelCopyBufferInfo {
            buffer: &buffer,
            layout,
        };
        if self.resolved.is_some() {
            drop(self.begin(&mut encoder, None));
        }
        let shown = self.resolved.as_ref().unwrap_or(&self.color).texture();
        encoder.copy_texture_to_buffer(shown.as_image_copy(), to, extent(self.size));
        queue.submit([encoder.finish()]);

        // Wait, and drop what fills the rows up.
        buffer.slice(..).map_async(wgpu::MapMode::Read, |_| ());
        device.poll(wgpu::PollType::wait_indefinitely())?;
        let bytes = buffer.slice(..).get_mapped_range()?;
        let rows = bytes.chunks_exact(row_bytes as usize);
        Ok(rows
            .flat_map(|row| &row[..4 * width as usize])
            .copied()
            .collect())
    }
}

fn extent(size: [u32; 2]) -> wgpu::Extent3d {
    wgpu::Extent3d {
        width: size[0],
        height: size[1],
        depth_or_array_layers: 1,
    }
}

/// Clears to a value, or keeps what is there.
fn operations<V>(clear: Option<V>) -> wgpu::Operations<V> {
    wgpu::Operations {
        load: clear.map_or(wgpu::LoadOp::Load, wgpu::LoadOp::Clear),
        store: wgpu::StoreOp::Store,
    }
}
