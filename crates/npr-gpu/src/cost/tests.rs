use super::*;
use crate::curves::work::{IndirectArguments, add_work};
use crate::engine::Engine;
use crate::pass::{Agreement, append, read, texture, uniform, update, write};
use crate::processor::Processor;
use npr_shaders::Shader;
use npr_vector::rank::work::WorkRule;
use proptest::prelude::*;

/// A struct of 16 bytes.
type Four = [u32; 4];

const fn shader(text: &'static str) -> Shader {
    Shader { path: "test", text }
}

/// A dispatch with a slot of every kind; two barriers in its text, and one in a comment.
const MIX: Pass = Pass {
    name: "test.mix",
    shader: shader("workgroupBarrier();\n// workgroupBarrier();\nstorageBarrier();"),
    slots: &[
        uniform::<Four>("settings"),
        read::<Four>("pairs"),
        read::<u32>("shared"),
        texture("texels", Format::Rgba8),
        update::<u32>("sums"),
        write::<u32>("made"),
        read::<u32>("sky").serving(Features::SKY),
        read::<u32>("twins").for_twin(),
    ],
    work: Work::PerElement { of: "made" },
    agreement: Agreement::Exact,
    twin: |_| {},
};

/// Lists the elements that are not zero.
const LIST: Pass = Pass {
    name: "test.list",
    shader: shader(""),
    slots: &[read::<u32>("numbers"), append("list")],
    work: Work::PerElement { of: "numbers" },
    agreement: Agreement::Exact,
    twin: |b| {
        let numbers: &[u32] = b.read(0);
        let list: &mut [u32] = b.write(1);
        for (number, _) in (0..).zip(numbers).filter(|(_, number)| **number != 0) {
            list[0] += 1;
            list[list[0] as usize] = number;
        }
    },
};

/// Works through a list.
const FOLLOW: Pass = Pass {
    name: "test.follow",
    shader: shader(""),
    slots: &[
        read::<u32>("list"),
        read::<Four>("fours"),
        update::<u32>("sums"),
    ],
    work: Work::PerListed { of: "list" },
    agreement: Agreement::Exact,
    twin: |_| {},
};

/// Draws the first texel for every element, with a picture of the size of the target beside.
const DOT: Pass = Pass {
    name: "test.dot",
    shader: shader(""),
    slots: &[read::<Four>("corners"), read::<Four>("under")],
    work: Work::Draw {
        of: "corners",
        vertices: 6,
        targets: &[Format::Rgba8, Format::Depth],
        fills: false,
    },
    agreement: Agreement::Exact,
    twin: |b| b.image_mut(2).texels[..3].fill(7),
};

/// The costs of a graph after one run, with its first buffer filled.
fn costs(graph: &Graph, filled: Option<(ResourceId, &[u32])>) -> Vec<Cost> {
    let mut session = Processor.prepare(graph.clone()).expect("never fails");
    if let Some((id, words)) = filled {
        session.write(id, words).expect("never fails");
    }
    session.run().expect("never fails");
    let costs = pass_costs(graph, session.as_mut()).expect("never fails");
    costs.into_iter().map(|pass| pass.cost).collect()
}

/// What `MIX` binds in a graph: `made` of `room` elements, twice as many pairs, three times as many texels.
fn mixed(graph: &mut Graph, room: u32, shared: usize) -> Vec<ResourceId> {
    vec![
        graph.uniform::<Four>("settings"),
        graph.buffer::<Four>("pairs", 2 * room as usize),
        graph.buffer::<u32>("shared", shared),
        graph.image("texels", Format::Rgba8, [3, room]),
        graph.buffer::<u32>("sums", room as usize),
        graph.buffer::<u32>("made", room as usize),
        graph.buffer::<u32>("sky", 1000),
        graph.buffer::<u32>("twins", 1000),
    ]
}

#[test]
fn a_dispatch_costs_what_was_counted_by_hand() {
    let mut graph = Graph::with(Features::NONE);
    let bound = mixed(&mut graph, 100, 7);
    graph.compute(&MIX, &bound);
    let (in_step, sums) = (200 * 16 + 300 * 4, 100 * 4);
    let expected = Cost {
        launches: 1,
        workgroups: 2,
        invocations: 128,
        read_bytes: 16 + in_step + 7 * 4 + sums,
        written_bytes: sums + 100 * 4,
        whole_bytes: 7 * 4,
        barriers: 0,
        workgroup_barriers: 2,
    };
    assert_eq!(costs(&graph, None), [expected]);
    assert_eq!(expected.bytes(), 16 + 4400 + 28 + 400 + 800);
}

