//! Compiled passes.

use super::gpu::Gpu;
use super::image::texture_format;
use crate::engine::EngineError;
use crate::pass::{Access, Format, Pass, Slot, Work};
use npr_shaders::Features;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// A pass compiled for a device.
#[derive(Debug)]
pub(super) struct Pipeline {
    /// Layout of group 0.
    pub(super) layout: wgpu::BindGroupLayout,
    /// The pipeline that runs.
    pub(super) stage: Stage,
}

/// The compiled entry points of a pass.
#[derive(Debug)]
pub(super) enum Stage {
    /// `main`.
    Compute(wgpu::ComputePipeline),
    /// `vertex` and `fragment`.
    Draw(wgpu::RenderPipeline),
}

/// A pass, by its name, and the features that decide what is compiled for it.
type Key = (&'static str, Features);

/// The compiled passes of a device, so that graphs share them.
#[derive(Debug, Default)]
pub(super) struct PipelineCache {
    compiled: Mutex<BTreeMap<Key, Arc<Pipeline>>>,
}

impl PipelineCache {
    /// The passes for a frame with `features`, in their order. Those that were not compiled before are now, all at
    /// once.
    pub(super) fn get_all(
        &self,
        gpu: &Gpu,
        passes: &[&'static Pass],
        features: Features,
    ) -> Result<Vec<Arc<Pipeline>>, EngineError> {
        // Compile every pass that is missing once; long graphs hold a pass many times.
        let mut deciding = BTreeMap::new();
        let keys: Vec<Key> = passes
            .iter()
            .map(|pass| {
                let decided = deciding.entry(pass.name);
                (
                    pass.name,
                    *decided.or_insert_with(|| pass.deciding(features)),
                )
            })
            .collect();
        let mut missing = BTreeSet::new();
        let known: BTreeSet<Key> = self.lock().keys().copied().collect();
        let missing: Vec<(Key, &Pass)> = keys
            .iter()
            .zip(passes)
            .filter(|(key, _)| !known.contains(key) && missing.insert(**key))
            .map(|(key, pass)| (*key, *pass))
            .collect();
        let made = missing.into_par_iter().map(|(key, pass)| {
            let pipeline = gpu.guarded(pass.name, || compile(&gpu.device, pass, features))?;
            Ok((key, Arc::new(pipeline)))
        });
        let made: Vec<_> = made.collect::<Result<_, EngineError>>()?;

        // Hand out all of them.
        let mut compiled = self.lock();
        compiled.extend(made);
        Ok(keys.iter().map(|key| compiled[key].clone()).collect())
    }

    fn lock(&self) -> MutexGuard<'_, BTreeMap<Key, Arc<Pipeline>>> {
        self.compiled.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

fn compile(device: &wgpu::Device, pass: &Pass, features: Features) -> Pipeline {
    // Compile the shader.
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(pass.name),
        source: wgpu::ShaderSource::Wgsl(npr_shaders::link(&pass.shader, features).into()),
    });

    // Lay out what it binds, slot by slot.
    let entries: Vec<_> = (0..)
        .zip(pass.slots)
        .filter(|(_, slot)| slot.is_bound_for(features))
        .map(|(binding, slot)| layout_entry(pass, binding, slot))
        .collect();
    let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some(pass.name),
        entries: &entries,
    });
    let bindings = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(pass.name),
        bind_group_layouts: &[Some(&layout)],
        immediate_size: 0,
    });

    // Make it a pass over elements or over pixels.
    let stage = match pass.work {
        Work::PerElement { .. } | Work::PerRun { .. } | Work::PerListed { .. } => {
            Stage::Compute(compile_compute(device, pass, &module, &bindings))
        }
        Work::Draw { targets, .. } => {
            Stage::Draw(compile_draw(device, pass, targets, &module, &bindings))
        }
    };
    Pipeline { layout, stage }
}

