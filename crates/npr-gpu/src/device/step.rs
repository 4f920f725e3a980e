//! A node with all that the device needs to run it.

use super::gpu::Gpu;
use super::memory::Memory;
use super::pipeline::{Pipeline, PipelineCache};
use crate::engine::EngineError;
use crate::graph::{Graph, Node};
use crate::pass::Work;
use std::sync::Arc;

/// A node that has something to do.
#[derive(Debug)]
pub(super) struct Step {
    /// Position of the node in its graph.
    pub(super) node: usize,
    /// The pass, compiled.
    pub(super) pipeline: Arc<Pipeline>,
    /// Group 0.
    pub(super) bindings: wgpu::BindGroup,
    /// The most work that it may have.
    pub(super) extent: Extent,
}

/// The most work that a step has room for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Extent {
    /// Workgroups in x and y.
    Groups([u32; 2]),
    /// Vertices.
    Vertices(u32),
}

impl Step {
    /// The steps of all nodes that change anything, in running order.
    pub(super) fn all_of(
        gpu: &Gpu,
        pipelines: &PipelineCache,
        graph: &Graph,
        memory: &[Memory],
    ) -> Result<Vec<Self>, EngineError> {
        // Leave out nodes that would draw nothing.
        let nodes = graph.nodes();
        let extents = nodes.iter().map(|node| extent_of(graph, node));
        let extents: Vec<Extent> = extents.collect::<Result<_, _>>()?;
        let acting: Vec<usize> = (0..nodes.len())
            .filter(|i| graph.acts(&nodes[*i]))
            .collect();

        // Compile the passes of the others, and bind their resources.
        let passes: Vec<_> = acting.iter().map(|i| nodes[*i].pass).collect();
        let compiled = pipelines.get_all(gpu, &passes, graph.features())?;
        let steps = acting.into_iter().zip(compiled).map(|(node, pipeline)| {
            let bindings = bind(gpu, graph, &nodes[node], &pipeline, memory)?;
            let extent = extents[node];
            Ok(Self {
                node,
                pipeline,
                bindings,
                extent,
            })
        });
        steps.collect()
    }
}

impl Step {
    /// The same step in a graph whose resources have grown.
    pub(super) fn rebound(
        &self,
        gpu: &Gpu,
        graph: &Graph,
        memory: &[Memory],
    ) -> Result<Self, EngineError> {
        let node = &graph.nodes()[self.node];
        let pipeline = Arc::clone(&self.pipeline);
        Ok(Self {
            node: self.node,
            bindings: bind(gpu, graph, node, &pipeline, memory)?,
            extent: extent_of(graph, node)?,
            pipeline,
        })
    }
}

/// Group 0 of a node: the resources of its slots.
fn bind(
    gpu: &Gpu,
    graph: &Graph,
    node: &Node,
    pipeline: &Pipeline,
    memory: &[Memory],
) -> Result<wgpu::BindGroup, EngineError> {
    // Match the resources of the node with the slots of its pass.
    let bound = (0..).zip(node.pass.slots.iter().zip(&node.bound));
    let entries: Vec<_> = bound
        .filter(|(_, (slot, _))| slot.is_bound_for(graph.features()))
        .map(|(binding, (slot, id))| wgpu::BindGroupEntry {
            binding,
            resource: memory[id.index()].binding(slot.access),
        })
        .collect();

    // Bind them all at once.
    gpu.guarded(node.pass.name, || {
        gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(node.pass.name),
            layout: &pipeline.layout,
            entries: &entries,
        })
    })
}

fn extent_of(graph: &Graph, node: &Node) -> Result<Extent, EngineError> {
    let count = graph.work_count(node);
    let extent = match node.pass.work {
        Work::PerElement { .. } | Work::PerRun { .. } | Work::PerListed { .. } => {
            graph.room_groups(node).map(Extent::Groups)
        }
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
