//! Lines of whole shapes: what must hold on every mesh, from every eye.

use npr_core::camera::{Camera, Projection};
use npr_core::edge_flags::EdgeFlags;
use npr_core::geometry::NONE;
use npr_core::line_kind::KindSet;
use npr_mesh::Mesh;
use npr_mesh::half_edge::{HalfEdgeMesh, Surface};
use npr_mesh::testing::{self, add_to, shape_of};
use npr_vector::mesh_lines::bvh::{FaceTree, Sight};
use npr_vector::mesh_lines::contour::{Eye, contours, facing};
use npr_vector::mesh_lines::draw::{LineSettings, LineSource, Prepared, strokes};
use npr_vector::mesh_lines::feature::features;
use npr_vector::mesh_lines::graph::CurveNode;
use npr_vector::project::Projector;
use npr_vector::stroke::{Kind, Stroke};
use proptest::prelude::*;
use std::collections::BTreeSet;

const SIZE: [u32; 2] = [400, 300];

fn camera(eye: [f32; 3]) -> Camera {
    Camera {
        eye,
        target: [0.0; 3],
        up: [0.0, 1.0, 0.0],
        projection: Projection::Perspective { fov_y: 0.7 },
    }
}

fn settings(smooth: bool) -> LineSettings {
    LineSettings {
        size: SIZE,
        kinds: KindSet::BITS,
        method: LineSource::Edges,
        smooth,
        hidden: false,
        split: None,
        memory_limit: u64::MAX,
    }
}

fn bounds(shape: &HalfEdgeMesh) -> ([f32; 3], [f32; 3]) {
    let none = ([f32::MAX; 3], [f32::MIN; 3]);
    shape.positions.iter().fold(none, |(low, high), p| {
        (
            std::array::from_fn(|i| low[i].min(p[i])),
            std::array::from_fn(|i| high[i].max(p[i])),
        )
    })
}

fn draw(shape: &HalfEdgeMesh, eye: [f32; 3], settings: &LineSettings) -> Vec<Stroke> {
    let with_crossings = settings.kinds & KindSet::INTERSECTION != 0;
    let prepared = Prepared::new(shape, 0.77, with_crossings);
    let projector = Projector::new(&camera(eye), settings.size, bounds(shape));
    strokes(shape, &prepared, &projector, settings, &|_| 2.0)
}

/// Meshes of every sort, good and bad.
fn any_mesh() -> impl Strategy<Value = Mesh> {
    let smooth = (0_u32..3).prop_map(testing::icosphere);
    let round = (3_u32..9, 3_u32..9).prop_map(|(a, b)| testing::torus(a, b, 1.0, 0.4));
    let open = (1_u32..6, 1_u32..6).prop_map(|(a, b)| testing::plane(a, b));
    let soup = (0_usize..40, any::<u64>()).prop_map(|(n, seed)| testing::random_soup(n, seed));
    let odd = prop_oneof![
        (3_u32..20).prop_map(testing::moebius_strip),
        (1_u32..8).prop_map(testing::fan),
        (3_u32..9, 1_u32..4).prop_map(|(a, b)| testing::cylinder(a, b)),
    ];
    let base = prop_oneof![smooth, round, open, soup, odd].boxed();
    let wound =
        (base.clone(), any::<u64>()).prop_map(|(m, seed)| testing::random_winding(&m, seed));
    let doubled =
        (base.clone(), any::<u64>()).prop_map(|(m, seed)| testing::with_doubles(&m, seed));
    let bumpy = (base.clone(), 0.0_f32..0.5).prop_map(|(m, size)| {
        testing::mapped(&m, |[x, y, z]| {
            let bump = ((x * 12.9 + y * 78.2 + z * 37.7) * 3.0).fract() * size;
            [x + bump, y - bump, z + bump * 0.5]
        })
    });
    prop_oneof![base, wound, doubled, bumpy]
}

fn any_eye() -> impl Strategy<Value = [f32; 3]> {
    prop::array::uniform3(-4.0_f32..4.0).prop_filter("not at the target", |e| {
        e.iter().map(|v| v * v).sum::<f32>() > 1e-3
    })
}

