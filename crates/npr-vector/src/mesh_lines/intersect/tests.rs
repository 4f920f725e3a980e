use super::*;
use npr_core::edge_flags::EdgeFlags;
use npr_core::geometry::NONE;
use npr_core::line_kind::KindSet;
use npr_mesh::half_edge::Surface;
use npr_mesh::mesh::Mesh;
use npr_mesh::testing::{Random, cube, icosphere, plane, uv_sphere};
use proptest::prelude::*;
use std::collections::BTreeMap;

/// A shape of faces as they are: no welding, nothing removed.
fn shape_of(positions: &[[f32; 3]], faces: &[[u32; 3]]) -> HalfEdgeMesh {
    let mut sides: BTreeMap<[u32; 2], Vec<u32>> = BTreeMap::new();
    for (face, corners) in faces.iter().enumerate() {
        for i in 0..3 {
            let [a, b] = [corners[i], corners[(i + 1) % 3]];
            let of_edge = sides.entry([a.min(b), a.max(b)]).or_default();
            of_edge.push(3 * face as u32 + i as u32);
        }
    }
    let mut shape = HalfEdgeMesh {
        positions: positions.to_vec(),
        faces: faces.to_vec(),
        face_surfaces: vec![0; faces.len()],
        twins: vec![NONE; 3 * faces.len()],
        edge_of: vec![0; 3 * faces.len()],
        edge_starts: vec![0],
        edge_ends: sides.keys().copied().collect(),
        dihedral_cos: vec![1.0; sides.len()],
        edge_traits: vec![EdgeFlags::NONE; sides.len()],
        surfaces: vec![Surface::default()],
        ..HalfEdgeMesh::default()
    };
    for (edge, of_edge) in sides.into_values().enumerate() {
        for side in &of_edge {
            shape.edge_of[*side as usize] = edge as u32;
        }
        shape.edge_sides.extend(of_edge);
        shape.edge_starts.push(shape.edge_sides.len() as u32);
    }
    shape
}

/// Meshes put into one shape, each moved by a function.
struct Scene(Vec<[f32; 3]>, Vec<[u32; 3]>);

impl Scene {
    fn new() -> Self {
        Self(Vec::new(), Vec::new())
    }

    fn with(mut self, mesh: &Mesh, place: impl Fn([f32; 3]) -> [f32; 3]) -> Self {
        let base = self.0.len() as u32;
        self.0.extend(mesh.positions().iter().map(|p| place(*p)));
        self.1
            .extend(mesh.triangles().iter().map(|t| t.map(|v| v + base)));
        self
    }

    fn shape(&self) -> HalfEdgeMesh {
        shape_of(&self.0, &self.1)
    }
}

fn unlimited(shape: &HalfEdgeMesh) -> Crossings {
    let mut budget = Budget::new(u64::MAX);
    crossings(shape, &FaceTree::new(shape), &mut budget).expect("no limit is set")
}

fn found(shape: &HalfEdgeMesh) -> Crossings {
    let found = unlimited(shape);
    found.graph.sanity_check();
    check_pieces(shape, &found.graph);
    found
}

/// Both ends of every piece lie on the face named, within rounding.
fn check_pieces(shape: &HalfEdgeMesh, graph: &CurveGraph) {
    for (index, node) in graph.nodes.iter().enumerate() {
        assert_eq!(node.flags, KindSet::INTERSECTION);
        if node.next == NONE {
            continue;
        }
        let corners = shape.faces[node.face as usize];
        let points = corners.map(|v| shape.positions[v as usize].map(f64::from));
        let size = points
            .iter()
            .flatten()
            .fold(0.0, |s: f64, v| s.max(v.abs()));
        for end in [index as u32, node.next] {
            let at = graph.position(shape, end);
            for axis in 0..3 {
                let values = points.map(|p| p[axis]);
                let low = values.iter().copied().fold(f64::INFINITY, f64::min);
                let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                let slack = 1e-5 * size;
                assert!(
                    (low - slack..=high + slack).contains(&at[axis]),
                    "node {end} off face {}",
                    node.face
                );
            }
        }
    }
}

