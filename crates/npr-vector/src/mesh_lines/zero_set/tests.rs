use super::*;
use crate::mesh_lines::contour::{self, Eye};
use crate::mesh_lines::graph::CurveNode;
use npr_core::edge_flags::EdgeFlags;
use npr_core::geometry::NONE;
use npr_core::line_kind::KindSet;
use npr_mesh::Mesh;
use npr_mesh::testing::{
    Random, cube, cylinder, fan, icosphere, mapped, moebius_strip, plane, random_soup,
    random_winding, shape_of, torus, uv_sphere, with_doubles,
};
use proptest::prelude::*;
use std::collections::BTreeSet;

/// Cosine of the crease angle of most tests, 40 degrees.
const CREASE: f32 = 0.766;

fn normal_of(shape: &HalfEdgeMesh, face: u32) -> glam::DVec3 {
    let [a, b, c] = shape.faces[face as usize].map(|v| shape.point(v));
    (b - a).cross(c - a).normalize_or_zero()
}

fn front_of(shape: &HalfEdgeMesh, eye: [f64; 4]) -> Vec<u8> {
    contour::facing(shape, &Eye::new(eye, 8.0))
}

/// One of several kinds of mesh, shaken by noise.
fn any_mesh(kind: u32, size: u32, noise: f32, seed: u64) -> Mesh {
    let mesh = match kind {
        0 => icosphere(size % 3),
        1 => torus(3 + size, 4 + size, 1.0, 0.4),
        2 => plane(1 + size, 2 + size),
        3 => cylinder(3 + size, 1 + size % 3),
        4 => random_soup(10 * size as usize, seed),
        5 => random_winding(&icosphere(1), seed),
        6 => with_doubles(&torus(4, 5, 1.0, 0.4), seed),
        7 => moebius_strip(5 + size),
        8 => fan(2 + size),
        _ => cube(),
    };
    shaken(&mesh, noise, seed)
}

pub(super) fn shaken(mesh: &Mesh, noise: f32, seed: u64) -> Mesh {
    let random = std::cell::RefCell::new(Random::new(seed));
    mapped(mesh, |p| {
        p.map(|v| v + noise * (random.borrow_mut().unit() - 0.5))
    })
}

/// What a random test runs on, small enough to read when it fails.
#[derive(Debug, Clone)]
struct Case {
    kind: u32,
    size: u32,
    noise: f32,
    seed: u64,
    eye: [f64; 4],
    crease_cos: f32,
}

impl Case {
    fn shape(&self) -> HalfEdgeMesh {
        shape_of(&any_mesh(self.kind, self.size, self.noise, self.seed))
    }
}

fn any_case() -> impl Strategy<Value = Case> {
    let direction = proptest::array::uniform3(-3.0f64..3.0);
    let noise = prop_oneof![Just(0.0f32), 0.0f32..0.6];
    let cos = prop_oneof![Just(-1.0f32), -1.0f32..1.0];
    (
        0u32..10,
        1u32..7,
        noise,
        any::<u64>(),
        direction,
        any::<bool>(),
        cos,
    )
        .prop_map(
            |(kind, size, noise, seed, [x, y, z], parallel, crease_cos)| {
                let w = if parallel { 0.0 } else { 1.0 };
                Case {
                    kind,
                    size,
                    noise,
                    seed,
                    eye: [x, y, z, w],
                    crease_cos,
                }
            },
        )
}

/// A random set of flat faces, or none, or all.
fn any_flat(front: &[u8], seed: u64) -> FlatFaces {
    let mut random = Random::new(seed);
    let share = [0, 1, 2, 4][random.below(4)];
    let picks: Vec<bool> = front.iter().map(|_| random.below(4) < share).collect();
    FlatFaces::new(front, |face| picks[face as usize])
}

/// Checks that lines are closed, or open between borders, and turn the front to their left.
fn check(shape: &HalfEdgeMesh, signs: &Signs<'_>) {
    let trace::Traced { graph, along } = trace::trace(signs);
    graph.sanity_check();
    let border_at = |vertex: u32| {
        (0..shape.twins.len() as u32).any(|h| {
            shape.twins[h as usize] == NONE && shape.ends_of_half_edge(h).contains(&vertex)
        })
    };
    for (index, (node, along)) in graph.nodes.iter().zip(along).enumerate() {
        assert_eq!(runs_along_edge(&graph, index as u32), along, "{node:?}");
        assert!(
            node.next != NONE || node.prev != NONE,
            "a piece has two nodes"
        );
        assert_eq!(node.flags & KindSet::CONTOUR != 0, node.next != NONE);
        if node.next == NONE || node.prev == NONE {
            let open = shape
                .sides(node.edge)
                .iter()
                .any(|h| shape.twins[*h as usize] == NONE);
            let [low, high] = shape.ends(node.edge);
            let at_open_vertex =
                (node.t == 0.0 && border_at(low)) || (node.t == 1.0 && border_at(high));
            assert!(
                open || at_open_vertex,
                "a line ends inside the surface: {node:?}"
            );
        }
        if node.next != NONE {
            check_piece(
                shape,
                [node, &graph.nodes[node.next as usize]],
                along,
                signs,
            );
        }
    }
}