fn eye_of(eye: [f32; 3]) -> Eye {
    let [x, y, z] = eye.map(f64::from);
    Eye::new([x, y, z, 1.0], 8.0)
}

/// Tail and head of the piece after a node that runs along its edge.
fn ends_of_piece(shape: &HalfEdgeMesh, node: &CurveNode) -> [u32; 2] {
    let [low, high] = shape.ends(node.edge);
    if node.t == 0.0 {
        [low, high]
    } else {
        [high, low]
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    /// The successor map is a permutation: all contour loops close, on any mesh.
    #[test]
    fn contour_loops_close(mesh in any_mesh(), eye in any_eye()) {
        let shape = shape_of(&mesh);
        let eye = eye_of(eye);
        let front = facing(&shape, &eye);
        let graph = contours(&shape, &front, &eye);
        graph.sanity_check();
        for node in &graph.nodes {
            prop_assert_ne!(node.next, NONE);
            prop_assert_ne!(node.prev, NONE);
            let next = &graph.nodes[node.next as usize];
            prop_assert_eq!(ends_of_piece(&shape, node)[1], ends_of_piece(&shape, next)[0]);
        }
    }

    /// Exactly the edges between a front and a back face are contours, each once.
    #[test]
    fn contours_are_the_edges_that_turn_away(mesh in any_mesh(), eye in any_eye()) {
        let shape = shape_of(&mesh);
        let eye = eye_of(eye);
        let front = facing(&shape, &eye);
        let mut found: Vec<u32> = contours(&shape, &front, &eye)
            .nodes
            .iter()
            .filter(|node| node.flags & KindSet::CONTOUR != 0)
            .map(|node| node.edge)
            .collect();
        found.sort_unstable();
        let expected: Vec<u32> = (0..shape.edge_count() as u32)
            .filter(|edge| match shape.sides(*edge) {
                [a, b] if !shape.edge_traits[*edge as usize].contains(EdgeFlags::FLIPPED) => {
                    front[*a as usize / 3] != front[*b as usize / 3]
                }
                _ => false,
            })
            .collect();
        prop_assert_eq!(found, expected);
    }

    /// Every feature edge is in the graph once, and chains hold together.
    #[test]
    fn features_hold_every_edge_once(mesh in any_mesh()) {
        let shape = shape_of(&mesh);
        let graph = features(&shape, 0.77);
        graph.sanity_check();
        let pieces = || graph.nodes.iter().filter(|node| node.next != NONE);
        let mut found: Vec<u32> = pieces().map(|node| node.edge).collect();
        found.sort_unstable();
        let expected: Vec<u32> = (0..shape.edge_count() as u32)
            .filter(|edge| {
                shape.edge_traits[*edge as usize] != EdgeFlags::NONE
                    || shape.dihedral_cos[*edge as usize] < 0.77
            })
            .collect();
        prop_assert_eq!(found, expected);
        for node in pieces() {
            let next = &graph.nodes[node.next as usize];
            prop_assert_eq!(ends_of_piece(&shape, node)[1], ends_of_piece(&shape, next)[0]);
        }
    }

    /// The tree counts what a walk over all faces counts.
    #[test]
    fn sights_agree_with_a_walk_over_all_faces(
        mesh in any_mesh(), eye in any_eye(), point in prop::array::uniform3(-1.5_f64..1.5), last: prop::sample::Index,
    ) {
        let shape = shape_of(&mesh);
        let tree = FaceTree::new(&shape);
        let sight = Sight { eye: eye.map(f64::from), point, touch: 0.0 };
        let all = tree.occluders(&shape, &sight, &[], u32::MAX);
        prop_assert_eq!(all, plainly_between(&shape, &sight));
        prop_assert_eq!(tree.occluders(&shape, &sight, &[], 1), all.min(1));
        // Whatever face is tried first.
        let last = last.index(shape.faces.len() + 1) as u32;
        let last = Some(last).filter(|face| (*face as usize) < shape.faces.len());
        prop_assert_eq!(tree.hider(&shape, &sight, &[], last).is_some(), all > 0);
    }

    /// Strokes are sound on any mesh from anywhere.
    #[test]
    fn strokes_are_sound(
        mesh in any_mesh(), eye in any_eye(), smooth: bool, hidden: bool, split in prop::option::of(0.2_f32..3.0),
    ) {
        let shape = shape_of(&mesh);
        let settings = LineSettings { hidden, split, ..settings(smooth) };
        let found = draw(&shape, eye, &settings);
        for stroke in &found {
            let least = if stroke.closed { 3 } else { 2 };
            prop_assert!(stroke.points.len() >= least);
            prop_assert!(hidden || stroke.is_visible());
            for point in &stroke.points {
                let [x, y] = point.position;
                prop_assert!((-20.0..420.0).contains(&x) && (-20.0..320.0).contains(&y), "{} {}", x, y);
                prop_assert!(point.depth > 0.0 && point.width.is_finite() && point.u >= 0.0);
            }
        }
        let mut ids: Vec<u64> = found.iter().map(|stroke| stroke.id).collect();
        ids.sort_unstable();
        ids.dedup();
        prop_assert_eq!(ids.len(), found.len(), "ids are unique");
    }

    /// Closed strokes hang on mesh edges: the same starts and ids whatever the order of faces in a file.
    #[test]
    fn closed_strokes_start_where_they_start(eye in any_eye(), seed: u64, smooth: bool) {
        let mesh = testing::torus(12, 8, 1.0, 0.4);
        let mut triangles = mesh.triangles().to_vec();
        testing::Random::new(seed).shuffle(&mut triangles);
        let shuffled = Mesh::new(mesh.positions().to_vec(), triangles).expect("a sound mesh");
        let starts = |mesh: &Mesh| {
            let found = draw(&shape_of(mesh), eye, &settings(smooth));
            let closed = found.iter().filter(|stroke| stroke.closed);
            let mut starts: Vec<_> = closed.map(|s| (s.id, s.points[0].position)).collect();
            starts.sort_by_key(|(id, _)| *id);
            starts
        };
        prop_assert_eq!(starts(&mesh), starts(&shuffled));
    }

    /// A square gives four strokes that end exactly at its corners, with ids of their own that the camera does not
    /// change.
    #[test]
    fn a_square_is_split_at_its_corners(steps in 1_u32..6, x in -1.0_f32..1.0, y in -1.0_f32..1.0, smooth: bool) {
        let mesh = testing::mapped(&testing::plane(steps, steps), |[x, y, _]| {
            [x - 0.5, y - 0.5, 0.0]
        });
        let shape = shape_of(&mesh);
        let kinds = KindSet::BOUNDARY;
        let never = LineSettings { kinds, ..settings(smooth) };
        prop_assert_eq!(draw(&shape, [x, y, 4.0], &never).len(), 1);
        let split = LineSettings { split: Some(1.0), ..never };
        let found = draw(&shape, [x, y, 4.0], &split);
        prop_assert_eq!(found.len(), 4);
        let projector = Projector::new(&camera([x, y, 4.0]), SIZE, bounds(&shape));
        for stroke in &found {
            prop_assert!(!stroke.closed);
            for end in [stroke.points[0], stroke.points[stroke.points.len() - 1]] {
                let corner = |v: &[f32; 3]| v[0].abs() == 0.5 && v[1].abs() == 0.5;
                let apart = |v: &[f32; 3]| {
                    let place = projector.project(v.map(f64::from).into());
                    (place[0] - end.position[0]).hypot(place[1] - end.position[1])
                };
                let corners = shape.positions.iter().filter(|v| corner(v));
                let nearest = corners.map(apart).fold(f64::MAX, f64::min);
                prop_assert!(nearest < 1e-3, "{} px off the corner", nearest);
            }
        }
        let ids = |strokes: &[Stroke]| strokes.iter().map(|s| s.id).collect::<BTreeSet<u64>>();
        prop_assert_eq!(ids(&found).len(), 4);
        prop_assert_eq!(ids(&found), ids(&draw(&shape, [y, -x, 3.5], &split)));
    }

    /// Where two boxes cut through each other, no line shows that lies behind either of them.
    #[test]
    fn lines_where_boxes_cross_are_hidden_by_the_boxes(
        boxes in prop::array::uniform2((prop::array::uniform3(-8_i8..8), prop::array::uniform3(1_i8..8))),
        eye in any_eye(),
    ) {
        prop_assume!(eye.iter().any(|v| v.abs() > 2.0));
        // On a grid of eighths, so that faces also lie in one plane.
        let boxes = boxes.map(|(low, extent)| {
            let low = low.map(|v| f32::from(v) / 8.0);
            [low, std::array::from_fn(|i| low[i] + f32::from(extent[i]) / 8.0)]
        });
        let mut shape = HalfEdgeMesh {
            surfaces: (0..2).map(|object| Surface { object, ..Surface::default() }).collect(),
            ..HalfEdgeMesh::default()
        };
        let cube = testing::cube();
        let at = |v: f32, [low, high]: [f32; 2]| if v > 0.0 { high } else { low };
        for (object, [low, high]) in (0..).zip(boxes) {
            let mesh = testing::mapped(&cube, |p| std::array::from_fn(|i| at(p[i], [low[i], high[i]])));
            add_to(&mut shape, &mesh, |_| object);
        }
        for stroke in draw(&shape, eye, &settings(false)) {
            for pair in stroke.points.windows(2).filter(|_| stroke.kind == Kind::Intersection) {
                let [a, b] = [0, 1].map(|i| pair[i].world.map(f64::from));
                let middle: [f64; 3] = std::array::from_fn(|i| 0.5 * (a[i] + b[i]));
                for [low, high] in boxes {
                    prop_assert!(!is_behind_box(eye, middle, low, high), "{:?} behind {:?}", middle, [low, high]);
                }
            }
        }
    }

    /// Length and kinds of what is seen do not depend on the order of vertices in a file.
    #[test]
    fn what_is_seen_does_not_depend_on_numbering(eye in any_eye(), seed: u64) {
        let mesh = testing::torus(12, 8, 1.0, 0.4);
        let (shuffled, _) = testing::shuffled_vertices(&mesh, seed);
        let length = |mesh: &Mesh| -> f64 {
            let found = draw(&shape_of(mesh), eye, &settings(false));
            found.iter().map(Stroke::length).sum()
        };
        let (one, other) = (length(&mesh), length(&shuffled));
        prop_assert!((one - other).abs() <= 0.01 * one + 2.0, "{} {}", one, other);
    }
}

/// Whether the way from the eye to a point leads through the inside of a box, well away from its sides.
fn is_behind_box(eye: [f32; 3], point: [f64; 3], low: [f32; 3], high: [f32; 3]) -> bool {
    let (mut enters, mut leaves) = (0.0_f64, 1.0_f64);
    for i in 0..3 {
        let (from, step) = (f64::from(eye[i]), point[i] - f64::from(eye[i]));
        let [low, high] = [f64::from(low[i]) + 1e-3, f64::from(high[i]) - 1e-3];
        if step.abs() < 1e-9 {
            if from < low || from > high {
                return false;
            }
            continue;
        }
        let (s, t) = ((low - from) / step, (high - from) / step);
        enters = enters.max(s.min(t));
        leaves = leaves.min(s.max(t));
    }
    enters < leaves
}

/// Faces between eye and point, by solving for the place in each.
fn plainly_between(shape: &HalfEdgeMesh, sight: &Sight) -> u32 {
    let minus = |a: [f64; 3], b: [f64; 3]| -> [f64; 3] { std::array::from_fn(|i| a[i] - b[i]) };
    let cross = |a: [f64; 3], b: [f64; 3]| {
        [
            a[1] * b[2] - a[2] * b[1],
            a[2] * b[0] - a[0] * b[2],
            a[0] * b[1] - a[1] * b[0],
        ]
    };
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let way = minus(sight.point, sight.eye);
    let passes = |corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|v| shape.positions[v as usize].map(f64::from));
        let (u, v) = (minus(b, a), minus(c, a));
        let p = cross(way, v);
        let det = dot(u, p);
        if det == 0.0 {
            return false;
        }
        let s = minus(sight.eye, a);
        let (x, q) = (dot(s, p) / det, cross(s, u));
        let (y, z) = (dot(way, q) / det, dot(v, q) / det);
        x >= 0.0 && y >= 0.0 && x + y <= 1.0 && z > 2.5e-7 && z < 1.0 - 2.5e-7
    };
    let faces = shape.faces.iter();
    faces.filter(|corners| passes(corners)).count() as u32
}

