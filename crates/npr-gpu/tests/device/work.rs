//! Passes that are sized by a length that only the engine knows, on both engines.

use crate::contours::engines;
use crate::lists::{Chains, lists};
use crate::sample_passes::{DOUBLE, DRAW_LARGEST};
use crate::shapes::{eyes, shape_from};
use npr_gpu::curves::contours::{Contours, add_contours};
use npr_gpu::curves::ranking::add_ranking;
use npr_gpu::curves::sums::{add_compact, add_scan, add_sum};
use npr_gpu::curves::work::{IndirectArguments, ListWork, add_work};
use npr_gpu::curves::{ResidentShape, Scheme};
use npr_gpu::engine::Engine;
use npr_gpu::graph::{Graph, ResourceId};
use npr_gpu::pass::Format;
use npr_mesh::testing::{cube, plane, random_soup, torus, uv_sphere};
use npr_vector::mesh_lines::contour::steps::Viewer;
use npr_vector::mesh_lines::contour::{EdgeContours, Eye};
use npr_vector::rank::scan::exclusive_scan;
use npr_vector::rank::{Link, link, rank_curves};

/// Elements of a full row of workgroups.
const ROW: u32 = 8191 * 512;

#[test]
fn arguments_are_the_expected_numbers_of_groups() {
    // Elements, and the workgroups over them, and those that sum up them, the sums of blocks, and the sums of these.
    let expected = [
        (0, [[8, 1], [1, 1], [1, 1], [1, 1]]),
        (1, [[8, 1], [1, 1], [1, 1], [1, 1]]),
        (512, [[8, 1], [1, 1], [1, 1], [1, 1]]),
        (513, [[16, 1], [2, 1], [1, 1], [1, 1]]),
        (512 * 512 + 1, [[513 * 8, 1], [513, 1], [2, 1], [1, 1]]),
        (ROW, [[65528, 1], [8191, 1], [16, 1], [1, 1]]),
        (ROW + 1, [[32768, 2], [4096, 2], [16, 1], [1, 1]]),
        // There is room for no more.
        (10_000_000, [[52088, 3], [6511, 3], [39, 1], [1, 1]]),
        (u32::MAX, [[52088, 3], [6511, 3], [39, 1], [1, 1]]),
    ];
    let indirect = IndirectArguments {
        vertices: 3,
        ..IndirectArguments::default()
    };
    for engine in engines() {
        let mut graph = Graph::new();
        let count = graph.buffer::<u32>("count", 1);
        let work = add_work(&mut graph, count, 10_000_000, indirect);
        let mut session = engine.prepare(graph).unwrap();
        for (length, levels) in expected {
            session.write(count, &[length]).unwrap();
            session.run().unwrap();
            let mut wanted: Vec<[u32; 4]> = levels.map(|[x, y]| [x, y, 1, 0]).to_vec();
            wanted.push([3 * length.min(10_000_000), 1, 0, 0]);
            let found = session.read(work.arguments().unwrap()).unwrap();
            assert_eq!(found, wanted.concat(), "{length} on {}", engine.describe());
        }
    }
}

/// What a sized pass leaves in a room: whole blocks are written, and nothing else.
fn check_reach(engine: &dyn Engine, room: u32, lengths: &[u32]) {
    let mut graph = Graph::new();
    let count = graph.buffer::<u32>("count", 1);
    let work = add_work(
        &mut graph,
        count,
        room as usize,
        IndirectArguments::default(),
    );
    let [from, to] = [0; 2].map(|_| graph.buffer::<u32>("numbers", room as usize));
    graph.compute_sized(&DOUBLE, &[from, to], work.elements());
    let mut session = engine.prepare(graph).unwrap();
    let untouched = vec![u32::MAX; room as usize];
    for length in lengths {
        session.write(count, &[*length]).unwrap();
        session.write(to, &untouched).unwrap();
        session.run().unwrap();
        let blocks = length.div_ceil(512).max(1);
        // Rows are equally wide, so a second row may hold one block more.
        let rows = blocks.div_ceil(8191);
        let reach = (blocks.div_ceil(rows) * rows * 512).min(room) as usize;
        let found = session.read(to).unwrap();
        let (done, behind) = found.split_at(reach);
        assert!((0..).zip(done).all(|(i, v)| *v == i), "{length} of {room}");
        assert!(*behind == untouched[reach..], "{length} of {room}");
    }
}

