//! A graph with its memory on a device.

use super::clock::Clock;
use super::gpu::Gpu;
use super::memory::Memory;
use super::pipeline::{PipelineCache, Stage};
use super::staging::Staging;
use super::step::{Extent, Step};
use crate::engine::{EngineError, PassTime, Readings, Session};
use crate::graph::{Graph, Node, ResourceId, WorkSize, emptied};
use crate::pass::Format;
use npr_vector::rank::work::Arguments;
use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// The name under which the time of all passes together is reported, where the device has no clock.
const ALL_PASSES: &str = "device";

/// A graph with its memory on a device: it runs by itself, or records its passes into the encoder of another program.
///
/// Commands are recorded anew for every run; memory, shaders and bindings are kept.
#[derive(Debug)]
pub struct DeviceSession {
    pub(super) gpu: Arc<Gpu>,
    graph: Graph,
    memory: Vec<Memory>,
    steps: Vec<Step>,
    clock: Option<Clock>,
    /// Whether every pass is submitted and waited for alone, so that its wall time is its own.
    times_apart: bool,
    /// Memory that resources are copied to before they are read, kept from run to run.
    stagings: BTreeMap<ResourceId, Staging>,
}

impl DeviceSession {
    /// A graph with its memory, its passes compiled unless `pipelines` has them.
    pub(super) fn new(
        gpu: Arc<Gpu>,
        pipelines: &PipelineCache,
        graph: Graph,
        times_apart: bool,
    ) -> Result<Self, EngineError> {
        // Take memory, marked where it holds the size of later passes.
        gpu.check()?;
        let sizes = graph.nodes().iter().filter_map(|node| node.size);
        let mut more = vec![wgpu::BufferUsages::empty(); graph.resources().len()];
        for WorkSize { arguments, .. } in sizes {
            more[arguments.index()] = wgpu::BufferUsages::INDIRECT;
        }
        let memory: Vec<Memory> = graph
            .resources()
            .iter()
            .zip(more)
            .map(|(resource, more)| Memory::new(&gpu, resource, more))
            .collect::<Result<_, _>>()?;

        // Fill what the graph holds from the start.
        for (id, words) in graph.held() {
            let name = graph.resource(id).name;
            gpu.guarded(name, || memory[id.index()].write(&gpu.queue, words))?;
        }

        // Compile the passes, and time them where the device has a clock.
        let steps = Step::all_of(&gpu, pipelines, &graph, &memory)?;
        let clock = gpu.guarded("the clock", || Clock::new(&gpu, steps.len()))?;
        gpu.check()?;
        Ok(Self {
            gpu,
            graph,
            memory,
            steps,
            clock,
            times_apart,
            stagings: BTreeMap::new(),
        })
    }

    /// Records every node once, in order, into an encoder of the same device; nothing is submitted, read or timed.
    ///
    /// [`Session::write`] takes effect at the next submission, before all of its commands: where a session is recorded
    /// twice for one submission, both see what was written last.
    ///
    /// # Errors
    ///
    /// [`EngineError::Lost`] where the device is lost; nothing is recorded then.
    pub fn record(&self, encoder: &mut wgpu::CommandEncoder) -> Result<(), EngineError> {
        self.gpu.check()?;
        self.record_steps(encoder, None);
        Ok(())
    }

    /// The graph that it runs.
    pub fn graph(&self) -> &Graph {
        &self.graph
    }

    /// The buffer behind a resource, where it is one.
    pub(super) fn buffer(&self, id: ResourceId) -> Option<&wgpu::Buffer> {
        match &self.memory[id.index()] {
            Memory::Buffer(buffer) => Some(buffer),
            Memory::Image(_) => None,
        }
    }

    /// Records all steps, stamped by `clock`.
    fn record_steps(&self, encoder: &mut wgpu::CommandEncoder, clock: Option<&Clock>) {
        for (number, step) in (0..).zip(&self.steps) {
            self.record_step(encoder, number, step, clock);
        }
    }

    /// Makes room for copies of resources, where it was not made before.
    fn make_room(&mut self, ids: &[ResourceId]) -> Result<(), EngineError> {
        for id in ids {
            if !self.stagings.contains_key(id) {
                let resource = self.graph.resource(*id);
                let memory = &self.memory[id.index()];
                let make = || memory.staging(&self.gpu, resource.word_count());
                let made = self.gpu.guarded(resource.name, make)?;
                self.stagings.insert(*id, made);
            }
        }
        Ok(())
    }

    /// Records the copies of resources.
    fn stage(&self, encoder: &mut wgpu::CommandEncoder, ids: &[ResourceId]) {
        for id in ids {
            self.memory[id.index()].stage(encoder, &self.stagings[id]);
        }
    }

    /// The room that each resource is copied to.
    fn rooms(&self, ids: &[ResourceId]) -> impl Iterator<Item = &Staging> {
        ids.iter().map(|id| &self.stagings[id])
    }

    /// Runs every node alone, and waits for each.
    fn run_apart(&self) -> Result<Vec<PassTime>, EngineError> {
        let times = (0..).zip(&self.steps).map(|(number, step)| {
            let start = Instant::now();
            let place = self.graph.nodes()[step.node].pass.name;
            let clock = self.clock.as_ref();
            let record = |encoder: &mut _| self.record_step(encoder, number, step, clock);
            let ((), submission) = self.gpu.submit(place, record)?;
            self.gpu.wait(submission)?;
            Ok(start.elapsed())
        });
        let times: Vec<_> = times.collect::<Result<_, EngineError>>()?;
        Ok(self.node_times(&times))
    }

