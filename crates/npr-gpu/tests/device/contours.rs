//! Contours found on both engines against the plain builder.

use crate::shapes::{eyes, shape_from, shape_of};
use crate::shared;
use npr_gpu::curves::{ResidentShape, Scheme};
use npr_gpu::engine::{Engine, EngineError, PassTime, Readings, Session};
use npr_gpu::graph::{Graph, ResourceId};
use npr_gpu::processor::Processor;
use npr_mesh::half_edge::HalfEdgeMesh;
use npr_mesh::testing::{
    Random, cube, cylinder, fan, icosphere, mapped, moebius_strip, plane, random_soup,
    random_winding, torus, uv_sphere,
};
use npr_vector::mesh_lines::contour::steps::Viewer;
use npr_vector::mesh_lines::contour::{EdgeContours, Eye, usual_room};
use npr_vector::rank::rank_curves;
use std::cell::Cell;
use std::rc::Rc;

/// The processor, and the device where there is one.
pub fn engines() -> impl Iterator<Item = &'static dyn Engine> {
    let device = shared::device().map(|device| device as &dyn Engine);
    [Some(&Processor as &dyn Engine), device]
        .into_iter()
        .flatten()
}

fn plain(shape: &HalfEdgeMesh, eye: &Eye) -> EdgeContours {
    let plain = EdgeContours::new(shape, eye);
    plain.graph.sanity_check();
    plain
}

/// Compares views of a shape that is handed over once.
fn check(name: &str, shape: &HalfEdgeMesh, eyes: &[Eye]) {
    for engine in engines() {
        let mut resident = ResidentShape::new(engine, shape).unwrap();
        for eye in eyes {
            let (plain, found) = (plain(shape, eye), resident.contours(eye).unwrap());
            assert!(found == plain, "{name} from {eye:?}, {}", engine.describe());
        }
    }
}

fn check_ranked(name: &str, shape: &HalfEdgeMesh, eye: &Eye) {
    let plain = plain(shape, eye);
    let ranked = rank_curves(&plain.graph).unwrap();
    for engine in engines() {
        for scheme in [Scheme::WYLLIE, Scheme::RULING_SET] {
            let mut resident = ResidentShape::with_ranking(engine, shape, scheme).unwrap();
            let found = resident.contours(eye).unwrap();
            assert!(found == plain, "{name}: contours, {scheme:?}");
            let rows = resident.rows().unwrap();
            assert!(rows == ranked, "{name}: rows, {scheme:?}");
        }
    }
}

/// Moves every point a little, so that faces stand at all angles.
fn bumpy(mesh: &npr_mesh::Mesh, seed: u64) -> npr_mesh::Mesh {
    let mut random = Random::new(seed);
    let offsets: Vec<f32> = (0..997).map(|_| random.unit() * 0.1 + 0.9).collect();
    mapped(mesh, |p| {
        let pick = p.iter().fold(0u32, |h, v| {
            (h ^ v.to_bits()).wrapping_mul(0x9e37_79b9).rotate_left(7)
        });
        p.map(|v| v * offsets[pick as usize % offsets.len()])
    })
}

#[test]
fn contours_of_all_shapes_agree() {
    let meshes = [
        ("cube", cube()),
        ("sphere", uv_sphere(32, 20)),
        ("icosphere", icosphere(3)),
        ("bumpy icosphere", bumpy(&icosphere(4), 1)),
        ("cylinder", cylinder(24, 5)),
        ("torus", torus(48, 24, 0.7, 0.3)),
        ("bumpy torus", bumpy(&torus(48, 24, 0.7, 0.3), 2)),
        ("plane", plane(9, 7)),
        ("moebius strip", moebius_strip(30)),
        ("fan", fan(5)),
        ("soup", random_soup(300, 3)),
        ("wound at random", random_winding(&icosphere(2), 4)),
    ];
    for (name, mesh) in meshes {
        let shape = shape_from(&mesh);
        check(name, &shape, &eyes(1.0));
    }
}

