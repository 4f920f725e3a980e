//! The engine that needs no graphics device: it runs the twin of every node's pass.

use crate::engine::{Engine, EngineError, PassTime, Readings, Session};
use crate::flight::{self, Flight};
use crate::graph::Kind;
use crate::graph::{Graph, Node, ResourceId, WorkSize, emptied, writes};
use crate::pass::{Bindings, Bound, Work};
use npr_core::interrupt::Interrupt;
use npr_vector::rank::work::Arguments;
use rayon::prelude::*;
use std::ops::Range;
use std::sync::Arc;
use std::time::Instant;

/// Runs graphs on the processor, with all threads of the current rayon pool.
///
/// The same graph and input give the same words on every platform and for every number of threads.
#[derive(Debug, Clone, Copy, Default)]
pub struct Processor;

impl Engine for Processor {
    fn describe(&self) -> String {
        format!("processor, {} threads", rayon::current_num_threads())
    }

    fn runs_twins(&self) -> bool {
        true
    }

    fn prepare(&self, graph: Graph) -> Result<Box<dyn Session>, EngineError> {
        let mut memory: Vec<Memory> = graph
            .resources()
            .iter()
            .map(|resource| Arc::new(vec![0; resource.word_count()]))
            .collect();
        for (id, words) in graph.held() {
            Arc::make_mut(&mut memory[id.index()]).copy_from_slice(words);
        }
        Ok(Box::new(ProcessorSession {
            graph,
            memory,
            done: Flight::new(),
            interrupt: Interrupt::default(),
        }))
    }
}

/// The words of a resource. What others keep too is copied before a pass writes it.
type Memory = Arc<Vec<u32>>;

struct ProcessorSession {
    graph: Graph,
    memory: Vec<Memory>,
    /// What runs left that are not collected, the first one first: later runs overwrite the memory.
    done: Flight<(Vec<PassTime>, Readings)>,
    /// Asked before each pass.
    interrupt: Interrupt,
}

impl ProcessorSession {
    fn readings(&self, ids: &[ResourceId]) -> Readings {
        let words = ids.iter().map(|id| (*id, self.memory[id.index()].to_vec()));
        words.collect()
    }
}

impl Session for ProcessorSession {
    fn write_at(&mut self, id: ResourceId, first: usize, words: &[u32]) -> Result<(), EngineError> {
        self.graph.assert_takes(id, first, words.len());
        let memory = Arc::make_mut(&mut self.memory[id.index()]);
        memory[first..][..words.len()].copy_from_slice(words);
        Ok(())
    }

    fn write_shared(&mut self, id: ResourceId, words: &Arc<Vec<u32>>) -> Result<(), EngineError> {
        let memory = &mut self.memory[id.index()];
        if memory.len() != words.len() {
            return self.write(id, words);
        }
        memory.clone_from(words);
        Ok(())
    }

    fn grow(&mut self, id: ResourceId, count: usize) -> Result<(), EngineError> {
        if self.graph.grow(id, count) {
            let words = self.graph.resource(id).word_count();
            self.memory[id.index()] = Arc::new(vec![0; words]);
        }
        Ok(())
    }

    fn heed(&mut self, interrupt: &Interrupt) {
        self.interrupt = interrupt.clone();
    }

    fn submit(&mut self, ids: &[ResourceId]) -> Result<(), EngineError> {
        self.done.check_room();
        let mut times = Vec::with_capacity(self.graph.nodes().len());
        for node in self.graph.nodes() {
            self.interrupt.check()?;
            times.push(run_node(&self.graph, node, &mut self.memory));
        }
        self.done.push((times, self.readings(ids)));
        Ok(())
    }

    fn collect(&mut self) -> Result<(Vec<PassTime>, Readings), EngineError> {
        Ok(self.done.pop())
    }

    fn in_flight(&self) -> usize {
        self.done.count()
    }

    fn read_all(&mut self, ids: &[ResourceId]) -> Result<Readings, EngineError> {
        flight::check_none(self.done.count());
        Ok(self.readings(ids))
    }
}

