//! A graph with its memory on a device.

use super::Gpu;
use super::clock::Clock;
use super::memory::Memory;
use super::pipeline::{Pipeline, Stage};
use crate::engine::{EngineError, PassTime, Session};
use crate::graph::{Graph, Node, ResourceId};
use crate::pass::{Format, WORKGROUP_SIZE, Work};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// The name under which the time of all passes together is reported, where the device has no clock.
const ALL_PASSES: &str = "device";

/// Most workgroups along one dimension, by WebGPU's limits.
const MAX_GROUPS: u32 = 65535;

/// A prepared graph. Commands are recorded anew for every run; memory, shaders and bindings are kept.
#[derive(Debug)]
pub(super) struct DeviceSession {
    gpu: Arc<Gpu>,
    graph: Graph,
    memory: Vec<Memory>,
    steps: Vec<Step>,
    clock: Option<Clock>,
}

/// A node that has something to do.
#[derive(Debug)]
struct Step {
    node: usize,
    pipeline: Arc<Pipeline>,
    bindings: wgpu::BindGroup,
    extent: Extent,
}

/// How much a step does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Extent {
    /// Workgroups in x and y.
    Groups([u32; 2]),
    /// Vertices.
    Vertices(u32),
}

impl DeviceSession {
    pub(super) fn new(gpu: Arc<Gpu>, graph: Graph) -> Result<Self, EngineError> {
        gpu.check()?;
        let memory: Vec<Memory> = graph
            .resources()
            .iter()
            .map(|resource| Memory::new(&gpu, resource))
            .collect::<Result<_, _>>()?;
        let mut steps = Vec::new();
        for (index, node) in graph.nodes().iter().enumerate() {
            let extent = extent_of(&graph, node)?;
            if has_effect(node, extent) {
                steps.push(Step::new(&gpu, &memory, (index, node), extent)?);
            }
        }
        let clock = gpu.guarded("the clock", || Clock::new(&gpu, steps.len()))?;
        gpu.check()?;
        Ok(Self {
            gpu,
            graph,
            memory,
            steps,
            clock,
        })
    }

    fn record(&self, encoder: &mut wgpu::CommandEncoder, number: u32, step: &Step) {
        let node = &self.graph.nodes()[step.node];
        match (&step.pipeline.stage, step.extent) {
            (Stage::Compute(pipeline), Extent::Groups(groups)) => {
                let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                    label: Some(node.pass.name),
                    timestamp_writes: self
                        .clock
                        .as_ref()
                        .map(|clock| clock.compute_stamps(number)),
                });
                pass.set_pipeline(pipeline);
                pass.set_bind_group(0, &step.bindings, &[]);
                pass.dispatch_workgroups(groups[0], groups[1], 1);
            }
            (Stage::Draw(pipeline), Extent::Vertices(count)) => {
                let mut pass = self.begin_draw(encoder, number, node);
                pass.set_pipeline(pipeline);
                pass.set_bind_group(0, &step.bindings, &[]);
                pass.draw(0..count, 0..1);
            }
            _ => unreachable!(
                "pass {} was compiled for another kind of work",
                node.pass.name
            ),
        }
    }

    fn begin_draw<'a>(
        &self,
        encoder: &'a mut wgpu::CommandEncoder,
        number: u32,
        node: &Node,
    ) -> wgpu::RenderPass<'a> {
        let targets = node.bound[node.pass.slots.len()..]
            .iter()
            .filter_map(|id| self.memory[id.index()].image());
        let (depths, colors): (Vec<_>, Vec<_>) =
            targets.partition(|image| image.format == Format::Depth);
        let colors: Vec<_> = colors
            .iter()
            .map(|image| Some(color_attachment(&image.view, node.clears)))
            .collect();
        let pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some(node.pass.name),
            color_attachments: &colors,
            depth_stencil_attachment: depths
                .first()
                .map(|image| depth_attachment(&image.view, node.clears)),
            timestamp_writes: self.clock.as_ref().map(|clock| clock.draw_stamps(number)),
            occlusion_query_set: None,
            multiview_mask: None,
        });
        pass
    }

    /// The times of all nodes; those that had nothing to do took none.
    fn node_times(&self, step_times: &[Duration]) -> Vec<PassTime> {
        let nodes = self.graph.nodes().iter();
        let mut times: Vec<_> = nodes
            .map(|node| PassTime {
                name: node.pass.name,
                time: Duration::ZERO,
            })
            .collect();
        for (step, time) in self.steps.iter().zip(step_times) {
            times[step.node].time = *time;
        }
        times
    }
}

impl Session for DeviceSession {
    fn write(&mut self, id: ResourceId, words: &[u32]) -> Result<(), EngineError> {
        let resource = self.graph.resource(id);
        assert!(
            words.len() <= resource.word_count(),
            "'{}' has no room for {} words",
            resource.name,
            words.len()
        );
        self.gpu.check()?;
        self.gpu.guarded(resource.name, || {
            self.memory[id.index()].write(&self.gpu.queue, words)
        })
    }

