//! Where along a stroke colours and widths are read: at the place of the surface that the stroke shows there.

use glam::DVec3;
use npr_core::camera::{Camera, Projection};
use npr_core::line_kind::KindSet;
use npr_mesh::Mesh;
use npr_mesh::half_edge::HalfEdgeMesh;
use npr_mesh::testing::{self, shape_of};
use npr_vector::mesh_lines::contour::EdgeContours;
use npr_vector::mesh_lines::draw::{
    LineSettings, LineSource, PointPaint, Prepared, StrokeLook, eye_of, strokes_with,
};
use npr_vector::mesh_lines::run::{RunPoint, distance};
use npr_vector::project::Projector;
use npr_vector::stroke::Kind;
use npr_vector::surface_location::SurfaceLocation;
use proptest::prelude::*;
use std::sync::Mutex;

const SIZE: [u32; 2] = [400, 300];

/// How far a place in the world may lie off the edge or face that it is painted by: what rounding makes of it.
const OFF_PX: f64 = 0.01;

/// Closed meshes from coarse to fine, some with creases.
fn any_mesh() -> impl Strategy<Value = Mesh> {
    prop_oneof![
        Just(testing::cube()),
        (0_u32..4).prop_map(testing::icosphere),
        (3_u32..12, 3_u32..9).prop_map(|(a, b)| testing::torus(a, b, 1.0, 0.4)),
        (3_u32..12, 1_u32..4).prop_map(|(a, b)| testing::cylinder(a, b)),
    ]
}

/// A direction, from which the eye looks at a distance of 5.
fn any_eye() -> impl Strategy<Value = [f32; 3]> {
    prop::array::uniform3(-1.0_f32..1.0)
        .prop_filter("a direction", |e| {
            e[0].abs() + e[2].abs() > 0.1 && e.iter().map(|v| v * v).sum::<f32>() > 0.1
        })
        .prop_map(|e| {
            let length = e.iter().map(|v| v * v).sum::<f32>().sqrt();
            e.map(|v| 5.0 * v / length)
        })
}

/// How far in pixels the places that points are painted by lie off the points, at most.
fn off_px(mesh: &Mesh, eye: [f32; 3], settings: &LineSettings) -> f64 {
    let shape = shape_of(mesh);
    let prepared = Prepared::new(&shape, 0.77, true);
    let camera = Camera {
        eye,
        target: [0.0; 3],
        up: [0.0, 1.0, 0.0],
        projection: Projection::Perspective { fov_y: 0.7 },
    };
    let projector = Projector::new(&camera, settings.size, ([-2.0; 3], [2.0; 3]));
    let all = Mutex::new(Vec::new());
    let paint_at = |_: Kind, _: u32, point: &RunPoint| {
        let (vertices, shares) = point.location.place(&shape, point.world);
        let place = mean(&shape, vertices, shares);
        let [at, painted] = [point.world, place].map(|world| projector.project(world));
        all.lock().expect("no panic").push(distance(at, painted));
        PointPaint {
            color: None,
            width: 1.0,
        }
    };
    let look = StrokeLook {
        width_at: &|_| 2.0,
        paint_at: Some(&paint_at),
        is_lit: false,
        follows_bends: false,
    };
    let contours = EdgeContours::new(&shape, &eye_of(&shape, &projector));
    let found = strokes_with(
        &shape,
        &prepared,
        &projector,
        settings,
        &contours,
        &look,
        (None, None),
    );
    assert!(!found.expect("no limit is set").strokes.is_empty());
    let all = all.into_inner().expect("no panic");
    all.into_iter().fold(0.0, f64::max)
}

fn mean(shape: &HalfEdgeMesh, vertices: [u32; 3], shares: [f64; 3]) -> DVec3 {
    (0..3).fold(DVec3::ZERO, |sum, i| {
        sum + shape.point(vertices[i]) * shares[i]
    })
}

/// Visible and hidden lines, all kinds, as smooth as usual.
fn smoothed_by(method: LineSource, hidden: bool) -> LineSettings {
    LineSettings {
        size: SIZE,
        kinds: KindSet::BITS,
        method,
        smooth: true,
        hidden,
        split: None,
        memory_limit: u64::MAX,
    }
}

/// A gap between ends at different depths was closed; samples in it were painted by the far end of an edge 38 px away.
#[test]
fn a_gap_is_painted_by_the_edges_at_its_ends() {
    let eye = [-4.129747, -0.078502364, 2.8176284];
    let settings = smoothed_by(LineSource::Edges, true);
    assert!(off_px(&testing::torus(3, 3, 1.0, 0.4), eye, &settings) < OFF_PX);
}