/// Lines as positions, and whether they close.
fn lines(shape: &HalfEdgeMesh, graph: &CurveGraph) -> Vec<(Vec<[f64; 3]>, bool)> {
    let mut seen = vec![false; graph.nodes.len()];
    let mut lines = Vec::new();
    for start in 0..graph.nodes.len() {
        if seen[start] {
            continue;
        }
        let (mut line, mut node) = (Vec::new(), start as u32);
        while node != NONE && !seen[node as usize] {
            seen[node as usize] = true;
            line.push(graph.position(shape, node));
            node = graph.nodes[node as usize].next;
        }
        lines.push((line, node != NONE));
    }
    lines
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt()
}

fn length((line, closed): &(Vec<[f64; 3]>, bool)) -> f64 {
    let open: f64 = line.windows(2).map(|p| distance(p[0], p[1])).sum();
    open + if *closed {
        distance(line[0], line[line.len() - 1])
    } else {
        0.0
    }
}

type Point = [i128; 3];

fn volume(a: Point, b: Point, c: Point, d: Point) -> i128 {
    let [u, v, w]: [Point; 3] = [a, b, c].map(|p| std::array::from_fn(|i| p[i] - d[i]));
    u[0] * (v[1] * w[2] - v[2] * w[1])
        + u[1] * (v[2] * w[0] - v[0] * w[2])
        + u[2] * (v[0] * w[1] - v[1] * w[0])
}

/// Every edge against every face in whole numbers; `None` if any four points share a plane.
fn oracle(shape: &HalfEdgeMesh) -> Option<Vec<(u32, u32, f64)>> {
    let point = |v: u32| shape.positions[v as usize].map(|x| x as i128);
    let mut found = Vec::new();
    for edge in 0..shape.edge_count() as u32 {
        let ends = shape.ends(edge);
        for (face, corners) in shape.faces.iter().enumerate() {
            if corners.iter().any(|v| ends.contains(v)) {
                continue;
            }
            let ([a, b], [c, d, e]) = (ends.map(point), corners.map(point));
            let sides = [volume(c, d, e, a), volume(c, d, e, b)];
            let turns = [volume(a, b, c, d), volume(a, b, d, e), volume(a, b, e, c)];
            if sides.iter().chain(&turns).any(|v| *v == 0) {
                return None;
            }
            let around = turns.iter().all(|v| *v > 0) || turns.iter().all(|v| *v < 0);
            if around && (sides[0] > 0) != (sides[1] > 0) {
                let t = sides[0] as f64 / (sides[0] - sides[1]) as f64;
                found.push((edge, face as u32, t));
            }
        }
    }
    Some(found)
}

/// Faces between few vertices, so that many share one or two.
fn soup(vertex_count: u32, face_count: usize, reach: i32) -> impl Strategy<Value = HalfEdgeMesh> {
    let positions =
        prop::collection::vec(prop::array::uniform3(-reach..=reach), vertex_count as usize);
    let face = prop::array::uniform3(0..vertex_count)
        .prop_filter("different corners", |[a, b, c]| a != b && b != c && c != a);
    (positions, prop::collection::vec(face, 1..face_count)).prop_map(|(positions, mut faces)| {
        let key = |face: &[u32; 3]| {
            let mut key = *face;
            key.sort_unstable();
            key
        };
        faces.sort_by_key(key);
        faces.dedup_by_key(|face| key(face));
        let positions: Vec<[f32; 3]> = positions.iter().map(|p| p.map(|x| x as f32)).collect();
        shape_of(&positions, &faces)
    })
}

