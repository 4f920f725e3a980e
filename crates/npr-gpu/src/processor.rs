//! The engine that needs no graphics device: every node runs its pass's twin.

use crate::engine::{Engine, EngineError, PassTime, Session};
use crate::graph::Kind;
use crate::graph::{Graph, Node, ResourceId, writes};
use crate::pass::{Access, Bindings, Bound, Work};
use rayon::prelude::*;
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
        let memory = graph
            .resources()
            .iter()
            .map(|resource| vec![0; resource.word_count()])
            .collect();
        Ok(Box::new(ProcessorSession { graph, memory }))
    }
}

struct ProcessorSession {
    graph: Graph,
    memory: Vec<Vec<u32>>,
}

impl Session for ProcessorSession {
    fn write(&mut self, id: ResourceId, words: &[u32]) -> Result<(), EngineError> {
        self.memory[id.index()][..words.len()].copy_from_slice(words);
        Ok(())
    }

    fn run(&mut self) -> Result<Vec<PassTime>, EngineError> {
        let nodes = self.graph.nodes();
        Ok(nodes
            .iter()
            .map(|node| run_node(&self.graph, node, &mut self.memory))
            .collect())
    }

    fn read(&mut self, id: ResourceId) -> Result<Vec<u32>, EngineError> {
        Ok(self.memory[id.index()].clone())
    }
}

/// Runs one twin on memory that is lent out for the time.
fn run_node(graph: &Graph, node: &Node, memory: &mut [Vec<u32>]) -> PassTime {
    let start = Instant::now();
    let written: Vec<ResourceId> = writes(node).collect();
    let mut lent: Vec<Vec<u32>> = written
        .iter()
        .map(|id| std::mem::take(&mut memory[id.index()]))
        .collect();
    let fills = matches!(node.pass.work, Work::Draw { fills: true, .. });
    if node.clears && !(fills && graph.work_count(node) > 0) {
        clear_targets(node, &written, &mut lent);
    }
    if graph.work_count(node) > 0 {
        let mut free = lent.iter_mut();
        let bound = node.bound.iter().enumerate().map(|(i, id)| {
            let size = image_size(graph, *id);
            let is_read = node
                .pass
                .slots
                .get(i)
                .is_some_and(|slot| slot.access != Access::Write);
            match if is_read { None } else { free.next() } {
                Some(words) => Bound::Write { words, size },
                None => Bound::Read {
                    words: &memory[id.index()],
                    size,
                },
            }
        });
        (node.pass.twin)(&mut Bindings {
            bound: bound.collect(),
        });
    }
    for (id, words) in written.iter().zip(lent) {
        memory[id.index()] = words;
    }
    PassTime {
        name: node.pass.name,
        time: start.elapsed(),
    }
}

/// Zeroes the targets among the lent memory: they come after the slots.
fn clear_targets(node: &Node, written: &[ResourceId], lent: &mut [Vec<u32>]) {
    let targets = &node.bound[node.pass.slots.len()..];
    for (id, words) in written.iter().zip(lent) {
        if targets.contains(id) {
            words
                .par_chunks_mut(1 << 16)
                .for_each(|chunk| chunk.fill(0));
        }
    }
}

fn image_size(graph: &Graph, id: ResourceId) -> [u32; 2] {
    match graph.resource(id).kind {
        Kind::Image { size, .. } => size,
        _ => [0; 2],
    }
}