#[test]
fn a_cube_from_a_corner_shows_nine_edges() {
    let shape = shape_of(&testing::cube());
    let found = draw(&shape, [3.0, 2.5, 4.0], &settings(false));
    let edges: usize = found
        .iter()
        .map(|s| s.points.len() - usize::from(!s.closed))
        .sum();
    assert_eq!(edges, 9);
    let outline: Vec<_> = found.iter().filter(|s| s.kind == Kind::Contour).collect();
    assert_eq!(outline.len(), 1);
    assert!(outline[0].closed);
    assert_eq!(outline[0].points.len(), 6);
    assert!(
        found
            .iter()
            .all(|s| matches!(s.kind, Kind::Contour | Kind::Crease))
    );
}

#[test]
fn a_sphere_is_one_circle() {
    let shape = shape_of(&testing::icosphere(5));
    let found = draw(&shape, [0.0, 0.0, 4.0], &settings(true));
    assert_eq!(found.len(), 1);
    assert!(found[0].closed);
    // The outline of a unit sphere at distance 4: the tangent of its angle is 1 / sqrt(15).
    let radius = 150.0 / 0.35_f64.tan() / 15.0_f64.sqrt();
    for point in &found[0].points {
        let [dx, dy] = [point.position[0] - 200.0, point.position[1] - 150.0];
        let off = (dx * dx + dy * dy).sqrt() - radius;
        assert!(off.abs() < 0.6, "{off} px off the circle");
    }
}