#[test]
fn slots_of_features_count_where_the_graph_has_them() {
    let mut graph = Graph::with(Features::NONE);
    let bound = mixed(&mut graph, 100, 7);
    graph.compute(&MIX, &bound);
    let plain = costs(&graph, None)[0];
    let whole = costs(&graph.with_all_features(), None)[0];
    assert_eq!(whole.read_bytes - plain.read_bytes, 1000 * 4);
    // Ten elements of the sky for each of the others.
    assert_eq!(whole.whole_bytes, plain.whole_bytes);
}

#[test]
fn lists_cost_what_is_in_them() {
    let mut graph = Graph::new();
    let numbers = graph.buffer::<u32>("numbers", 640);
    let list = graph.buffer::<u32>("list", 641);
    graph.compute(&LIST, &[numbers, list]);
    let work = add_work(&mut graph, list, 640, IndirectArguments::default());
    let fours = graph.buffer::<Four>("fours", 640);
    let sums = graph.buffer::<u32>("sums", 640);
    graph.compute_sized(&FOLLOW, &[list, fours, sums], work.elements());
    for listed in [0u64, 1, 64, 65, 640] {
        let words: Vec<u32> = (0..640).map(|i| u32::from(i < listed)).collect();
        let [made, sized, followed] = costs(&graph, Some((numbers, &words)))[..] else {
            panic!("three passes");
        };
        assert_eq!((made.read_bytes, made.workgroups), (640 * 4, 10));
        assert_eq!(made.written_bytes, (1 + listed) * 4, "{listed}");
        // The pass that makes sizes reads its rule and the list's length.
        let rule = size_of::<WorkRule>() as u64;
        assert_eq!((sized.read_bytes, sized.whole_bytes), (rule + 4, 0));
        // A list that is empty still starts the workgroups of a block, which read nothing of the rest.
        let groups = listed.div_ceil(512).max(1) * 8;
        assert_eq!(
            (followed.workgroups, followed.invocations),
            (groups, groups * 64)
        );
        let read = if listed == 0 { 0 } else { 4 + listed * 24 };
        assert_eq!(followed.read_bytes, read, "{listed}");
        assert_eq!(
            (followed.written_bytes, followed.whole_bytes),
            (listed * 4, 0)
        );
    }
}

#[test]
fn draws_cost_what_they_drew() {
    let mut graph = Graph::new();
    let corners = graph.buffer::<Four>("corners", 5);
    let under = graph.buffer::<Four>("under", 8 * 4);
    let targets = [
        graph.image("picture", Format::Rgba8, [8, 4]),
        graph.image("depths", Format::Depth, [8, 4]),
    ];
    for clears in [true, false] {
        graph.draw(&DOT, &[corners, under], &targets, clears);
    }
    let [cleared, kept] = costs(&graph, None)[..] else {
        panic!("two passes");
    };
    // Thirty vertices and three texels, which read what lies under them and a depth.
    assert_eq!(
        (kept.launches, kept.workgroups, kept.invocations),
        (1, 0, 33)
    );
    assert_eq!(
        (kept.read_bytes, kept.whole_bytes),
        (5 * 16 + 3 * 16 + 3 * 4, 0)
    );
    assert_eq!(kept.written_bytes, 3 * 2 * 4);
    assert_eq!(cleared.written_bytes, kept.written_bytes + 32 * 2 * 4);
    assert_eq!(cleared.read_bytes, kept.read_bytes);
}

#[test]
fn passes_without_work_cost_nothing_unless_they_clear() {
    let mut graph = Graph::new();
    let corners = graph.buffer::<Four>("corners", 0);
    let under = graph.buffer::<Four>("under", 32);
    let targets = [
        graph.image("picture", Format::Rgba8, [8, 4]),
        graph.image("depths", Format::Depth, [8, 4]),
    ];
    graph.draw(&DOT, &[corners, under], &targets, false);
    graph.draw(&DOT, &[corners, under], &targets, true);
    let clearing = Cost {
        launches: 1,
        written_bytes: 2 * 32 * 4,
        ..Cost::default()
    };
    assert_eq!(costs(&graph, None), [Cost::default(), clearing]);
}