/// An edge of one pixel leads far into the picture; a sample between it and the edge before was painted by that one's
/// end.
#[test]
fn an_edge_seen_from_its_end_is_painted_by_itself() {
    let eye = [-2.5338717, 2.2957144, 3.6481762];
    let settings = smoothed_by(LineSource::Edges, false);
    assert!(off_px(&testing::icosphere(0), eye, &settings) < OFF_PX);
}

/// A line was turned round after a gap, and its first point took the edge of what had come behind its last.
#[test]
fn a_line_turned_round_keeps_the_edges_at_its_ends() {
    let eye = [4.068646, -2.713667, -1.0402565];
    let settings = smoothed_by(LineSource::Surface, true);
    assert!(off_px(&testing::torus(7, 5, 1.0, 0.4), eye, &settings) < OFF_PX);
}

/// Areas of 1e308 each, whose sum is no number any more, gave shares of nothing.
#[test]
fn a_place_without_measure_has_shares() {
    let corners = [
        [0.89774203, 0.0, 0.0],
        [-0.95663255, 0.0, -0.7937195],
        [0.0, 0.0, 0.6719844],
    ];
    let shape = shape_of(&Mesh::new(corners.to_vec(), vec![[0, 1, 2]]).expect("a triangle"));
    let far = DVec3::new(0.0, 0.0, -7.681978216658908e307);
    let (_, shares) = SurfaceLocation { edge: 0, face: 0 }.place(&shape, far);
    assert!(
        (shares.iter().sum::<f64>() - 1.0).abs() < 1e-9,
        "{shares:?}"
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    /// Points are painted by the place where they are, whatever was smoothed, joined, turned round and broken up.
    #[test]
    fn points_are_painted_by_where_they_are(
        mesh in any_mesh(), eye in any_eye(), smooth: bool, hidden: bool, on_surface: bool,
        split in prop::option::of(0.2_f32..3.0),
    ) {
        let method = if on_surface { LineSource::Surface } else { LineSource::Edges };
        let settings = LineSettings {
            size: SIZE,
            kinds: KindSet::BITS,
            method,
            smooth,
            hidden,
            split,
            memory_limit: u64::MAX,
        };
        let off = off_px(&mesh, eye, &settings);
        prop_assert!(off < OFF_PX, "{} px", off);
    }

    /// A place is the nearest of its location, on any triangle.
    #[test]
    fn places_are_the_nearest(
        corners in prop::array::uniform3(prop::array::uniform3(-1.0_f32..1.0)),
        shares in prop::array::uniform3(0.01_f64..1.0), lift in -0.2_f64..0.2,
    ) {
        let mesh = Mesh::new(corners.to_vec(), vec![[0, 1, 2]]).expect("a triangle");
        let shape = shape_of(&mesh);
        prop_assume!(shape.faces.len() == 1 && shape.degenerate_faces.is_empty());
        let points = shape.faces[0].map(|vertex| shape.point(vertex));
        let up = (points[1] - points[0]).cross(points[2] - points[0]);
        prop_assume!(up.length() > 1e-3);
        let sum: f64 = shares.iter().sum();
        let inside = mean(&shape, shape.faces[0], shares.map(|share| share / sum));
        let (vertices, found) = SurfaceLocation { edge: 0, face: 0 }.place(&shape, inside + up.normalize() * lift);
        prop_assert!((mean(&shape, vertices, found) - inside).length() < 1e-6);
        // Of an edge none of its points lies nearer.
        let location = SurfaceLocation::along(0);
        let (vertices, found) = location.place(&shape, inside);
        let off = (mean(&shape, vertices, found) - inside).length();
        let [low, high] = shape.ends(0).map(|vertex| shape.point(vertex));
        for i in 0..=100 {
            let other = low.lerp(high, f64::from(i) / 100.0);
            prop_assert!(off <= (other - inside).length() + 1e-12);
        }
    }

    /// Any numbers give shares of the sum 1.
    #[test]
    fn any_place_has_shares(
        corners in prop::array::uniform3(prop::array::uniform3(-1.0_f32..1.0)), flat: bool,
        world in prop::array::uniform3(any::<f64>()),
    ) {
        let corners = corners.map(|[x, y, z]| if flat { [x, 2.0 * x, -x] } else { [x, y, z] });
        let shape = shape_of(&Mesh::new(corners.to_vec(), vec![[0, 1, 2]]).expect("a triangle"));
        prop_assume!(!shape.faces.is_empty());
        for location in [SurfaceLocation { edge: 0, face: 0 }, SurfaceLocation::along(0)] {
            let (_, shares) = location.place(&shape, DVec3::from_array(world));
            prop_assert!(shares.iter().all(|share| (0.0..=1.0).contains(share)), "{:?}", shares);
            prop_assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-9);
        }
    }
}