/// Runs one twin on memory that is lent to it meanwhile.
fn run_node(graph: &Graph, node: &Node, memory: &mut [Memory]) -> PassTime {
    // Lend out the memory that the pass writes.
    let start = Instant::now();
    let written: Vec<ResourceId> = writes(node).collect();
    let work_count = work_count(graph, node, memory);
    let mut lent: Vec<Vec<u32>> = written
        .iter()
        .map(|id| Arc::unwrap_or_clone(std::mem::take(&mut memory[id.index()])))
        .collect();

    // Empty what the pass appends to, or writes in part.
    for (id, count) in emptied(node) {
        if let Some(at) = written.iter().position(|other| *other == id) {
            let words = &mut lent[at];
            let end = count.unwrap_or(words.len()).min(words.len());
            clear(&mut words[..end]);
        }
    }

    // Clear the targets, unless every pixel is written anyway.
    let fills = matches!(node.pass.work, Work::Draw { fills: true, .. });
    if node.clears && !(fills && work_count > 0) {
        clear_targets(graph, node, &mut lent);
    }

    // Bind the slots and run the twin.
    if work_count > 0 {
        let mut free = lent.iter_mut();
        let bound = node.bound.iter().enumerate().map(|(i, id)| {
            let size = image_size(graph, *id);
            let is_read = node
                .pass
                .slots
                .get(i)
                .is_some_and(|slot| !slot.access.writes());
            match if is_read { None } else { free.next() } {
                Some(words) => Bound::Write {
                    words: &mut words[words_for(graph, node, i, work_count)],
                    size,
                },
                None => Bound::Read {
                    words: &memory[id.index()][words_for(graph, node, i, work_count)],
                    size,
                },
            }
        });
        (node.pass.twin)(&mut Bindings {
            bound: bound.collect(),
        });
    }

    // Take the memory back.
    for (id, words) in written.iter().zip(lent) {
        memory[id.index()] = Arc::new(words);
    }
    PassTime {
        name: node.pass.name,
        time: start.elapsed(),
    }
}

/// The number of work items of a node: all that there is room for, or fewer where its size says so.
fn work_count(graph: &Graph, node: &Node, memory: &[Memory]) -> usize {
    let Some(WorkSize { arguments, index }) = node.size else {
        return graph.work_count(node);
    };
    let made: &[Arguments] = bytemuck::cast_slice(&memory[arguments.index()]);
    graph.sized_work_count(node, &made[index])
}

/// The words of a binding that the node's work reaches: a twin works through the whole slices that it is given.
///
/// The slot that counts the work ends where the work does, and so do the slots written in step with it. A target is the
/// layer that is drawn into.
fn words_for(graph: &Graph, node: &Node, binding: usize, work_count: usize) -> Range<usize> {
    // Take the layer of a target.
    let Some(slot) = node.pass.slots.get(binding) else {
        let layer = node.layers[binding - node.pass.slots.len()];
        return graph.words_of(node.bound[binding].layer(layer));
    };

    // Cut off what the work does not reach; a list knows its own length.
    let resource = graph.resource(node.bound[binding]);
    let counted = node.pass.counted_slot();
    let is_in_step =
        slot.access.writes() && graph.element_count(node.bound[binding]) == graph.work_count(node);
    let is_listed = matches!(node.pass.work, Work::PerListed { .. });
    match resource.kind {
        Kind::Buffer { stride, .. } if !is_listed && (binding == counted || is_in_step) => {
            0..(stride * work_count).div_ceil(4)
        }
        _ => 0..resource.word_count(),
    }
}

/// Zeroes words.
fn clear(words: &mut [u32]) {
    let chunks = words.par_chunks_mut(1 << 16);
    chunks.for_each(|chunk| chunk.fill(0));
}

/// Zeroes the layers that are drawn into: their images are the last of the lent memory.
fn clear_targets(graph: &Graph, node: &Node, lent: &mut [Vec<u32>]) {
    let first = lent.len() - node.layers.len();
    for (target, words) in node.targets().zip(&mut lent[first..]) {
        clear(&mut words[graph.words_of(target)]);
    }
}

fn image_size(graph: &Graph, id: ResourceId) -> [u32; 2] {
    match graph.resource(id).kind {
        Kind::Image { size, .. } => size,
        _ => [0; 2],
    }
}
