//! Counted costs beside what a device does.

use crate::contours::engines;
use crate::shapes::{eyes, shape_from};
use crate::shared;
use npr_gpu::cost::pass_costs;
use npr_gpu::curves::Scheme;
use npr_gpu::curves::contours::add_contours;
use npr_gpu::curves::work::{IndirectArguments, add_work};
use npr_gpu::engine::Engine;
use npr_gpu::graph::Graph;
use npr_gpu::pass::{Agreement, Pass, Work, append, read};
use npr_mesh::testing::torus;
use npr_shaders::Shader;
use npr_vector::mesh_lines::contour::steps::Viewer;

/// Counts its own invocations, idle ones of the last workgroup included.
const COUNT: Pass = Pass {
    name: "test.count",
    shader: Shader {
        path: "test",
        text: "const WG: u32 = 64u;
        @group(0) @binding(0) var<storage, read> numbers: array<u32>;
        @group(0) @binding(1) var<storage, read_write> counter: array<atomic<u32>>;
        @compute @workgroup_size(WG)
        fn main() {
            atomicAdd(&counter[0], 1u + 0u * arrayLength(&numbers));
        }",
    },
    slots: &[read::<u32>("numbers"), append("counter")],
    work: Work::PerElement { of: "numbers" },
    agreement: Agreement::Exact,
    twin: |_| {},
};

#[test]
fn invocations_are_those_that_a_device_counts() {
    let Some(device) = shared::device() else {
        return;
    };
    for room in [1, 64, 65, 1000, 65535 * 64 + 1] {
        let mut graph = Graph::new();
        let length = graph.buffer::<u32>("length", 1);
        let work = add_work(&mut graph, length, room, IndirectArguments::default());
        let numbers = graph.buffer::<u32>("numbers", room);
        let counters = [0; 2].map(|_| graph.buffer::<u32>("counter", 1));
        graph.compute(&COUNT, &[numbers, counters[0]]);
        graph.compute_sized(&COUNT, &[numbers, counters[1]], work.elements());
        let mut session = device.prepare(graph.clone()).unwrap();
        for listed in [0, 1, room / 2, room] {
            session.write(length, &[listed as u32]).unwrap();
            session.run().unwrap();
            let costs = pass_costs(&graph, session.as_mut()).unwrap();
            for (cost, counter) in costs[1..].iter().zip(counters) {
                let counted = session.read(counter).unwrap()[0];
                assert_eq!(
                    cost.cost.invocations,
                    u64::from(counted),
                    "{listed} of {room}"
                );
            }
        }
    }
}

#[test]
fn both_engines_cost_the_same() {
    let shape = shape_from(&torus(48, 24, 0.7, 0.3));
    let mut graph = Graph::new();
    let sizes = [shape.positions.len(), shape.faces.len()];
    let made = add_contours(&mut graph, sizes[0], sizes[1], 4000, Some(Scheme::WYLLIE));
    let mut found = Vec::new();
    for engine in engines() {
        let mut session = engine.prepare(graph.clone()).unwrap();
        let viewer = [Viewer::from(&eyes(1.0)[0])];
        session
            .write(made.viewer, bytemuck::cast_slice(&viewer))
            .unwrap();
        made.write_shape(session.as_mut(), &shape).unwrap();
        session.run().unwrap();
        let costs = pass_costs(&graph, session.as_mut()).unwrap();
        let names = graph.nodes().iter().map(|node| node.pass.name);
        assert!(costs.iter().map(|pass| pass.name).eq(names));
        // Passes over the nodes follow their number, which is far below the room.
        let count = session.read(made.node_count).unwrap()[0];
        let rounds = costs.iter().filter(|pass| pass.name == "vector.rank_jump");
        let groups: Vec<u64> = rounds.map(|pass| pass.cost.workgroups).collect();
        let full = u64::from(count.div_ceil(512) * 8);
        assert!(
            count > 64 && groups.iter().all(|n| [0, full].contains(n)),
            "{groups:?}"
        );
        found.push(costs);
    }
    assert!(found.windows(2).all(|pair| pair[0] == pair[1]));
}