#[test]
fn work_ends_with_the_last_block_of_a_list() {
    for engine in engines() {
        check_reach(engine, 1000, &[0, 1, 64, 511, 512, 513, 999, 1000, 1001]);
        check_reach(engine, ROW + 1000, &[3, ROW, ROW + 1, ROW + 1000, 5]);
    }
}

#[test]
fn draws_end_with_a_list() {
    for engine in engines() {
        let mut graph = Graph::new();
        let count = graph.buffer::<u32>("count", 1);
        let indirect = IndirectArguments {
            vertices: DRAW_LARGEST.vertices(),
            ..IndirectArguments::default()
        };
        let work = add_work(&mut graph, count, 5, indirect);
        let numbers = graph.buffer::<u32>("numbers", 5);
        let picture = graph.image("picture", Format::U32, [3, 2]);
        let depths = graph.image("depths", Format::Depth, [3, 2]);
        let targets = [picture, depths];
        graph.draw_sized(&DRAW_LARGEST, (&[numbers], &targets), true, work.draw());
        let mut session = engine.prepare(graph).unwrap();
        session.write(numbers, &[10, 20, 30, 40, 50]).unwrap();
        for (length, largest) in [(0, 0), (1, 10), (3, 30), (5, 50), (6, 50), (2, 20)] {
            session.write(count, &[length]).unwrap();
            session.run().unwrap();
            assert_eq!(session.read(picture).unwrap(), [largest; 6], "{length}");
        }
    }
}

/// Sums, marks and totals of lists that grow and shrink in one room: nothing of a longer list stays in those of a
/// shorter one.
#[test]
fn sums_follow_a_list_that_grows_and_shrinks() {
    let room = 300_000;
    for engine in engines() {
        let mut graph = Graph::new();
        let count = graph.buffer::<u32>("count", 1);
        let work = add_work(&mut graph, count, room, IndirectArguments::default());
        let values = graph.buffer::<u32>("values", room);
        let scan = add_scan(&mut graph, values, &work);
        let sum = add_sum(&mut graph, values, &work);
        let marked = add_compact(&mut graph, values, room, &work);
        let mut session = engine.prepare(graph).unwrap();
        for length in [room, 1, 512, 513, 262_145, 64, 0, 65, room + 1] {
            let mut flags: Vec<u32> = (0..room as u32).map(|i| u32::from(i % 3 == 1)).collect();
            // What a pass before leaves in the last workgroup counts; what lies behind may be anything.
            let reach = (length.div_ceil(512).max(1) * 512).min(room);
            let (prefixes, total) = exclusive_scan(&flags[..reach]);
            flags[reach..].fill(7);
            session.write(count, &[length as u32]).unwrap();
            session.write(values, &flags).unwrap();
            session.run().unwrap();
            for id in [scan.total, sum, marked.count] {
                assert_eq!(session.read(id).unwrap(), [total], "{length}");
            }
            let found = session.read(scan.prefixes).unwrap();
            assert!(found[..reach] == prefixes, "{length}");
            let list = session.read(marked.list).unwrap();
            let wanted = (0..reach as u32).filter(|i| i % 3 == 1);
            assert!(wanted.eq(list[..total as usize].iter().copied()));
        }
    }
}

/// Rounds of ranking that are left out change nothing, to the bit.
#[test]
fn lists_in_a_large_room_are_ranked_as_in_one_that_fits() {
    let room = 20_000;
    for scheme in [Scheme::WYLLIE, Scheme::RULING_SET] {
        for engine in engines() {
            let mut graph = Graph::new();
            let count = graph.buffer::<u32>("count", 1);
            let rounds = match scheme {
                Scheme::Wyllie { .. } => 15,
                Scheme::RulingSet { .. } => 0,
            };
            let indirect = IndirectArguments {
                rounds,
                ..IndirectArguments::default()
            };
            let work = add_work(&mut graph, count, room, indirect);
            let links = graph.buffer::<Link>("links", room);
            let ranked = add_ranking(&mut graph, links, &work, scheme);
            let plain = graph.clone().without_sizes();
            let mut sessions = [graph, plain].map(|graph| engine.prepare(graph).unwrap());
            for length in [room, 1, 2, 63, 64, 65, 5000, 8193, 0, 130] {
                let (next, keys) = lists(Chains::Mixed, length, length as u32);
                let mut all = link(&next, &keys).unwrap();
                all.extend((length as u32..room as u32).map(|own| Link {
                    next: own,
                    prev: own,
                    key: 0,
                }));
                let results = sessions.each_mut().map(|session| {
                    session.write(count, &[length as u32]).unwrap();
                    session.write(links, bytemuck::cast_slice(&all)).unwrap();
                    session.run().unwrap();
                    assert_eq!(session.read(ranked.unsettled).unwrap(), [0]);
                    let mut first = |id, words| session.read(id).unwrap()[..words].to_vec();
                    let rows = ranked.rows;
                    [first(rows.standings, 3 * length), first(rows.order, length)]
                });
                assert!(results[0] == results[1], "{scheme:?} of {length}");
            }
        }
    }
}

