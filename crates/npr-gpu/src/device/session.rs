//! A graph with its memory on a device.

use super::clock::Clock;
use super::gpu::Gpu;
use super::memory::Memory;
use super::pipeline::{PipelineCache, Stage};
use super::room::Room;
use super::staging::Staging;
use super::step::{Extent, Step};
use crate::engine::{EngineError, IN_FLIGHT, PassTime, Readings, Session};
use crate::flight::{self, Flight};
use crate::graph::{Graph, Node, ResourceId, WorkSize, emptied};
use crate::pass::Format;
use npr_vector::rank::work::Arguments;
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
    /// What runs are copied to before they are read: the second is empty until two runs are in flight.
    rooms: [Room; IN_FLIGHT],
    /// The number of the room that the run submitted last is copied to.
    last_room: usize,
    /// Runs that are submitted and not collected.
    runs: Flight<Run>,
    /// When the run collected last was done.
    idle_since: Instant,
}

/// A run that is not collected.
#[derive(Debug)]
enum Run {
    /// The device works on it.
    Submitted {
        submission: wgpu::SubmissionIndex,
        /// When it was submitted.
        start: Instant,
        /// The resources that are copied, and the number of the room that they are copied to.
        ids: Vec<ResourceId>,
        room: usize,
    },
    /// Its passes were waited for one by one.
    Done(Vec<PassTime>, Readings),
}

