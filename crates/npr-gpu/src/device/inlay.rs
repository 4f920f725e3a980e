//! A finished frame laid into a target of a host program.

use super::Device;
use super::session::DeviceSession;
use crate::engine::EngineError;
use crate::graph::ResourceId;
use bytemuck::{Pod, Zeroable};
use npr_shaders::{Features, HOST_LAY_FRAME, link};

/// What the views of a [`Target`] are made of; a pipeline is compiled for it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TargetFormat {
    /// Format of the colour view: any that WebGPU can draw and blend into. A view whose format ends in `Srgb`, or of
    /// floats, gets linear light and is blended in it; others get sRGB bytes as they are.
    pub color: wgpu::TextureFormat,
    /// The depth view, where there is one.
    pub depth: Option<DepthTarget>,
    /// Samples per pixel of both views, 1 without multisampling. All samples of a pixel get the same.
    pub samples: u32,
}

/// The depth view of a target.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct DepthTarget {
    /// Its format, with or without a stencil, which stays as it is.
    pub format: wgpu::TextureFormat,
    /// How a depth must compare with that of the view to be drawn: `LessEqual` where the host's depths grow away from
    /// the eye, `GreaterEqual` where they are reversed.
    pub compare: wgpu::CompareFunction,
}

/// Where a frame is laid: its upper left pixel on that of the view.
///
/// What the frame does not cover stays as it is, and what lies beyond a smaller view is left out.
#[derive(Debug, Clone, Copy)]
pub struct Target<'a> {
    /// What is drawn into, over what is there.
    pub color: &'a wgpu::TextureView,
    /// What is compared with and written; there must be one exactly where the format says so.
    pub depth: Option<&'a wgpu::TextureView>,
}

/// A finished frame of a session, ready to be laid into targets of one format.
#[derive(Debug)]
pub struct Inlay {
    pipeline: wgpu::RenderPipeline,
    bindings: wgpu::BindGroup,
    laying: wgpu::Buffer,
}

/// What the shader is told.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
struct Laying {
    host_from_frame: [[f32; 4]; 4],
    size: [u32; 2],
    is_linear: u32,
    unused: u32,
}

impl Inlay {
    /// Compiles what lays `frame` of a session, sRGB words with straight alpha, into targets of a format, and `depths`
    /// with it: reversed depths of its pixels, 0 where there is nothing. Both are buffers, row by row.
    ///
    /// # Errors
    ///
    /// [`EngineError::Failed`] for formats that the device cannot draw into, and [`EngineError::Lost`].
    ///
    /// # Panics
    ///
    /// Where `frame` or `depths` is no buffer of the session.
    pub fn new(
        device: &Device,
        session: &DeviceSession,
        [frame, depths]: [ResourceId; 2],
        format: TargetFormat,
    ) -> Result<Self, EngineError> {
        let gpu = &device.gpu;
        gpu.check()?;
        let made = gpu.guarded("host.lay_frame", || {
            let layout = layout(&gpu.device);
            let pipeline = compile(&gpu.device, &layout, format);
            let laying = gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("host.lay_frame"),
                size: size_of::<Laying>() as u64,
                usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            });
            let bindings = bind(&gpu.device, &layout, &laying, session, [frame, depths]);
            Self {
                pipeline,
                bindings,
                laying,
            }
        })?;
        gpu.check()?;
        Ok(made)
    }

    /// Says how frames lie in the host's view from the next submission on.
    ///
    /// `size` is that of the frame in pixels; `host_from_frame`, by columns, turns normalised device coordinates of the
    /// frame, whose depth is reversed, into clip coordinates of the host, whose depths are 0..1; `format` is that of
    /// the target.
    ///
    /// # Errors
    ///
    /// [`EngineError::Lost`].
    pub fn aim(
        &self,
        device: &Device,
        size: [u32; 2],
        host_from_frame: [[f32; 4]; 4],
        format: TargetFormat,
    ) -> Result<(), EngineError> {
        let gpu = &device.gpu;
        gpu.check()?;
        let laying = Laying {
            host_from_frame,
            size,
            is_linear: u32::from(is_linear(format.color)),
            unused: 0,
        };
        gpu.guarded("host.lay_frame", || {
            gpu.queue
                .write_buffer(&self.laying, 0, bytemuck::bytes_of(&laying));
        })
    }

    /// Records the drawing of the frame into a target.
    pub fn record(&self, encoder: &mut wgpu::CommandEncoder, target: Target<'_>) {
        let depth = target
            .depth
            .map(|view| wgpu::RenderPassDepthStencilAttachment {
                view,
                depth_ops: Some(kept()),
                stencil_ops: None,
            });
        let color = wgpu::RenderPassColorAttachment {
            view: target.color,
            depth_slice: None,
            resolve_target: None,
            ops: kept(),
        };
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("host.lay_frame"),
            color_attachments: &[Some(color)],
            depth_stencil_attachment: depth,
            ..wgpu::RenderPassDescriptor::default()
        });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.bindings, &[]);
        pass.draw(0..3, 0..1);
    }
}