    fn record_step(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        number: u32,
        step: &Step,
        clock: Option<&Clock>,
    ) {
        // Empty what the pass appends to, or writes in part.
        let node = &self.graph.nodes()[step.node];
        for (id, count) in emptied(node) {
            if let Memory::Buffer(buffer) = &self.memory[id.index()] {
                encoder.clear_buffer(buffer, 0, count.map(|words| words as u64 * 4));
            }
        }

        // Run it.
        match (&step.pipeline.stage, step.extent) {
            (Stage::Compute(pipeline), Extent::Groups(groups)) => {
                let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                    label: Some(node.pass.name),
                    timestamp_writes: clock.map(|clock| clock.compute_stamps(number)),
                });
                pass.set_pipeline(pipeline);
                pass.set_bind_group(0, &step.bindings, &[]);
                match node.size {
                    None => pass.dispatch_workgroups(groups[0], groups[1], 1),
                    Some(size) => {
                        let (buffer, offset) = self.arguments(size);
                        pass.dispatch_workgroups_indirect(buffer, offset);
                    }
                }
            }
            (Stage::Draw(pipeline), Extent::Vertices(count)) => {
                let stamps = clock.map(|clock| clock.draw_stamps(number));
                let mut pass = self.begin_draw(encoder, node, stamps);
                pass.set_pipeline(pipeline);
                pass.set_bind_group(0, &step.bindings, &[]);
                match node.size {
                    None => pass.draw(0..count, 0..1),
                    Some(size) => {
                        let (buffer, offset) = self.arguments(size);
                        pass.draw_indirect(buffer, offset);
                    }
                }
            }
            _ => unreachable!(
                "pass {} was compiled for another kind of work",
                node.pass.name
            ),
        }
    }

    /// Where the device finds the size of a node: a buffer, and an offset in bytes.
    fn arguments(&self, WorkSize { arguments, index }: WorkSize) -> (&wgpu::Buffer, u64) {
        match &self.memory[arguments.index()] {
            Memory::Buffer(buffer) => (buffer, (index * size_of::<Arguments>()) as u64),
            Memory::Image(_) => unreachable!("graphs take sizes from buffers alone"),
        }
    }

    fn begin_draw<'a>(
        &self,
        encoder: &'a mut wgpu::CommandEncoder,
        node: &Node,
        stamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
    ) -> wgpu::RenderPass<'a> {
        // Sort the targets into colours and depths.
        let targets = node.targets().filter_map(|target| {
            let image = self.memory[target.image.index()].image()?;
            Some((image.format, &image.layers[target.layer as usize]))
        });
        let (depths, colors): (Vec<_>, Vec<_>) =
            targets.partition(|(format, _)| *format == Format::Depth);
        let colors: Vec<_> = colors
            .iter()
            .map(|(_, view)| Some(color_attachment(view, node.clears)))
            .collect();

        // Clear them or keep them, as the node says.
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some(node.pass.name),
            color_attachments: &colors,
            depth_stencil_attachment: depths
                .first()
                .map(|(_, view)| depth_attachment(view, node.clears)),
            timestamp_writes: stamps,
            occlusion_query_set: None,
            multiview_mask: None,
        })
    }

    /// The times of all nodes; nodes without work took none.
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

    /// Runs every node once, and reads resources, in one submission.
    ///
    /// Where the device has no clock, the times are one entry named `device`: the wall time until all was done.
    fn run_reading(
        &mut self,
        ids: &[ResourceId],
    ) -> Result<(Vec<PassTime>, Readings), EngineError> {
        self.gpu.check()?;
        if self.times_apart {
            return Ok((self.run_apart()?, self.read_all(ids)?));
        }

        // Submit all passes with the copies of what is read.
        self.make_room(ids)?;
        let start = Instant::now();
        let ((), submission) = self.gpu.submit("the submission of a frame", |encoder| {
            self.record_steps(encoder, self.clock.as_ref());
            if let Some(clock) = &self.clock {
                clock.stage(encoder);
            }
            self.stage(encoder, ids);
        })?;

        // Wait once for all of it.
        let stamps = self.clock.iter().map(Clock::staging);
        let rooms = self.rooms(ids).chain(stamps);
        let mut words = Staging::words_of(&self.gpu, rooms, submission)?;
        let times = match &self.clock {
            Some(clock) => self.node_times(&clock.times(&words.pop().unwrap_or_default())),
            None => vec![PassTime {
                name: ALL_PASSES,
                time: start.elapsed(),
            }],
        };
        Ok((times, ids.iter().copied().zip(words).collect()))
    }

    fn read_all(&mut self, ids: &[ResourceId]) -> Result<Readings, EngineError> {
        self.gpu.check()?;
        self.make_room(ids)?;
        let place = ids
            .first()
            .map_or("nothing", |id| self.graph.resource(*id).name);
        let record = |encoder: &mut _| self.stage(encoder, ids);
        let ((), submission) = self.gpu.submit(place, record)?;
        let words = Staging::words_of(&self.gpu, self.rooms(ids), submission)?;
        Ok(ids.iter().copied().zip(words).collect())
    }
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

/// The operation on a target: it is cleared or kept, and always stored.
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