#[test]
fn a_smooth_outline_is_never_split() {
    let shape = shape_of(&testing::icosphere(5));
    for (method, split) in [(LineSource::Surface, 0.2), (LineSource::Edges, 1.0)] {
        let split = LineSettings {
            method,
            split: Some(split),
            ..settings(true)
        };
        let found = draw(&shape, [0.3, 0.2, 4.0], &split);
        assert_eq!(found.len(), 1, "by {method:?}");
        assert!(found[0].closed);
    }
}

#[test]
fn nothing_is_drawn_of_nothing() {
    for mesh in [testing::random_soup(0, 1), testing::cube()] {
        let shape = shape_of(&mesh);
        let behind = Camera {
            target: [0.0, 0.0, 20.0],
            ..camera([0.0, 0.0, 10.0])
        };
        let projector = Projector::new(&behind, SIZE, bounds(&shape));
        let prepared = Prepared::new(&shape, 0.77, true);
        assert!(strokes(&shape, &prepared, &projector, &settings(true), &|_| 2.0).is_empty());
        let tiny = draw(&shape, [0.0, 0.0, 1e5], &settings(true));
        assert!(tiny.is_empty(), "{tiny:?}");
    }
}

#[test]
fn an_eye_inside_a_sphere_sees_no_contour() {
    let shape = shape_of(&testing::icosphere(3));
    let found = draw(&shape, [0.1, 0.0, 0.2], &settings(false));
    assert!(found.is_empty(), "{} strokes", found.len());
}