/// Keeps what a target holds.
fn kept<V>() -> wgpu::Operations<V> {
    wgpu::Operations {
        load: wgpu::LoadOp::Load,
        store: wgpu::StoreOp::Store,
    }
}

/// Whether texels of a format hold linear light as the shader writes them.
fn is_linear(format: wgpu::TextureFormat) -> bool {
    use wgpu::TextureFormat::{Rg11b10Ufloat, Rgba16Float, Rgba32Float};
    format.is_srgb() || matches!(format, Rgba16Float | Rgba32Float | Rg11b10Ufloat)
}

/// What the shader binds: a uniform and two buffers that it reads.
fn layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
    let read = wgpu::BufferBindingType::Storage { read_only: true };
    let types = [(0, wgpu::BufferBindingType::Uniform), (1, read), (2, read)];
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("host.lay_frame"),
        entries: &types.map(|(binding, ty)| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::FRAGMENT,
            ty: wgpu::BindingType::Buffer {
                ty,
                has_dynamic_offset: false,
                min_binding_size: None,
            },
            count: None,
        }),
    })
}

fn compile(
    device: &wgpu::Device,
    layout: &wgpu::BindGroupLayout,
    format: TargetFormat,
) -> wgpu::RenderPipeline {
    // Compile the shader; where there are no depths, none may be written.
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("host.lay_frame"),
        source: wgpu::ShaderSource::Wgsl(link(&HOST_LAY_FRAME, Features::NONE).into()),
    });
    let fragment = match format.depth {
        Some(_) => "fragment",
        None => "fragment_without_depth",
    };

    // Lay it over what the target holds, before what lies behind it.
    let color = wgpu::ColorTargetState {
        format: format.color,
        blend: Some(wgpu::BlendState::ALPHA_BLENDING),
        write_mask: wgpu::ColorWrites::ALL,
    };
    let depth = format.depth.map(|depth| wgpu::DepthStencilState {
        format: depth.format,
        depth_write_enabled: Some(true),
        depth_compare: Some(depth.compare),
        stencil: wgpu::StencilState::default(),
        bias: wgpu::DepthBiasState::default(),
    });
    let bindings = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some("host.lay_frame"),
        bind_group_layouts: &[Some(layout)],
        immediate_size: 0,
    });
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("host.lay_frame"),
        layout: Some(&bindings),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("vertex"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: depth,
        multisample: wgpu::MultisampleState {
            count: format.samples,
            ..wgpu::MultisampleState::default()
        },
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some(fragment),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[Some(color)],
        }),
        multiview_mask: None,
        cache: None,
    })
}

fn bind(
    device: &wgpu::Device,
    layout: &wgpu::BindGroupLayout,
    laying: &wgpu::Buffer,
    session: &DeviceSession,
    resources: [ResourceId; 2],
) -> wgpu::BindGroup {
    let buffers = resources.map(|id| {
        let buffer = session.buffer(id);
        buffer.unwrap_or_else(|| panic!("'{}' is no buffer", session.graph().resource(id).name))
    });
    let bound = [(0, laying), (1, buffers[0]), (2, buffers[1])];
    device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("host.lay_frame"),
        layout,
        entries: &bound.map(|(binding, buffer)| wgpu::BindGroupEntry {
            binding,
            resource: buffer.as_entire_binding(),
        }),
    })
}
