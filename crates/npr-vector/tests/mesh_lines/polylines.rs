//! Lines that are geometry themselves: linked, seen and hidden as a plain walk says.

use glam::DVec3;
use npr_core::camera::{Camera, Projection};
use npr_core::geometry::NONE;
use npr_mesh::Mesh;
use npr_mesh::half_edge::{HalfEdgeMesh, Surface};
use npr_mesh::shape::{PlacedMesh, add_mesh};
use npr_mesh::testing::{self, shape_of};
use npr_vector::mesh_lines::draw::{LineSettings, LineSource, Prepared, strokes};
use npr_vector::mesh_lines::polyline::{TOUCH_SHARE, polylines};
use npr_vector::project::Projector;
use npr_vector::stroke::{Kind, Stroke};
use proptest::prelude::*;
use std::collections::BTreeMap;

const SIZE: [u32; 2] = [400, 300];

/// Length of the longest gap that is closed, in pixels.
const CLOSED_PX: f64 = 0.75;

fn camera(eye: [f32; 3]) -> Camera {
    Camera {
        eye,
        target: [0.0; 3],
        up: [0.0, 1.0, 0.0],
        projection: Projection::Perspective { fov_y: 0.9 },
    }
}

/// A direction, from which the eye looks at a distance of 5.
fn any_eye() -> impl Strategy<Value = [f32; 3]> {
    prop::array::uniform3(-1.0_f32..1.0)
        .prop_filter("a direction", |e| e[0].abs() + e[2].abs() > 0.1)
        .prop_map(|e| {
            let length = e.iter().map(|v| v * v).sum::<f32>().sqrt();
            e.map(|v| 5.0 * v / length)
        })
}

fn point() -> impl Strategy<Value = [f32; 3]> {
    prop::array::uniform3(-1.2_f32..1.2)
}

fn any_mesh() -> impl Strategy<Value = Mesh> {
    prop_oneof![
        (0_u32..3).prop_map(testing::icosphere),
        (3_u32..9, 3_u32..9).prop_map(|(a, b)| testing::torus(a, b, 1.0, 0.4)),
        (1_u32..6, 1_u32..6).prop_map(|(a, b)| testing::plane(a, b)),
        (0_usize..20, any::<u64>()).prop_map(|(n, seed)| testing::random_soup(n, seed)),
    ]
}

/// A shape of a mesh, and of lines in a mesh of their own.
fn shape_with(mesh: Option<&Mesh>, points: &[[f32; 3]], segments: &[[u32; 2]]) -> HalfEdgeMesh {
    let mut shape = match mesh {
        Some(mesh) => shape_of(mesh),
        None => HalfEdgeMesh {
            surfaces: vec![Surface::default()],
            ..HalfEdgeMesh::default()
        },
    };
    let placed = PlacedMesh {
        rest: points,
        world: points,
        polylines: segments,
        polyline_surfaces: &vec![0; segments.len()],
        ..PlacedMesh::default()
    };
    add_mesh(&mut shape, &placed, 0.0);
    shape.sanity_check();
    shape
}

fn draw(shape: &HalfEdgeMesh, eye: [f32; 3], hidden: bool) -> Vec<Stroke> {
    let settings = LineSettings {
        size: SIZE,
        kinds: 0,
        method: LineSource::Edges,
        smooth: false,
        hidden,
        split: None,
        memory_limit: u64::MAX,
    };
    let prepared = Prepared::new(shape, 0.77, false);
    strokes(shape, &prepared, &projector(eye), &settings, &|_| 2.0)
}

fn projector(eye: [f32; 3]) -> Projector {
    Projector::new(&camera(eye), SIZE, ([-2.0; 3], [2.0; 3]))
}

/// A walk along a polyline, or back.
fn is_along(found: &[[f32; 3]], wanted: &[[f32; 3]]) -> bool {
    let near = |(a, b): (&[f32; 3], &[f32; 3])| (0..3).all(|i| (a[i] - b[i]).abs() < 1e-5);
    found.len() == wanted.len()
        && (found.iter().zip(wanted).all(near) || found.iter().zip(wanted.iter().rev()).all(near))
}