#[test]
fn a_plate_hides_what_is_behind_it() {
    // A small cube behind a large square: only the square's outline is left.
    let plate = testing::mapped(&testing::plane(1, 1), |[x, y, _]| [x - 0.5, y - 0.5, 0.0]);
    let cube = testing::mapped(&testing::cube(), |[x, y, z]| {
        [x * 0.1, y * 0.1, z * 0.1 - 1.0]
    });
    let mut shape = shape_of(&plate);
    add_to(&mut shape, &cube, |_| 0);
    let eye = [0.03, 0.02, 5.0];
    let found = draw(&shape, eye, &settings(false));
    assert!(
        found.iter().all(|stroke| stroke.kind == Kind::Boundary),
        "{found:?}"
    );
    let hidden = LineSettings {
        hidden: true,
        ..settings(false)
    };
    let all = draw(&shape, eye, &hidden);
    let behind = all.iter().filter(|stroke| stroke.occluders > 0);
    assert!(behind.clone().all(|s| s.kind != Kind::Boundary));
    assert!(behind.clone().any(|s| s.occluders == 1), "{all:?}");
}

#[test]
fn materials_meet_in_a_line() {
    let mesh = testing::plane(2, 2);
    let mut shape = HalfEdgeMesh {
        surfaces: (0..2)
            .map(|material| Surface {
                material,
                ..Surface::default()
            })
            .collect(),
        ..HalfEdgeMesh::default()
    };
    let surfaces: Vec<u32> = mesh
        .triangles()
        .iter()
        .map(|t| {
            let middle: f32 = t.iter().map(|v| mesh.positions()[*v as usize][0]).sum();
            u32::from(middle > 1.5)
        })
        .collect();
    assert!(surfaces.contains(&0) && surfaces.contains(&1));
    add_to(&mut shape, &mesh, |face| surfaces[face]);
    let found = draw(&shape, [0.5, 0.5, 4.0], &settings(false));
    assert!(found.iter().any(|stroke| stroke.kind == Kind::Material));
    let without = LineSettings {
        kinds: KindSet::CONTOUR | KindSet::BOUNDARY,
        ..settings(false)
    };
    let found = draw(&shape, [0.5, 0.5, 4.0], &without);
    assert!(found.iter().all(|stroke| stroke.kind == Kind::Boundary));
}