    /// Runs every node once.
    ///
    /// Where the device has no clock, the times are one entry named `device`: the wall time until all passes were done.
    fn run(&mut self) -> Result<Vec<PassTime>, EngineError> {
        self.gpu.check()?;
        let start = Instant::now();
        let (stamps, submission) = self.gpu.guarded("the submission of a frame", || {
            let mut encoder = self
                .gpu
                .device
                .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            for (number, step) in (0..).zip(&self.steps) {
                self.record(&mut encoder, number, step);
            }
            let stamps = self
                .clock
                .as_ref()
                .map(|clock| (clock, clock.stage(&self.gpu, &mut encoder)));
            (stamps, self.gpu.queue.submit([encoder.finish()]))
        })?;
        if let Some((clock, staging)) = stamps {
            return Ok(self.node_times(&clock.times(&self.gpu, &staging, submission)?));
        }
        self.gpu.wait(submission)?;
        Ok(vec![PassTime {
            name: ALL_PASSES,
            time: start.elapsed(),
        }])
    }

    fn read(&mut self, id: ResourceId) -> Result<Vec<u32>, EngineError> {
        self.gpu.check()?;
        let resource = self.graph.resource(id);
        let (staging, submission) = self.gpu.guarded(resource.name, || {
            let mut encoder = self
                .gpu
                .device
                .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            let staging =
                self.memory[id.index()].stage(&self.gpu, &mut encoder, resource.word_count());
            (staging, self.gpu.queue.submit([encoder.finish()]))
        })?;
        staging.words(&self.gpu, resource.name, submission)
    }
}

impl Step {
    fn new(
        gpu: &Gpu,
        memory: &[Memory],
        (index, node): (usize, &Node),
        extent: Extent,
    ) -> Result<Self, EngineError> {
        let pipeline = gpu.pipelines.get(gpu, node.pass)?;
        let bound = node.bound.iter().take(node.pass.slots.len());
        let entries: Vec<_> = (0..)
            .zip(bound)
            .map(|(binding, id)| wgpu::BindGroupEntry {
                binding,
                resource: memory[id.index()].binding(),
            })
            .collect();
        let bindings = gpu.guarded(node.pass.name, || {
            gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some(node.pass.name),
                layout: &pipeline.layout,
                entries: &entries,
            })
        })?;
        Ok(Self {
            node: index,
            pipeline,
            bindings,
            extent,
        })
    }
}

/// Whether running a node changes anything: clearing does, even when nothing is drawn.
fn has_effect(node: &Node, extent: Extent) -> bool {
    node.clears || !matches!(extent, Extent::Groups([0, _]) | Extent::Vertices(0))
}

fn extent_of(graph: &Graph, node: &Node) -> Result<Extent, EngineError> {
    let count = graph.work_count(node);
    let extent = match node.pass.work {
        Work::PerElement { .. } => groups_for(count).map(Extent::Groups),
        Work::Draw { vertices, .. } => {
            let all = count.checked_mul(vertices as usize);
            all.and_then(|all| u32::try_from(all).ok())
                .map(Extent::Vertices)
        }
    };
    extent.ok_or_else(|| EngineError::Failed {
        place: node.pass.name.to_owned(),
        reason: format!("{count} elements are more than one pass can do"),
    })
}

/// Workgroups in x and y for a number of elements: rows of the largest width once one row is not enough.
fn groups_for(element_count: usize) -> Option<[u32; 2]> {
    let groups = u32::try_from(element_count.div_ceil(WORKGROUP_SIZE as usize)).ok()?;
    let rows = groups.div_ceil(MAX_GROUPS).max(1);
    (rows <= MAX_GROUPS).then_some([groups.min(MAX_GROUPS), rows])
}

fn color_attachment(view: &wgpu::TextureView, clears: bool) -> wgpu::RenderPassColorAttachment<'_> {
    wgpu::RenderPassColorAttachment {
        view,
        depth_slice: None,
        resolve_target: None,
        ops: kept(clears, wgpu::Color::TRANSPARENT),
    }
}

fn depth_attachment(
    view: &wgpu::TextureView,
    clears: bool,
) -> wgpu::RenderPassDepthStencilAttachment<'_> {
    wgpu::RenderPassDepthStencilAttachment {
        view,
        depth_ops: Some(kept(clears, 0.0)),
        stencil_ops: None,
    }
}

/// Keeps what is drawn, and what was there before unless it is cleared.
fn kept<V>(clears: bool, zero: V) -> wgpu::Operations<V> {
    let load = if clears {
        wgpu::LoadOp::Clear(zero)
    } else {
        wgpu::LoadOp::Load
    };
    wgpu::Operations {
        load,
        store: wgpu::StoreOp::Store,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn groups_turn_into_rows_when_one_row_is_full() {
        let row = (MAX_GROUPS * WORKGROUP_SIZE) as usize;
        assert_eq!(groups_for(0), Some([0, 1]));
        assert_eq!(groups_for(1), Some([1, 1]));
        assert_eq!(groups_for(65), Some([2, 1]));
        assert_eq!(groups_for(row), Some([65535, 1]));
        assert_eq!(groups_for(row + 1), Some([65535, 2]));
        assert_eq!(groups_for(usize::MAX), None);
    }
}