/// Checks by plane geometry that the front of the piece's face lies on its left.
fn check_piece(
    shape: &HalfEdgeMesh,
    [node, next]: [&CurveNode; 2],
    along: bool,
    signs: &Signs<'_>,
) {
    let point = |node: &CurveNode| {
        let [a, b] = shape.ends(node.edge).map(|v| shape.point(v));
        a + (b - a) * f64::from(node.t)
    };
    let (from, to) = (point(node), point(next));
    let normal = normal_of(shape, node.face);
    let scale = (from.length() + to.length()) * 1e-5;
    for i in 0..3 {
        let vertex = shape.faces[node.face as usize][i as usize];
        // Along an edge, the whole face lies on one side, whatever its far corner says.
        let front = along || signs.front(3 * node.face + i);
        let p = shape.point(vertex);
        let left = normal.cross((to - from).normalize_or_zero()).dot(p - from);
        let wrong = if front { left < -scale } else { left > scale };
        assert!(!wrong, "front on the right of {node:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1500))]

    #[test]
    fn lines_are_closed_or_end_at_borders(case in any_case()) {
        let (shape, eye, crease, seed) = (case.shape(), case.eye, case.crease_cos, case.seed);
        let normals = CornerNormals::new(&shape, crease);
        let flat = any_flat(&front_of(&shape, eye), seed);
        check(&shape, &Signs::new(&shape, &normals, &flat, eye));
    }

    #[test]
    fn every_change_of_sign_is_on_a_line(case in any_case()) {
        let (shape, eye, crease) = (case.shape(), case.eye, case.crease_cos);
        let normals = CornerNormals::new(&shape, crease);
        let graph = zero_set(&shape, &normals, eye, &FlatFaces::NONE);
        let mut expected = 0;
        for face in 0..shape.faces.len() as u32 {
            let front = [0, 1, 2].map(|i| {
                let n = glam::DVec3::from_array(normals.normal(3 * face + i).map(f64::from));
                let p = shape.point(shape.faces[face as usize][i as usize]);
                n.dot(normals::towards(eye, p)) >= 0.0
            });
            expected += usize::from(front.contains(&true) && front.contains(&false));
        }
        let none = FlatFaces::NONE;
        let signs = Signs::new(&shape, &normals, &none, eye);
        let along = trace::trace(&signs).along;
        let through = graph.nodes.iter().zip(&along).filter(|(n, along)| n.next != NONE && !**along);
        prop_assert_eq!(through.count(), expected);
    }

    #[test]
    fn with_flat_faces_only_lines_are_the_contours_of_the_polygon(case in any_case()) {
        let (shape, eye, crease) = (case.shape(), case.eye, case.crease_cos);
        let front = front_of(&shape, eye);
        let graph = zero_set(&shape, &CornerNormals::new(&shape, crease), eye, &FlatFaces::new(&front, |_| true));
        let pieces: BTreeSet<[u32; 2]> = graph.nodes.iter()
            .filter(|node| node.next != NONE).map(|node| [node.edge, node.face]).collect();
        let mut expected = BTreeSet::new();
        for half_edge in 0..shape.twins.len() as u32 {
            let twin = shape.twins[half_edge as usize];
            if twin != NONE && front[half_edge as usize / 3] == 1 && front[twin as usize / 3] == 0 {
                expected.insert([shape.edge_of[half_edge as usize], half_edge / 3]);
            }
        }
        prop_assert_eq!(pieces, expected);
    }

    #[test]
    fn fans_are_what_smooth_edges_connect(case in any_case()) {
        let (shape, crease) = (case.shape(), case.crease_cos);
        let normals = CornerNormals::new(&shape, crease);
        // Grow sets of corners by crossing smooth edges until nothing changes.
        let mut set: Vec<u32> = (0..shape.twins.len() as u32).collect();
        let mut changed = true;
        while changed {
            changed = false;
            for h in 0..set.len() as u32 {
                let twin = shape.twins[h as usize];
                if twin == NONE || cos_across(&shape, h, twin) < crease { continue; }
                let other = HalfEdgeMesh::following(twin) as usize;
                let low = set[h as usize].min(set[other]);
                changed |= set[h as usize] != low || set[other] != low;
                (set[h as usize], set[other]) = (low, low);
            }
        }
        for a in 0..set.len() {
            for b in 0..a {
                prop_assert_eq!(set[a] == set[b], normals.fan(a as u32) == normals.fan(b as u32));
            }
        }
    }

    #[test]
    fn doubled_size_gives_the_same_graph(case in any_case()) {
        let (shape, eye, crease) = (case.shape(), case.eye, case.crease_cos);
        let [x, y, z, w] = eye;
        let mut larger = shape.clone();
        larger.positions.iter_mut().for_each(|p| *p = p.map(|v| 2.0 * v));
        let graphs = [(&shape, eye), (&larger, [2.0 * x, 2.0 * y, 2.0 * z, w])].map(|(shape, eye)| {
            zero_set(shape, &CornerNormals::new(shape, crease), eye, &FlatFaces::NONE)
        });
        prop_assert_eq!(&graphs[0], &graphs[1]);
    }
}

fn cos_across(shape: &HalfEdgeMesh, half_edge: u32, twin: u32) -> f32 {
    let edge = shape.edge_of[half_edge as usize] as usize;
    if shape.edge_traits[edge].contains(EdgeFlags::NON_MANIFOLD) {
        let [a, b] = [half_edge, twin].map(|h| normal_of(shape, h / 3).as_vec3());
        return a.x * b.x + a.y * b.y + a.z * b.z;
    }
    shape.dihedral_cos[edge]
}

/// Lines of a smooth shape from an eye: world positions of all nodes.
fn points(shape: &HalfEdgeMesh, graph: &CurveGraph) -> Vec<glam::DVec3> {
    (0..graph.nodes.len() as u32)
        .map(|node| graph.position(shape, node).into())
        .collect()
}

fn smooth(shape: &HalfEdgeMesh, eye: [f64; 4]) -> CurveGraph {
    zero_set(
        shape,
        &CornerNormals::new(shape, -1.0),
        eye,
        &FlatFaces::NONE,
    )
}

/// Number of lines, by walking.
fn line_count(graph: &CurveGraph) -> usize {
    let mut seen = vec![false; graph.nodes.len()];
    let mut count = 0;
    for start in 0..graph.nodes.len() {
        count += usize::from(!seen[start]);
        let mut at = start as u32;
        while at != NONE && !seen[at as usize] {
            seen[at as usize] = true;
            at = graph.nodes[at as usize].next;
        }
    }
    count
}

#[test]
fn on_a_sphere_the_line_nears_the_circle_with_the_square_of_the_edge_length() {
    let eye = [0.9, 1.7, 2.3, 1.0];
    let direction = glam::DVec3::new(eye[0], eye[1], eye[2]);
    // Points of contour satisfy p . eye = 1.
    let error = |level: u32| {
        let shape = shape_of(&uv_sphere(16 << level, 8 << level));
        let graph = smooth(&shape, eye);
        assert_eq!(line_count(&graph), 1);
        let off = |p: &glam::DVec3| (p.dot(direction) - 1.0).abs() / direction.length();
        points(&shape, &graph).iter().map(off).fold(0.0, f64::max)
    };
    let errors = [0, 1, 2].map(error);
    assert!(errors[0] < 0.02, "{errors:?}");
    assert!(
        errors[1] < errors[0] / 3.0 && errors[2] < errors[1] / 3.0,
        "{errors:?}"
    );
}

#[test]
fn on_a_torus_lines_near_the_closed_form() {
    // With n the unit normal at (ring angle, tube angle), n . (eye - p) = n . eye - ring radius * cos(tube) - tube
    // radius.
    let (ring, tube, eye) = (1.0, 0.4, [2.0, 0.6, 1.5, 1.0]);
    let value = |p: glam::DVec3| {
        let out = glam::DVec3::new(p.x, p.y, 0.0).normalize();
        let normal = (p - ring * out).normalize();
        normal.dot(glam::DVec3::new(eye[0], eye[1], eye[2]) - p)
    };
    let error = |steps: u32| {
        let shape = shape_of(&torus(3 * steps, steps, ring as f32, tube));
        let graph = smooth(&shape, eye);
        assert_eq!(line_count(&graph), 2);
        points(&shape, &graph)
            .into_iter()
            .map(|p| value(p).abs())
            .fold(0.0, f64::max)
    };
    let errors = [16, 32, 64].map(error);
    assert!(
        errors[1] < errors[0] / 3.0 && errors[2] < errors[1] / 3.0,
        "{errors:?}"
    );
    assert!(errors[2] < 0.01, "{errors:?}");
}

#[test]
fn the_far_rim_of_a_torus_hole_is_hidden_by_its_own_surface_between_cusps() {
    let shape = shape_of(&torus(96, 48, 1.0, 0.5));
    // Low over the plane of the ring, the line around the hole has four cusps.
    let graph = smooth(&shape, [6.0, 0.0, 1.2, 1.0]);
    let count = |flag: u32| graph.nodes.iter().filter(|n| n.flags & flag != 0).count();
    assert_eq!(count(EdgeFlags::CUSP.0), 4);
    assert!(count(EdgeFlags::CONCAVE.0) > 10);
    // From far above there is none.
    let graph = smooth(&shape, [0.1, 0.0, 6.0, 1.0]);
    assert!(graph.nodes.iter().all(|n| n.flags == KindSet::CONTOUR));
}

#[test]
fn a_cube_has_the_outline_of_its_sharp_edges() {
    let shape = shape_of(&cube());
    let normals = CornerNormals::new(&shape, CREASE);
    for (eye, edges) in [
        ([3.0, 4.0, 5.0, 1.0], 6),
        ([3.0, 4.0, 5.0, 0.0], 6),
        ([0.0, 0.0, 4.0, 1.0], 4),
    ] {
        let graph = zero_set(&shape, &normals, eye, &FlatFaces::NONE);
        assert_eq!(graph.nodes.len(), edges);
        assert_eq!(line_count(&graph), 1);
        assert!(
            graph
                .nodes
                .iter()
                .all(|n| n.flags == KindSet::CONTOUR && (n.t == 0.0 || n.t == 1.0))
        );
    }
}

#[test]
fn lines_of_a_cylinder_turn_into_its_rims_without_a_gap() {
    let shape = shape_of(&cylinder(32, 4));
    let graph = zero_set(
        &shape,
        &CornerNormals::new(&shape, CREASE),
        [5.0, 1.0, 3.0, 1.0],
        &FlatFaces::NONE,
    );
    // One closed line: up the flank, along the far part of the upper rim, down, along the near part of the lower.
    assert_eq!(line_count(&graph), 1);
    assert!(graph.nodes.iter().all(|node| node.next != NONE));
    let points = points(&shape, &graph);
    for (node, point) in graph.nodes.iter().zip(&points) {
        assert!(
            point.distance(points[node.next as usize]) < 0.6,
            "a jump after {node:?}"
        );
    }
}

#[test]
fn a_noisy_sign_of_one_piece_makes_no_cusps() {
    let shape = shape_of(&shaken(&icosphere(3), 0.004, 7));
    let graph = smooth(&shape, [3.0, 0.4, 0.8, 1.0]);
    let cusps = graph
        .nodes
        .iter()
        .filter(|n| EdgeFlags::CUSP.is_in(n.flags))
        .count();
    assert!(cusps <= 2, "{cusps}");
}

#[test]
fn odd_input_gives_no_panic() {
    let empty = HalfEdgeMesh {
        edge_starts: vec![0],
        ..HalfEdgeMesh::default()
    };
    assert!(smooth(&empty, [0.0, 0.0, 1.0, 1.0]).nodes.is_empty());
    for scale in [1e-38f32, 1e-20, 1e20, 3e38] {
        let shape = shape_of(&mapped(&icosphere(2), |p| p.map(|v| v * scale)));
        let far = 4.0 * f64::from(scale);
        let graph = smooth(&shape, [far, 0.5 * far, 0.2 * far, 1.0]);
        assert!(graph.nodes.len() > 10, "at scale {scale}");
        assert_eq!(line_count(&graph), 1);
    }
    let shape = shape_of(&icosphere(2));
    for eye in [
        [f64::NAN; 4],
        [f64::INFINITY, 0.0, 0.0, 1.0],
        [0.0; 4],
        [1e300, 1e300, 0.0, 1.0],
        [0.0, 0.0, 0.0, 1.0],
    ] {
        for crease in [f32::NAN, -2.0, 2.0, CREASE] {
            let graph = zero_set(
                &shape,
                &CornerNormals::new(&shape, crease),
                eye,
                &FlatFaces::NONE,
            );
            graph.sanity_check();
        }
    }
}

#[test]
fn the_number_of_threads_does_not_show() {
    let shape = shape_of(&torus(60, 40, 1.0, 0.4));
    let digest = |threads| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| {
            let normals = CornerNormals::new(&shape, 0.98);
            (
                zero_set(&shape, &normals, [2.0, 1.0, 0.7, 1.0], &FlatFaces::NONE).digest(),
                normals,
            )
        })
    };
    let once = digest(1);
    assert!([2, 8, 1].map(digest).iter().all(|other| *other == once));
}