/// A square before the right half of a bar hides it from exactly where its edge stands in the picture.
#[test]
fn a_line_breaks_where_an_outline_crosses_it() {
    let bar = testing::mapped(&testing::plane(1, 1), |[x, y, _]| {
        [2.0 * x - 1.0, 0.1 * y, 0.0]
    });
    let square = testing::mapped(&testing::plane(1, 1), |[x, y, _]| {
        [0.25 + 2.0 * x, 2.0 * y - 1.0, 1.0]
    });
    let mut shape = shape_of(&bar);
    add_to(&mut shape, &square, |_| 0);
    let eye = [0.0, 0.0, 5.0];
    let found = draw(&shape, eye, &settings(false));
    // The square's left edge, at x = 0.25 and depth 4.
    let edge_px = 200.0 + 150.0 / 0.35_f64.tan() * 0.25 / 4.0;
    let ends: Vec<f64> = found
        .iter()
        .filter(|stroke| stroke.points[0].depth > 4.5)
        .flat_map(|stroke| [stroke.points[0], stroke.points[stroke.points.len() - 1]])
        .map(|point| point.position[0])
        .collect();
    assert_eq!(ends.len(), 2, "one open line, cut twice: {ends:?}");
    assert!(ends.iter().all(|x| (x - edge_px).abs() < 1e-3), "{ends:?}");
}

/// The front of a contour lies to its left as seen in the world from outside: to the right of the line on the page.
#[test]
fn contours_keep_their_front_on_one_side() {
    let shape = shape_of(&testing::icosphere(3));
    let eye = Eye::new([0.0, 0.0, 4.0, 1.0], 8.0);
    let front = facing(&shape, &eye);
    let graph = contours(&shape, &front, &eye);
    assert!(!graph.nodes.is_empty());
    for (index, node) in graph.nodes.iter().enumerate() {
        let [a, b] = [index as u32, node.next].map(|n| graph.position(&shape, n));
        // Counter-clockwise round the axis towards the eye, as front faces are.
        assert!(a[0] * b[1] - a[1] * b[0] > 0.0);
    }
}