/// All segments, those of mere contact too, of all pairs of faces.
fn all_segments(shape: &HalfEdgeMesh) -> Vec<Segment> {
    let count = shape.faces.len() as u32;
    let pairs = (0..count).flat_map(|g| (0..g).map(move |f| [f, g]));
    pairs.filter_map(|pair| cut::cut(shape, pair)).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1500))]

    #[test]
    fn piercings_are_those_of_whole_number_arithmetic(shape in soup(14, 16, 2000)) {
        let found = found(&shape);
        if let Some(expected) = oracle(&shape) {
            let mut pairs: Vec<(u32, u32)> = found.piercings.iter().map(|p| (p.edge, p.face)).collect();
            pairs.sort_unstable();
            let known: Vec<(u32, u32)> = expected.iter().map(|(edge, face, _)| (*edge, *face)).collect();
            prop_assert_eq!(&pairs, &known);
            for p in &found.piercings {
                let place = known.binary_search(&(p.edge, p.face)).unwrap();
                prop_assert!((f64::from(p.t) - expected[place].2).abs() < 1e-7);
            }
        }
    }

    /// On a grid of few points nearly everything touches: on both faces of an edge a line must still go on.
    #[test]
    fn segments_meet_at_every_edge_however_points_coincide(shape in soup(12, 14, 1)) {
        let mut ends: BTreeMap<[u32; 2], usize> = BTreeMap::new();
        for segment in all_segments(&shape) {
            for end in segment.ends {
                *ends.entry(end.key).or_default() += 1;
            }
        }
        for ([edge, face], count) in ends {
            if face == NONE {
                continue;
            }
            // Faces of the edge that share another corner with the pierced one have an edge or a corner in common
            // with it.
            let corners = shape.faces[face as usize];
            let beside = shape.sides(edge).iter().filter(|side| {
                let apex = shape.opposite(**side);
                let shared = shape.ends(edge).iter().chain([&apex]).filter(|v| corners.contains(v)).count();
                shared < 2
            });
            prop_assert_eq!(count, beside.count(), "edge {} through face {}", edge, face);
        }
    }

    #[test]
    fn the_search_misses_no_pair(shape in soup(16, 40, 3)) {
        let flat = |pair: [u32; 2]| {
            let corners = pair.map(|f| shape.faces[f as usize].map(|v| shape.positions[v as usize]));
            (0..3).any(|i| corners.iter().flatten().all(|p| p[i] == corners[0][0][i]))
        };
        let mut all: Vec<[u32; 2]> = all_segments(&shape).iter().map(|s| s.faces).collect();
        all.retain(|pair| !flat(*pair));
        all.sort_unstable();
        let found = pairs::find(&shape, &FaceTree::new(&shape), usize::MAX, &mut |_| Ok(())).expect("no limit is set");
        prop_assert!(!found.overflow);
        for pair in all {
            prop_assert_eq!(found.pairs.iter().filter(|p| **p == pair).count(), 1);
        }
    }

    #[test]
    fn renumbered_and_mirrored_shapes_are_cut_in_the_same_places(shape in soup(14, 16, 2000), seed: u64) {
        prop_assume!(oracle(&shape).is_some());
        let mut random = Random::new(seed);
        let mut to: Vec<u32> = (0..shape.positions.len() as u32).collect();
        random.shuffle(&mut to);
        let mut positions = shape.positions.clone();
        for (from, at) in to.iter().enumerate() {
            let [x, y, z] = shape.positions[from];
            positions[*at as usize] = [-x, y, z];
        }
        let mut faces: Vec<[u32; 3]> = shape.faces.iter().map(|f| f.map(|v| to[v as usize])).collect();
        random.shuffle(&mut faces);
        let other = shape_of(&positions, &faces);
        let places = |shape: &HalfEdgeMesh, sign: f64| -> Vec<[f64; 3]> {
            let piercings = found(shape).piercings;
            let place = |p: &Piercing| {
                let [a, b] = shape.ends(p.edge).map(|v| shape.positions[v as usize].map(f64::from));
                let at = |i: usize| a[i] + (b[i] - a[i]) * f64::from(p.t);
                [sign * at(0), at(1), at(2)]
            };
            piercings.iter().map(place).collect()
        };
        let (these, those) = (places(&shape, 1.0), places(&other, -1.0));
        prop_assert_eq!(these.len(), those.len());
        for place in these {
            prop_assert!(those.iter().any(|other| distance(place, *other) < 1e-2), "{:?}", place);
        }
    }
}

#[test]
fn spheres_cut_each_other_in_a_circle() {
    for (mesh, shift) in [(icosphere(4), 1.1_f32), (uv_sphere(64, 32), 1.0)] {
        let scene = Scene::new()
            .with(&mesh, |p| p)
            .with(&mesh, |[x, y, z]| [x + shift, y, z]);
        let shape = scene.shape();
        let found = found(&shape);
        let lines = lines(&shape, &found.graph);
        assert_eq!(lines.len(), 1);
        assert!(lines[0].1, "closed");
        let half = f64::from(shift) / 2.0;
        let radius = (1.0 - half * half).sqrt();
        for [x, y, z] in &lines[0].0 {
            assert!((x - half).abs() < 6e-3, "{x}");
            assert!(((y * y + z * z).sqrt() - radius).abs() < 6e-3);
        }
        assert!((length(&lines[0]) / (std::f64::consts::TAU * radius) - 1.0).abs() < 5e-3);
        assert_eq!(found.piercings.len(), found.graph.nodes.len());
    }
}