fn layout_entry(pass: &Pass, binding: u32, slot: &Slot) -> wgpu::BindGroupLayoutEntry {
    let visibility = match pass.work {
        Work::PerElement { .. } | Work::PerRun { .. } | Work::PerListed { .. } => {
            wgpu::ShaderStages::COMPUTE
        }
        Work::Draw { .. } => wgpu::ShaderStages::VERTEX_FRAGMENT,
    };
    wgpu::BindGroupLayoutEntry {
        binding,
        visibility,
        ty: binding_type(slot),
        count: None,
    }
}

fn binding_type(slot: &Slot) -> wgpu::BindingType {
    let buffer = |ty| wgpu::BindingType::Buffer {
        ty,
        has_dynamic_offset: false,
        min_binding_size: wgpu::BufferSize::new(slot.element.size as u64),
    };
    let texture = |format, view_dimension| wgpu::BindingType::Texture {
        sample_type: sample_type(format),
        view_dimension,
        multisampled: false,
    };
    match slot.access {
        Access::Uniform => buffer(wgpu::BufferBindingType::Uniform),
        Access::Read => buffer(wgpu::BufferBindingType::Storage { read_only: true }),
        Access::Write | Access::Update | Access::Scatter | Access::Append => {
            buffer(wgpu::BufferBindingType::Storage { read_only: false })
        }
        Access::Indices => unreachable!("slot {} holds indices, which are not bound", slot.name),
        Access::Texture(format) => texture(format, wgpu::TextureViewDimension::D2),
        Access::Layered(format) => texture(format, wgpu::TextureViewDimension::D2Array),
    }
}

fn sample_type(format: Format) -> wgpu::TextureSampleType {
    match format {
        Format::U32 => wgpu::TextureSampleType::Uint,
        Format::Rgba8 => wgpu::TextureSampleType::Float { filterable: false },
        Format::Depth => wgpu::TextureSampleType::Depth,
    }
}

fn compile_compute(
    device: &wgpu::Device,
    pass: &Pass,
    module: &wgpu::ShaderModule,
    bindings: &wgpu::PipelineLayout,
) -> wgpu::ComputePipeline {
    device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some(pass.name),
        layout: Some(bindings),
        module,
        entry_point: Some("main"),
        compilation_options: wgpu::PipelineCompilationOptions::default(),
        cache: None,
    })
}

fn compile_draw(
    device: &wgpu::Device,
    pass: &Pass,
    targets: &[Format],
    module: &wgpu::ShaderModule,
    bindings: &wgpu::PipelineLayout,
) -> wgpu::RenderPipeline {
    let colors: Vec<_> = targets
        .iter()
        .filter(|format| **format != Format::Depth)
        .map(|f| color_target(*f))
        .collect();
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(pass.name),
        layout: Some(bindings),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some("vertex"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[],
        },
        // Facing is the vertex shader's decision: it knows which parts show both sides.
        primitive: wgpu::PrimitiveState {
            cull_mode: None,
            ..wgpu::PrimitiveState::default()
        },
        depth_stencil: targets.contains(&Format::Depth).then(reversed_depth),
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module,
            entry_point: Some("fragment"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &colors,
        }),
        multiview_mask: None,
        cache: None,
    })
}

fn color_target(format: Format) -> Option<wgpu::ColorTargetState> {
    Some(wgpu::ColorTargetState {
        format: texture_format(format),
        blend: None,
        write_mask: wgpu::ColorWrites::ALL,
    })
}

/// Greater is nearer; equal depths keep what was drawn first, as the processor's rasteriser does.
fn reversed_depth() -> wgpu::DepthStencilState {
    wgpu::DepthStencilState {
        format: texture_format(Format::Depth),
        depth_write_enabled: Some(true),
        depth_compare: Some(wgpu::CompareFunction::Greater),
        stencil: wgpu::StencilState::default(),
        bias: wgpu::DepthBiasState::default(),
    }
}