proptest! {
    /// Every polyline is in one chain; chains pass where two meet, and end everywhere else.
    #[test]
    fn polylines_are_linked_where_two_meet(
        segments in prop::collection::vec(prop::array::uniform2(0_u32..8), 0..14),
    ) {
        let points: Vec<[f32; 3]> = (0..8_u32).map(|i| [i as f32, (i * i) as f32, 0.0]).collect();
        let shape = shape_with(None, &points, &segments);
        let mut wanted: Vec<[u32; 2]> = segments.iter().map(|[a, b]| [*a.min(b), *a.max(b)]).collect();
        wanted.retain(|[a, b]| a != b);
        wanted.sort_unstable();
        wanted.dedup();
        let mut degrees = BTreeMap::<u32, usize>::new();
        wanted.iter().flatten().for_each(|v| *degrees.entry(*v).or_default() += 1);

        let graph = polylines(&shape);
        graph.sanity_check();
        let number = |node: u32| graph.position(&shape, node)[0] as u32;
        let mut walked = Vec::new();
        let mut ends = BTreeMap::<u32, usize>::new();
        for chain in graph.chains() {
            for node in &chain {
                let next = graph.nodes[*node as usize].next;
                let (a, b) = (number(*node), number(next));
                walked.push([a.min(b), a.max(b)]);
            }
            if graph.is_loop(&chain) {
                chain.iter().for_each(|node| assert_eq!(degrees[&number(*node)], 2));
                continue;
            }
            chain[1..].iter().for_each(|node| assert_eq!(degrees[&number(*node)], 2));
            let last = graph.nodes[chain[chain.len() - 1] as usize].next;
            prop_assert_eq!(graph.nodes[last as usize].next, NONE);
            for end in [chain[0], last] {
                *ends.entry(number(end)).or_default() += 1;
            }
        }
        walked.sort_unstable();
        prop_assert_eq!(walked, wanted);
        degrees.retain(|_, degree| *degree != 2);
        prop_assert_eq!(ends, degrees);
    }

    /// A polyline that nothing hides is one stroke through the images of its points.
    #[test]
    fn a_polyline_is_one_stroke_through_the_images_of_its_points(
        points in prop::collection::vec(point(), 2..12), eye in any_eye(), shuffle: u64,
    ) {
        let mut segments: Vec<[u32; 2]> = (1..points.len() as u32).map(|i| [i - 1, i]).collect();
        // Neither the order of segments nor their directions matter.
        let turns = shuffle as usize % segments.len();
        segments.rotate_left(turns);
        segments.iter_mut().enumerate().for_each(|(i, s)| if shuffle >> (i % 64) & 1 == 1 { s.reverse() });
        let shape = shape_with(None, &points, &segments);
        let drawn = draw(&shape, eye, false);
        prop_assert_eq!(drawn.len(), 1);
        let stroke = &drawn[0];
        prop_assert_eq!((stroke.kind, stroke.closed, stroke.occluders), (Kind::Marked, false, 0));
        let world: Vec<[f32; 3]> = stroke.points.iter().map(|p| p.world).collect();
        prop_assert!(is_along(&world, &points), "{:?} for {:?}", world, points);
        for point in &stroke.points {
            let [x, y] = projector(eye).project(DVec3::from(point.world.map(f64::from)));
            let off = (point.position[0] - x).hypot(point.position[1] - y);
            prop_assert!(off < 1e-3, "{} px", off);
        }
    }

    /// What is shown of lines among faces is what a walk over all faces shows at every piece.
    #[test]
    fn faces_hide_lines_as_a_walk_over_all_faces_says(
        mesh in any_mesh(), points in prop::collection::vec(point(), 2..8), eye in any_eye(), share in 0.05_f64..0.95,
    ) {
        let segments: Vec<[u32; 2]> = (1..points.len() as u32).map(|i| [i - 1, i]).collect();
        let shape = shape_with(Some(&mesh), &points, &segments);
        let touch = TOUCH_SHARE * diagonal(&shape);
        for stroke in draw(&shape, eye, true).iter().filter(|s| s.kind == Kind::Marked) {
            for pair in stroke.points.windows(2) {
                let [a, b] = [&pair[0], &pair[1]].map(|p| DVec3::from(p.world.map(f64::from)));
                let [p, q] = [&pair[0], &pair[1]].map(|p| p.position);
                // Gaps too short to see are closed, and hidden stretches are told by their least number of faces.
                if (p[0] - q[0]).hypot(p[1] - q[1]) < 1.0 {
                    continue;
                }
                // A gap lies within its length of a place that counts.
                let eye = DVec3::from(eye.map(f64::from));
                let beside = CLOSED_PX / (p[0] - q[0]).hypot(p[1] - q[1]);
                let around = [share, (share - beside).max(0.0), (share + beside).min(1.0)];
                let counts = around.map(|share| hiders(&shape, eye, a.lerp(b, share), touch));
                let may_be_hidden = counts.iter().any(|(_, perhaps)| *perhaps > 0);
                let may_be_seen = counts.iter().any(|(surely, _)| *surely == 0);
                prop_assert!(stroke.occluders == 0 || may_be_hidden, "hidden by nothing");
                prop_assert!(stroke.occluders > 0 || may_be_seen, "seen behind faces: {:?}", counts);
            }
        }
    }

    /// Lines drawn on a ball are shown whole where they face the eye and hidden where they do not, whatever the
    /// rounding. One that touches a face turned to the eye, along an edge of its own that is turned away, is seen with
    /// that.
    #[test]
    fn lines_on_faces_are_shown_from_every_eye(
        level in 0_u32..4, eye in any_eye(),
        places in prop::collection::vec((any::<prop::sample::Index>(), prop::array::uniform6(0.01_f32..1.0)), 1..6),
        scale in 0.01_f32..100.0, shift in prop::array::uniform3(-0.3_f32..0.3),
    ) {
        let ball = testing::mapped(&testing::icosphere(level), |p| {
            std::array::from_fn(|i| (p[i] * 0.8 + shift[i]) * scale)
        });
        let mut points = Vec::new();
        let mut is_front = Vec::new();
        let eye_at = DVec3::from(eye.map(|v| f64::from(v * scale)));
        for (face, shares) in &places {
            let corners = ball.triangles()[face.index(ball.triangles().len())];
            let corners = corners.map(|v| ball.positions()[v as usize]);
            for shares in shares.as_chunks::<3>().0 {
                let sum: f32 = shares.iter().sum();
                let mean = |i: usize| (0..3).map(|k: usize| corners[k][i] * shares[k] / sum).sum::<f32>();
                points.push(std::array::from_fn(mean));
            }
            let [a, b, c] = corners.map(|p| DVec3::from(p.map(f64::from)));
            let normal = (b - a).cross(c - a).normalize();
            is_front.push((eye_at - a).normalize().dot(normal));
        }
        let segments: Vec<[u32; 2]> = (0..places.len() as u32).map(|i| [2 * i, 2 * i + 1]).collect();
        let shape = shape_with(Some(&ball), &points, &segments);
        let settings = LineSettings {
            size: SIZE, kinds: 0, method: LineSource::Edges, smooth: false, hidden: false, split: None,
            memory_limit: u64::MAX,
        };
        let touch = TOUCH_SHARE * diagonal(&shape);
        let prepared = Prepared::new(&shape, 0.77, false);
        let of_camera = camera(eye.map(|v| v * scale));
        let projector = Projector::new(&of_camera, SIZE, ([-2.0 * scale; 3], [2.0 * scale; 3]));
        let drawn = strokes(&shape, &prepared, &projector, &settings, &|_| 2.0);
        for (i, cos) in is_front.iter().enumerate() {
            let ends = [2 * i, 2 * i + 1].map(|v| projector.project(DVec3::from(points[v].map(f64::from))));
            let length = (ends[1][0] - ends[0][0]).hypot(ends[1][1] - ends[0][1]);
            let own = drawn.iter().filter(|stroke| {
                let world = [stroke.points[0].world, stroke.points[stroke.points.len() - 1].world];
                // By where they lie: two lines of one face may be parts of each other.
                let [a, b] = [points[2 * i], points[2 * i + 1]].map(|p| DVec3::from(p.map(f64::from)));
                world.iter().all(|p| distance_from(DVec3::from(p.map(f64::from)), a, b) < 1e-5 * f64::from(scale))
            });
            let shown: f64 = own.map(Stroke::length).sum();
            // Edge-on, the tolerance decides.
            if *cos > 0.02 {
                prop_assert!(shown > length - 0.05, "{shown} of {length} px at {cos}");
            } else if *cos < -0.05 {
                let [a, b] = [points[2 * i], points[2 * i + 1]].map(|p| DVec3::from(p.map(f64::from)));
                let mut along = (0..=8).map(|step| a.lerp(b, f64::from(step) / 8.0));
                let touches = along.any(|p| hiders(&shape, eye_at, p, touch).0 == 0);
                prop_assert!(touches || shown < 0.05, "{shown} px at {cos}");
            }
        }
    }
}