#[test]
fn contours_are_ranked_where_they_are_found() {
    let eye = &eyes(1.0)[0];
    check_ranked("nothing", &HalfEdgeMesh::default(), eye);
    check_ranked("cube", &shape_from(&cube()), eye);
    let torus = bumpy(&torus(48, 24, 0.7, 0.3), 2);
    check_ranked("bumpy torus", &shape_from(&torus), eye);
}

/// More contours than there is room for at first.
#[test]
fn contours_without_room_are_found_again() {
    let soup = shape_from(&random_soup(4000, 9));
    let eye = &eyes(1.0)[0];
    assert!(plain(&soup, eye).graph.nodes.len() > usual_room(4000));
    check("soup", &soup, &eyes(1.0));
    check_ranked("soup", &soup, eye);
}

#[test]
fn contours_at_all_scales_agree() {
    let mesh = bumpy(&icosphere(2), 5);
    for scale in [1e-15, 1e-6, 1e-3, 1e3, 1e6, 1e15] {
        let shape = shape_from(&mapped(&mesh, |p| p.map(|v| v * scale)));
        check("scaled", &shape, &eyes(scale));
    }
}

/// A flat grid, seen along its plane: heights are 0 but for rounding, which both engines must do alike.
#[test]
fn faces_seen_edge_on_are_judged_alike() {
    let mesh = plane(60, 60);
    for turn in 0..10 {
        let slope = 0.1 * turn as f32;
        let tilted = mapped(&mesh, |[x, y, z]| {
            [x, y + slope * x, z + slope * y + 0.7 * x]
        });
        let shape = shape_from(&tilted);
        let [a, b, c] = shape.faces[7].map(|v| shape.positions[v as usize]);
        // A point in the plane of a face, as near as floats get.
        let in_plane: [f64; 3] =
            std::array::from_fn(|i| f64::from(3.0 * a[i] - 4.0 * b[i] + 2.0 * c[i]));
        let eye = Eye::new([in_plane[0], in_plane[1], in_plane[2], 1.0], 8.0);
        check("plane seen edge-on", &shape, &[eye]);
    }
}

#[test]
fn stand_ins_decide_for_faces_without_area() {
    let mesh = uv_sphere(12, 8);
    let mut shape = shape_from(&mesh);
    shape.degenerate_faces = vec![[0, 5], [3, npr_core::geometry::NONE], [40, 2]];
    check("slivers", &shape, &eyes(1.0));
}

#[test]
fn no_faces_have_no_contours() {
    check("nothing", &HalfEdgeMesh::default(), &eyes(1.0));
}

#[test]
fn twenty_runs_give_one_graph() {
    let shape = shape_from(&bumpy(&icosphere(5), 7));
    let eye = &eyes(1.0)[0];
    let digest = plain(&shape, eye).graph.digest();
    for engine in engines() {
        let mut resident = ResidentShape::new(engine, &shape).unwrap();
        for _ in 0..20 {
            let found = resident.contours(eye).unwrap();
            assert_eq!(found.graph.digest(), digest, "{}", engine.describe());
        }
    }
}

/// The shape crosses to the engine when it is made resident, and not again for a view that has room.
#[test]
fn a_view_hands_over_its_eye_only() {
    let shape = shape_from(&uv_sphere(32, 20));
    let counting = Counting::default();
    let mut resident = ResidentShape::new(&counting, &shape).unwrap();
    counting.words.set(0);
    for (view, eye) in (1..).zip(&eyes(1.0)) {
        resident.contours(eye).unwrap();
        assert_eq!(counting.words.get(), view * size_of::<Viewer>() / 4);
    }
}

/// Smooth shapes of any size have room for their contours from the first view on; soups make room once.
#[test]
fn smooth_shapes_are_prepared_once() {
    for (name, mesh, wanted) in [
        ("cube", cube(), 1),
        ("icosphere", icosphere(6), 1),
        ("torus", torus(192, 96, 0.7, 0.3), 1),
        ("cylinder", cylinder(300, 300), 1),
        ("soup", random_soup(4000, 9), 2),
    ] {
        let shape = shape_from(&mesh);
        let counting = Counting::default();
        let mut resident = ResidentShape::new(&counting, &shape).unwrap();
        for eye in &eyes(1.0) {
            resident.contours(eye).unwrap();
        }
        assert_eq!(counting.prepared.get(), wanted, "{name}");
    }
}