#[test]
fn a_plane_through_the_equator_cuts_along_its_edges() {
    // The ring of vertices lies in the plane exactly: the line stays though every crossing is a tie.
    let ball = uv_sphere(16, 8);
    let scene = Scene::new()
        .with(&ball, |[x, y, z]| {
            [x, y, if z.abs() < 1e-3 { 0.0 } else { z }]
        })
        .with(&plane(3, 3), |[x, y, _]| {
            [4.0 * x - 2.1, 4.0 * y - 1.9, 0.0]
        });
    let shape = scene.shape();
    let lines = lines(&shape, &found(&shape).graph);
    assert_eq!(lines.len(), 1);
    assert!(lines[0].1);
    assert!(lines[0].0.iter().all(|p| p[2].abs() < 1e-6));
    let expected = 32.0 * (std::f64::consts::PI / 16.0).sin();
    assert!(
        (length(&lines[0]) - expected).abs() < 1e-4,
        "{}",
        length(&lines[0])
    );
}

#[test]
fn a_box_through_a_plane_leaves_a_square() {
    for tilt in [0.0, 0.1] {
        let scene = Scene::new()
            .with(&cube(), |[x, y, z]| [x, y, z + 0.3 + tilt * x])
            .with(&plane(5, 5), |[x, y, _]| {
                [6.0 * x - 3.0, 6.0 * y - 3.0, 0.0]
            });
        let shape = scene.shape();
        let lines = lines(&shape, &found(&shape).graph);
        assert_eq!(lines.len(), 1);
        assert!(lines[0].1);
        let z = lines[0].0.iter().fold(0.0, |z: f64, p| z.max(p[2].abs()));
        assert!(z < 1e-6);
        assert!((length(&lines[0]) - 8.0).abs() < 1e-5);
    }
}

#[test]
fn a_sheet_that_ends_inside_a_box_leaves_an_open_line() {
    let scene = Scene::new()
        .with(&cube(), |p| p)
        .with(&plane(1, 1), |[x, y, _]| [3.0 * x, y - 0.47, 0.1]);
    let shape = scene.shape();
    let lines = lines(&shape, &found(&shape).graph);
    assert_eq!(lines.len(), 1);
    assert!(!lines[0].1);
    assert!((length(&lines[0]) - 1.0).abs() < 1e-5, "{:?}", lines);
}

#[test]
fn boxes_that_touch_have_no_line() {
    let mut row = Scene::new();
    for i in 0..4 {
        row = row.with(&cube(), |[x, y, z]| [x + 2.0 * i as f32, y, z]);
    }
    let shape = row.shape();
    assert_eq!(found(&shape).graph.nodes.len(), 0);

    // On a floor, shifted against its neighbour, and corner to corner.
    let pile = Scene::new()
        .with(&plane(7, 7), |[x, y, _]| {
            [10.0 * x - 5.0, 10.0 * y - 5.0, 0.0]
        })
        .with(&cube(), |[x, y, z]| [x, y, z + 1.0])
        .with(&cube(), |[x, y, z]| [x + 2.0, y + 0.5, z + 1.0])
        .with(&cube(), |[x, y, z]| [x - 2.0, y + 2.0, z + 1.0])
        .with(&cube(), |[x, y, z]| [x + 0.5, y, z + 3.0]);
    let shape = pile.shape();
    assert_eq!(lines(&shape, &found(&shape).graph), []);
}

#[test]
fn a_line_ends_where_faces_lie_in_one_plane() {
    // The small box looks out of the large one, flush with its top: three sides of a rectangle are left.
    let scene = Scene::new()
        .with(&cube(), |p| p)
        .with(&cube(), |[x, y, z]| [x + 1.0, 0.5 * y, 0.5 * z + 0.5]);
    let shape = scene.shape();
    let lines = lines(&shape, &found(&shape).graph);
    assert_eq!(lines.len(), 1);
    assert!(!lines[0].1);
    assert!((length(&lines[0]) - 3.0).abs() < 1e-5, "{lines:?}");
}