/// A graph of contours in rows, with all that a view needs written.
fn contours_of(shape: &npr_mesh::half_edge::HalfEdgeMesh, capacity: usize) -> (Graph, ContourIds) {
    let mut graph = Graph::new();
    let sizes = [shape.positions.len(), shape.faces.len()];
    let scheme = Some(Scheme::WYLLIE);
    let made = add_contours(&mut graph, sizes[0], sizes[1], capacity, scheme);
    let rows = made.lists.unwrap().rows;
    let ids = ContourIds {
        made,
        outputs: [made.nodes, rows.standings, rows.order],
    };
    (graph, ids)
}

struct ContourIds {
    made: Contours,
    outputs: [ResourceId; 3],
}

/// Contours in a room that is much too large, that just fits and that is too small: the same as by passes over the
/// whole room, and nothing is written behind the last workgroup.
#[test]
fn contours_follow_their_number_in_any_room() {
    let shape = shape_from(&torus(48, 24, 0.7, 0.3));
    let eye = &eyes(1.0)[0];
    let exact = EdgeContours::new(&shape, eye).graph.nodes.len();
    assert!(exact > 64 && !exact.is_multiple_of(64));
    for engine in engines() {
        for capacity in [1, exact - 1, exact, exact + 1, 50 * exact] {
            let (graph, ids) = contours_of(&shape, capacity);
            let plain = graph.clone().without_sizes();
            let run = |graph: Graph| {
                let mut session = engine.prepare(graph).unwrap();
                let viewed = [Viewer::from(eye)];
                session
                    .write(ids.made.viewer, bytemuck::cast_slice(&viewed))
                    .unwrap();
                ids.made.write_shape(session.as_mut(), &shape).unwrap();
                session.run().unwrap();
                assert_eq!(session.read(ids.made.node_count).unwrap(), [exact as u32]);
                ids.outputs.map(|id| session.read(id).unwrap())
            };
            let (sized, plain) = (run(graph), run(plain));
            if capacity < exact {
                continue;
            }
            let reach = exact.next_multiple_of(512).min(capacity);
            for (sized, plain) in sized.iter().zip(&plain) {
                let stride = sized.len() / capacity;
                assert!(sized[..stride * exact] == plain[..stride * exact]);
                let behind = &sized[stride * reach..];
                assert!(behind.iter().all(|word| *word == 0), "room {capacity}");
            }
        }
    }
}

/// Views with many, few and no contours, one after the other in the same memory.
#[test]
fn views_of_any_number_of_contours_are_ranked_in_one_room() {
    let within = Eye::new([0.0, 0.0, 0.0, 1.0], 1.0);
    for (name, mesh) in [
        ("soup", random_soup(3000, 4)),
        ("sphere", uv_sphere(64, 40)),
        ("cube", cube()),
        ("plane", plane(40, 40)),
    ] {
        let shape = shape_from(&mesh);
        for engine in engines() {
            for scheme in [Scheme::WYLLIE, Scheme::RULING_SET] {
                let mut resident = ResidentShape::with_ranking(engine, &shape, scheme).unwrap();
                for eye in eyes(1.0).iter().chain([&within, &eyes(1.0)[1]]) {
                    let plain = EdgeContours::new(&shape, eye);
                    assert!(resident.contours(eye).unwrap() == plain, "{name}");
                    let rows = resident.rows().unwrap();
                    assert!(rows == rank_curves(&plain.graph).unwrap(), "{name}");
                }
            }
        }
    }
}

#[test]
fn whole_rooms_need_no_sizes() {
    let whole = ListWork::WHOLE;
    assert_eq!(
        (whole.elements(), whole.round(9), whole.draw()),
        (None, None, None)
    );
}