fn diagonal(shape: &HalfEdgeMesh) -> f64 {
    let point = |p: &[f32; 3]| DVec3::from(p.map(f64::from));
    let low = shape.positions.iter().map(point).reduce(DVec3::min);
    let high = shape.positions.iter().map(point).reduce(DVec3::max);
    (high.unwrap_or_default() - low.unwrap_or_default()).length()
}

fn distance_from(p: DVec3, a: DVec3, b: DVec3) -> f64 {
    let t = ((p - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
    (a.lerp(b, t) - p).length()
}

/// How many faces lie between the eye and a point: surely, by twice the tolerance, and perhaps, by half of it.
fn hiders(shape: &HalfEdgeMesh, eye: DVec3, point: DVec3, touch: f64) -> (usize, usize) {
    let way = point - eye;
    let mut counts = (0, 0);
    for corners in &shape.faces {
        let [a, b, c] = corners.map(|v| shape.point(v));
        let normal = (b - a).cross(c - a).normalize_or_zero();
        let behind = (point - a).dot(normal).abs();
        let at = (a - eye).dot(normal) / way.dot(normal);
        let crossed = eye + way * at;
        let side = |a: DVec3, b: DVec3| (b - a).normalize_or_zero().cross(crossed - a).dot(normal);
        let inside = side(a, b).min(side(b, c)).min(side(c, a));
        if (0.0..1.0).contains(&at) && inside > -1e-9 {
            counts.0 += usize::from(behind > 2.0 * touch && inside > 0.1 * touch);
            counts.1 += usize::from(behind > 0.5 * touch);
        }
    }
    counts
}