/// The processor, counting the words that are written and how often memory is made ready.
#[derive(Default)]
struct Counting {
    words: Rc<Cell<usize>>,
    prepared: Cell<usize>,
}

struct CountingSession {
    words: Rc<Cell<usize>>,
    session: Box<dyn Session>,
}

impl Engine for Counting {
    fn describe(&self) -> String {
        Processor.describe()
    }

    fn prepare(&self, graph: Graph) -> Result<Box<dyn Session>, EngineError> {
        self.prepared.set(self.prepared.get() + 1);
        Ok(Box::new(CountingSession {
            words: self.words.clone(),
            session: Processor.prepare(graph)?,
        }))
    }
}

impl Session for CountingSession {
    fn write_at(&mut self, id: ResourceId, first: usize, words: &[u32]) -> Result<(), EngineError> {
        self.words.set(self.words.get() + words.len());
        self.session.write_at(id, first, words)
    }

    fn grow(&mut self, id: ResourceId, count: usize) -> Result<(), EngineError> {
        self.session.grow(id, count)
    }

    fn submit(&mut self, ids: &[ResourceId]) -> Result<(), EngineError> {
        self.session.submit(ids)
    }

    fn collect(&mut self) -> Result<(Vec<PassTime>, Readings), EngineError> {
        self.session.collect()
    }

    fn in_flight(&self) -> usize {
        self.session.in_flight()
    }

    fn read_all(&mut self, ids: &[ResourceId]) -> Result<Readings, EngineError> {
        self.session.read_all(ids)
    }
}

#[test]
fn a_pose_has_contours_of_its_own() {
    for (name, mesh) in [("icosphere", icosphere(4)), ("soup", random_soup(600, 5))] {
        let [rest, moved, far] = [None, Some(3), Some(4)].map(|seed| {
            let posed = seed.map_or_else(|| mesh.clone(), |seed| bumpy(&mesh, seed));
            let mut shape = shape_from(&mesh);
            shape.positions = shape_from(&posed).positions;
            shape
        });
        for engine in engines() {
            let mut resident = ResidentShape::new(engine, &rest).unwrap();
            for shape in [&moved, &far, &rest, &moved] {
                resident.set_pose(shape).unwrap();
                for eye in &eyes(1.0) {
                    let found = resident.contours(eye).unwrap();
                    assert!(found == plain(shape, eye), "{name}, {}", engine.describe());
                }
            }
        }
    }
}

/// Of a pose that folds nothing to a line, positions cross to the engine and nothing else; of two meshes those of the
/// one that moves.
#[test]
fn a_pose_hands_over_the_positions_that_moved_alone() {
    let ball = shape_from(&uv_sphere(32, 20));
    let count = ball.positions.len();
    let beside = ball.positions.iter().map(|[x, y, z]| [x + 5.0, *y, *z]);
    let positions: Vec<[f32; 3]> = ball.positions.iter().copied().chain(beside).collect();
    let corners = ball.faces.iter().map(|face| face.map(|v| v + count as u32));
    let triangles: Vec<[u32; 3]> = ball.faces.iter().copied().chain(corners).collect();
    let shape = shape_of(&positions, &triangles);

    for (moving, want) in [
        (0..0, 0),
        (0..count, count),
        (count..2 * count, count),
        (0..2 * count, 2 * count),
    ] {
        let mut moved = shape.clone();
        for position in &mut moved.positions[moving] {
            position[1] += 0.25;
        }
        let counting = Counting::default();
        let mut resident = ResidentShape::new(&counting, &shape).unwrap();
        counting.words.set(0);
        resident.set_pose(&moved).unwrap();
        assert_eq!(counting.words.get(), 3 * want);
        let eye = &eyes(1.0)[0];
        assert!(resident.contours(eye).unwrap() == plain(&moved, eye));
    }
}