#[test]
fn barriers_stand_where_passes_depend_on_each_other() {
    let mut graph = Graph::new();
    let [a, b, c, d] = ["a", "b", "c", "d"].map(|name| graph.buffer::<u32>(name, 65));
    // Reads a, empties and fills b: nothing to wait for but the emptied list.
    graph.compute(&LIST, &[a, b]);
    // Reads a too, and fills another list: only for the emptied one.
    graph.compute(&LIST, &[a, c]);
    // Empties b, which was filled before the last barrier; then reads c and fills b, which were not.
    graph.compute(&LIST, &[c, b]);
    // Reads b.
    graph.compute(&LIST, &[b, d]);
    // Empties what the pass before reads.
    graph.compute(&LIST, &[a, b]);
    let barriers: Vec<u64> = costs(&graph, None).iter().map(|c| c.barriers).collect();
    assert_eq!(barriers, [1, 1, 1, 1, 2]);
}

#[test]
fn a_copy_reads_and_writes_a_result() {
    let mut graph = Graph::new();
    let frame = graph.buffer::<u32>("frame", 50);
    let cost = copy_cost(&graph, frame).cost;
    assert_eq!((cost.read_bytes, cost.written_bytes), (200, 200));
    assert_eq!((cost.launches, cost.barriers), (0, 1));
}

/// The bytes of buffers that the invocations of `MIX` touch, marked one by one: reads, then writes.
fn marked(room: u32, shared: usize) -> [u64; 2] {
    let (mut reads, mut writes) = (BTreeSet::new(), BTreeSet::new());
    let mark = |into: &mut BTreeSet<(&str, u32)>, slot, first: u32, bytes: u32| {
        into.extend((first..first + bytes).map(|byte| (slot, byte)));
    };
    for item in 0..room {
        mark(&mut reads, "settings", 0, 16);
        mark(&mut reads, "pairs", item * 32, 32);
        mark(&mut reads, "shared", 0, shared as u32 * 4);
        mark(&mut reads, "texels", item * 12, 12);
        mark(&mut reads, "sums", item * 4, 4);
        mark(&mut writes, "sums", item * 4, 4);
        mark(&mut writes, "made", item * 4, 4);
    }
    [reads.len() as u64, writes.len() as u64]
}

proptest! {
    #[test]
    fn bytes_are_those_that_invocations_touch(room in 1u32..300, shared in 0usize..50) {
        let mut graph = Graph::with(Features::NONE);
        let bound = mixed(&mut graph, room, shared);
        graph.compute(&MIX, &bound);
        let cost = costs(&graph, None)[0];
        prop_assert_eq!([cost.read_bytes, cost.written_bytes], marked(room, shared));
        prop_assert!(cost.whole_bytes <= cost.read_bytes);
    }

    /// The least number of barriers, found by trying: between any two passes of which one needs the other, there is
    /// one, and each that stands is needed.
    #[test]
    fn barriers_divide_what_depends(picks in prop::collection::vec((0usize..5, 0usize..5), 1..12)) {
        let mut graph = Graph::new();
        let buffers = ["a", "b", "c", "d", "e"].map(|name| graph.buffer::<u32>(name, 4));
        let picks: Vec<_> = picks.into_iter().filter(|(from, to)| from != to).collect();
        for (from, to) in &picks {
            graph.compute(&COPY_ALL, &[buffers[*from], buffers[*to]]);
        }
        let found: Vec<u64> = costs(&graph, None).iter().map(|c| c.barriers).collect();
        let mut since = 0;
        for (i, (from, to)) in picks.iter().enumerate() {
            let depends = picks[since..i].iter().any(|(f, t)| t == from || t == to || f == to);
            prop_assert_eq!(found[i], u64::from(depends));
            since = if depends { i } else { since };
        }
    }
}

/// Reads one buffer and writes another.
const COPY_ALL: Pass = Pass {
    name: "test.copy",
    shader: shader(""),
    slots: &[read::<u32>("from"), write::<u32>("to")],
    work: Work::PerElement { of: "to" },
    agreement: Agreement::Exact,
    twin: |_| {},
};
