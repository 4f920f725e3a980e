//! What a node costs beyond its work, and how the time of one pass grows, on the processor and on a device.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use npr_core::geometry::{Influence, Part, PosedVertex, Vertex};
use npr_core::outline::Outline;
use npr_core::window::View;
use npr_gpu::device::{AdapterChoice, Device};
use npr_gpu::engine::{Engine, Session};
use npr_gpu::graph::Graph;
use npr_gpu::passes::{mesh, vector};
use npr_gpu::processor::Processor;

/// Nodes of the graph that measures what a node costs.
const NODE_COUNT: u64 = 100;

/// The processor, and a device where there is one.
fn engines() -> Vec<(&'static str, Box<dyn Engine>)> {
    let mut engines: Vec<(_, Box<dyn Engine>)> = vec![("processor", Box::new(Processor))];
    match Device::open(AdapterChoice::Any) {
        Ok(device) => engines.push(("device", Box::new(device))),
        Err(error) => eprintln!("device left out: {error}"),
    }
    engines
}

/// Many passes over few values.
fn many_small_nodes(engine: &dyn Engine) -> Box<dyn Session> {
    let mut graph = Graph::new();
    let values = graph.buffer::<u32>("values", 64);
    let prefixes = graph.buffer::<u32>("prefixes", 64);
    let sums = graph.buffer::<u32>("sums", 1);
    for _ in 0..NODE_COUNT {
        graph.compute(&vector::SCAN_BLOCKS, &[values, prefixes, sums]);
    }
    engine.prepare(graph).expect("the graph is small")
}

/// One pass over `count` vertices, all of them at the origin of one matrix.
fn one_pass(engine: &dyn Engine, count: usize) -> Box<dyn Session> {
    let mut graph = Graph::new();
    let view = graph.uniform::<View>("view");
    let outline = graph.uniform::<Outline>("outline");
    let vertices = graph.buffer::<Vertex>("vertices", count);
    let influences = graph.buffer::<Influence>("influences", count);
    let palette = graph.buffer::<[[f32; 4]; 4]>("palette", 1);
    let parts = graph.buffer::<Part>("parts", 1);
    let posed = graph.buffer::<PosedVertex>("posed", count);
    graph.compute(
        &mesh::POSE_VERTICES,
        &[view, outline, vertices, influences, palette, parts, posed],
    );
    engine.prepare(graph).expect("the graph fits the device")
}

fn node_overhead(c: &mut Criterion) {
    let mut group = c.benchmark_group("nodes");
    group.throughput(Throughput::Elements(NODE_COUNT));
    for (name, engine) in engines() {
        let mut session = many_small_nodes(&*engine);
        group.bench_function(name, |b| b.iter(|| session.run().expect("the engine runs")));
    }
}

fn pass_over_elements(c: &mut Criterion) {
    let mut group = c.benchmark_group("pose_vertices");
    group.sample_size(20);
    for (name, engine) in engines() {
        for count in [1_000, 10_000, 100_000, 1_000_000] {
            group.throughput(Throughput::Elements(count as u64));
            let mut session = one_pass(&*engine, count);
            let id = BenchmarkId::new(name, count);
            group.bench_function(id, |b| b.iter(|| session.run().expect("the engine runs")));
        }
    }
}

criterion_group!(benches, node_overhead, pass_over_elements);
criterion_main!(benches);