impl DeviceSession {
    /// A graph with its memory, its passes compiled unless `pipelines` has them.
    pub(super) fn new(
        gpu: Arc<Gpu>,
        pipelines: &PipelineCache,
        graph: Graph,
        times_apart: bool,
    ) -> Result<Self, EngineError> {
        // Take memory.
        gpu.check()?;
        let more = usages_of(&graph);
        let memory: Vec<Memory> = graph
            .resources()
            .iter()
            .zip(more)
            .map(|(resource, more)| Memory::new(&gpu, resource, more))
            .collect::<Result<_, _>>()?;

        // Fill what the graph holds from the start.
        for (id, words) in graph.held() {
            let name = graph.resource(id).name;
            gpu.guarded(name, || memory[id.index()].write_at(&gpu.queue, 0, words))?;
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
            rooms: Default::default(),
            last_room: 0,
            runs: Flight::new(),
            idle_since: Instant::now(),
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

    /// The steps that bind a resource, bound anew, by their numbers.
    fn rebound(&self, graph: &Graph, id: ResourceId) -> Result<Vec<(usize, Step)>, EngineError> {
        let steps = self.steps.iter().enumerate();
        let binding = steps.filter(|(_, step)| graph.nodes()[step.node].bound.contains(&id));
        binding
            .map(|(number, step)| Ok((number, step.rebound(&self.gpu, graph, &self.memory)?)))
            .collect()
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

    /// Makes place in a room for copies of resources, and of the stamps of `clock`.
    fn make_place(
        &mut self,
        room: usize,
        ids: &[ResourceId],
        with_stamps: bool,
    ) -> Result<(), EngineError> {
        let clock = self.clock.as_ref().filter(|_| with_stamps);
        let room = &mut self.rooms[room];
        room.fit_results(&self.gpu, (&self.graph, &self.memory), ids)?;
        room.fit_stamps(&self.gpu, clock)
    }

    /// Submits all passes with the copies of what is read into a room.
    fn submit_all(
        &mut self,
        room: usize,
        ids: &[ResourceId],
    ) -> Result<wgpu::SubmissionIndex, EngineError> {
        self.make_place(room, ids, true)?;
        let room = &self.rooms[room];
        let ((), submission) = self.gpu.submit("the submission of a frame", |encoder| {
            self.record_steps(encoder, self.clock.as_ref());
            if let Some(clock) = &self.clock {
                room.stage_stamps(encoder, clock);
            }
            room.stage_results(encoder, &self.memory, ids);
        })?;
        Ok(submission)
    }

    /// Copies resources as the last run left them, and waits for that; no run may be in flight that needs the first
    /// room.
    fn copied(&mut self, ids: &[ResourceId]) -> Result<Readings, EngineError> {
        self.make_place(0, ids, false)?;
        let room = &self.rooms[0];
        let place = ids
            .first()
            .map_or("nothing", |id| self.graph.resource(*id).name);
        let record = |encoder: &mut _| room.stage_results(encoder, &self.memory, ids);
        let ((), submission) = self.gpu.submit(place, record)?;
        let words = Staging::words_of(&self.gpu, room.results(ids), submission)?;
        Ok(ids.iter().copied().zip(words).collect())
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
                match (node.indices(), node.size) {
                    (Some(indices), _) => {
                        let corners = self.array(indices).slice(..);
                        pass.set_index_buffer(corners, wgpu::IndexFormat::Uint32);
                        pass.draw_indexed(0..count, 0, 0..1);
                    }
                    (None, None) => pass.draw(0..count, 0..1),
                    (None, Some(size)) => {
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
        let offset = (index * size_of::<Arguments>()) as u64;
        (self.array(arguments), offset)
    }

    fn array(&self, id: ResourceId) -> &wgpu::Buffer {
        let buffer = self.buffer(id);
        buffer.unwrap_or_else(|| unreachable!("sizes and indices are taken from buffers alone"))
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
    fn write_at(&mut self, id: ResourceId, first: usize, words: &[u32]) -> Result<(), EngineError> {
        self.graph.assert_takes(id, first, words.len());
        self.gpu.check()?;
        self.gpu.guarded(self.graph.resource(id).name, || {
            self.memory[id.index()].write_at(&self.gpu.queue, first, words)
        })
    }

    /// Takes new memory, and binds it anew in the passes that use it.
    fn grow(&mut self, id: ResourceId, count: usize) -> Result<(), EngineError> {
        let mut graph = self.graph.clone();
        if !graph.grow(id, count) {
            return Ok(());
        }
        self.gpu.check()?;
        let usages = usages_of(&graph)[id.index()];
        let larger = Memory::new(&self.gpu, graph.resource(id), usages)?;
        let smaller = std::mem::replace(&mut self.memory[id.index()], larger);
        match self.rebound(&graph, id) {
            Ok(steps) => {
                for (number, step) in steps {
                    self.steps[number] = step;
                }
                self.graph = graph;
                Ok(())
            }
            Err(error) => {
                self.memory[id.index()] = smaller;
                Err(error)
            }
        }
    }

    /// Starts a run and the copying of what it reads, in one submission.
    ///
    /// Where passes are timed one by one, each is submitted and waited for alone: the run is done when this returns.
    fn submit(&mut self, ids: &[ResourceId]) -> Result<(), EngineError> {
        self.runs.check_room();
        self.gpu.check()?;
        let run = if self.times_apart {
            Run::Done(self.run_apart()?, self.copied(ids)?)
        } else {
            // A run alone needs the first room, of two in flight each the one that the other leaves.
            let room = match self.runs.count() {
                0 => 0,
                _ => (self.last_room + 1) % IN_FLIGHT,
            };
            let start = Instant::now();
            let submission = self.submit_all(room, ids)?;
            self.last_room = room;
            Run::Submitted {
                submission,
                start,
                ids: ids.to_vec(),
                room,
            }
        };
        self.runs.push(run);
        Ok(())
    }

    /// Waits once for the run that was submitted first.
    ///
    /// Where the device has no clock, the times are one entry named `device`: the wall time from the submission, or
    /// from when the run before was done, until all was done.
    fn collect(&mut self) -> Result<(Vec<PassTime>, Readings), EngineError> {
        let (submission, start, ids, room) = match self.runs.pop() {
            Run::Done(times, readings) => return Ok((times, readings)),
            Run::Submitted {
                submission,
                start,
                ids,
                room,
            } => (submission, start, ids, &self.rooms[room]),
        };
        self.gpu.check()?;
        let stagings = room.results(&ids).chain(room.stamps());
        let mut words = Staging::words_of(&self.gpu, stagings, submission)?;
        let start = start.max(self.idle_since);
        self.idle_since = Instant::now();
        let times = match &self.clock {
            Some(clock) => self.node_times(&clock.times(&words.pop().unwrap_or_default())),
            None => vec![PassTime {
                name: ALL_PASSES,
                time: self.idle_since - start,
            }],
        };
        Ok((times, ids.into_iter().zip(words).collect()))
    }

    fn in_flight(&self) -> usize {
        self.runs.count()
    }

    fn read_all(&mut self, ids: &[ResourceId]) -> Result<Readings, EngineError> {
        flight::check_none(self.runs.count());
        self.gpu.check()?;
        self.copied(ids)
    }
}

/// What every buffer of a graph is used for besides binding and copying: it may hold the size of later passes, or their
/// indices.
fn usages_of(graph: &Graph) -> Vec<wgpu::BufferUsages> {
    let mut more = vec![wgpu::BufferUsages::empty(); graph.resources().len()];
    for WorkSize { arguments, .. } in graph.nodes().iter().filter_map(|node| node.size) {
        more[arguments.index()] |= wgpu::BufferUsages::INDIRECT;
    }
    for id in graph.nodes().iter().filter_map(Node::indices) {
        more[id.index()] |= wgpu::BufferUsages::INDEX;
    }
    more
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::device::testing;
    use crate::passes::vector::SCAN_BLOCKS;

    #[test]
    fn a_second_room_is_made_for_a_second_run_in_flight() {
        let Some(device) = testing::device() else {
            return;
        };
        let mut graph = Graph::new();
        let values = graph.buffer::<u32>("values", 4);
        let prefixes = graph.buffer::<u32>("prefixes", 4);
        let sums = graph.buffer::<u32>("sums", 1);
        graph.compute(&SCAN_BLOCKS, &[values, prefixes, sums]);
        let mut session = device.session(graph).expect("a session");
        let counts = |session: &DeviceSession| session.rooms.each_ref().map(Room::count);
        let stamps = usize::from(device.has_clock());

        // One after the other, runs share one room.
        for _ in 0..3 {
            session.run_reading(&[prefixes]).expect("a run");
            session.read_all(&[prefixes, sums]).expect("read");
        }
        assert_eq!(counts(&session), [2 + stamps, 0]);

        // Of two in flight, the second has place for what it reads.
        session.submit(&[prefixes]).expect("a run");
        assert_eq!(counts(&session), [2 + stamps, 0]);
        for _ in 0..3 {
            session.submit(&[sums]).expect("another run");
            session.collect().expect("the first");
            assert_eq!(counts(&session), [2 + stamps, 1 + stamps]);
        }
    }
}