#[test]
fn a_surface_that_cuts_itself_at_a_vertex_of_its_own() {
    // Two fans around vertex 0, a cone and a sheet through it.
    let positions = [
        [0.0, 0.0, 0.0],
        [2.0, 0.1, 1.0],
        [2.0, 0.2, -1.0],
        [3.0, -1.0, 0.1],
        [3.1, 1.0, 0.2],
    ];
    let shape = shape_of(&positions, &[[0, 1, 2], [0, 3, 4]]);
    let found = found(&shape);
    let lines = lines(&shape, &found.graph);
    assert_eq!((lines.len(), found.piercings.len()), (1, 1));
    assert!(lines[0].0.contains(&[0.0; 3]));
}

#[test]
fn degenerate_faces_do_not_break_lines() {
    // A wall of two triangles with a zero-area one between them, cut by a triangle through all three.
    let positions = [
        [0.0, 0.0, 0.0],
        [0.0, 0.0, 2.0],
        [0.0, 0.0, 1.0],
        [-2.0, 0.0, 1.0],
        [2.0, 0.0, 1.0],
        [-3.0, -1.0, 0.5],
        [3.0, -1.0, 0.5],
        [0.0, 2.0, 0.51],
    ];
    let faces = [[3, 0, 1], [0, 2, 1], [0, 4, 2], [2, 4, 1], [5, 6, 7]];
    let shape = shape_of(&positions, &faces);
    let lines = lines(&shape, &found(&shape).graph);
    assert_eq!(lines.len(), 1, "{lines:?}");
}

#[test]
fn hostile_shapes_do_no_harm() {
    assert_eq!(found(&HalfEdgeMesh::default()), Crossings::default());
    let one = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    assert_eq!(found(&shape_of(&one, &[[0, 1, 2]])), Crossings::default());

    // The same picture at every scale, up to the largest numbers and down to the smallest.
    for scale in [1e-44, 1e-30, 1.0, 1e30, 1e38_f32] {
        let scene = Scene::new()
            .with(&cube(), |p| p.map(|v| (8.0 * v) * scale))
            .with(&cube(), |[x, y, z]| {
                [8.0 * x + 3.0, 8.0 * y + 5.0, 8.0 * z + 1.0].map(|v| v * scale / 4.0)
            });
        let shape = scene.shape();
        if shape.positions.iter().flatten().all(|v| v.is_finite()) {
            unlimited(&shape).graph.sanity_check();
        }
    }
}

#[test]
fn a_copy_in_the_same_place_has_no_line() {
    let scene = Scene::new()
        .with(&icosphere(2), |p| p)
        .with(&icosphere(2), |p| p);
    let shape = scene.shape();
    assert_eq!(found(&shape).graph.nodes.len(), 0);
}

/// Faces with corners anywhere in a cube.
fn shape_of_soup(count: u32) -> HalfEdgeMesh {
    let mut random = Random::new(7);
    let positions: Vec<[f32; 3]> = (0..3 * count)
        .map(|_| [random.unit(), random.unit(), random.unit()])
        .collect();
    let faces: Vec<[u32; 3]> = (0..count).map(|f| [3 * f, 3 * f + 1, 3 * f + 2]).collect();
    shape_of(&positions, &faces)
}

#[test]
fn thousands_of_overlapping_faces_are_reported() {
    let shape = shape_of_soup(10_000);
    let found = unlimited(&shape);
    assert!(found.overflow);
    assert!(!found.piercings.is_empty());
}

/// Fewer pairs than are looked at, but more pieces than can be drawn.
#[test]
fn a_thousand_faces_that_all_cut_each_other_have_piercings_and_no_lines() {
    let shape = shape_of_soup(1000);
    let found = unlimited(&shape);
    assert!(found.overflow && found.graph.nodes.is_empty());
    assert!(found.piercings.len() > PIECES);
    let few = shape_of_soup(200);
    let found = unlimited(&few);
    assert!(!found.overflow && !found.graph.nodes.is_empty());
}

#[test]
fn the_number_of_threads_does_not_show() {
    let scene = Scene::new()
        .with(&icosphere(3), |p| p)
        .with(&icosphere(3), |[x, y, z]| [x + 0.7, y, z + 0.2]);
    let shape = scene.shape();
    let all = found(&shape);
    let one = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .unwrap();
    assert_eq!(one.install(|| found(&shape)), all);
    assert!(!all.graph.nodes.is_empty());
}
