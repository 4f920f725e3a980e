//! The whole path.

use crate::mesh_lines::draw::StrokeLook;
use crate::mesh_lines::draw::eye_of;
use crate::pixel_strokes::stroke::Loops;
use crate::pixel_strokes::{PixelScene, PublishedPath, scene_depths, trace};
use crate::project::Projector;
use crate::stroke::{Kind, Stroke};
use npr_core::camera::{Camera, Projection};
use npr_core::line_kind::KindSet;
use npr_mesh::half_edge::HalfEdgeMesh;
use npr_mesh::testing::{cube, icosphere, random_soup, shape_of, uv_sphere};
use proptest::prelude::*;

fn camera(eye: [f32; 3], projection: Projection) -> Camera {
    Camera {
        eye,
        target: [0.0; 3],
        up: [0.0, 1.0, 0.0],
        projection,
    }
}

fn perspective(eye: [f32; 3]) -> Camera {
    camera(eye, Projection::Perspective { fov_y: 0.8 })
}

fn strokes(
    shape: &HalfEdgeMesh,
    camera: &Camera,
    size: [u32; 2],
    path: &PublishedPath,
) -> Vec<Stroke> {
    let bounds = ([-2.0; 3], [2.0; 3]);
    let (view, projector) = (
        camera.view(size, bounds),
        Projector::new(camera, size, bounds),
    );
    let scene = PixelScene {
        shape,
        view: &view,
        eye: &eye_of(shape, &projector),
        kinds: KindSet::BITS,
        creases: 0.766.into(),
        is_drawn: &[],
    };
    let traced = trace(&scene, path, &scene_depths(shape, &view)).expect("rounds suffice");
    let look = StrokeLook {
        width_at: &|_| 2.0,
        paint_at: None,
        is_lit: false,
        follows_bends: false,
    };
    let loops = Loops::new(&traced, path);
    traced.strokes(shape, &projector, &loops, None, &look)
}

#[test]
fn the_outline_of_a_ball_is_one_closed_stroke() {
    for projection in [
        Projection::Perspective { fov_y: 0.6 },
        Projection::Parallel { height: 3.0 },
    ] {
        let shape = shape_of(&uv_sphere(96, 48));
        let camera = camera([0.0, 0.0, 6.0], projection);
        let found = strokes(&shape, &camera, [400, 300], &PublishedPath::default());
        assert_eq!(found.len(), 1, "{projection:?}");
        assert!(found[0].closed && found[0].kind == Kind::Contour);
        let radius = match projection {
            Projection::Parallel { .. } => 100.0,
            Projection::Perspective { .. } => {
                150.0 / f64::from(npr_core::math::tan(0.3)) / 35f64.sqrt()
            }
        };
        for point in &found[0].points {
            let [x, y] = [point.position[0] - 200.0, point.position[1] - 150.0];
            let off = (x * x + y * y).sqrt() - radius;
            assert!((-2.0..1.0).contains(&off), "{off}");
            assert!((point.depth - 6.0).abs() < 0.5, "{}", point.depth);
            assert!((f64::from(point.world[0]).abs() - x.abs() / 100.0).abs() < 0.6);
        }
    }
}

#[test]
fn a_cube_shows_its_nine_edges() {
    let found = strokes(
        &shape_of(&cube()),
        &perspective([3.0, 4.0, 5.0]),
        [400, 300],
        &PublishedPath::default(),
    );
    assert!((2..=9).contains(&found.len()), "{}", found.len());
    let length: f64 = found.iter().map(Stroke::length).sum();
    assert!(length > 400.0 && found.iter().all(|stroke| stroke.points.len() > 8));
    // Inner edges are part of the outline's loops; strokes have the kind of most of their sides.
    assert!(found.iter().any(|stroke| stroke.kind == Kind::Contour));
    let ids: std::collections::BTreeSet<u64> = found.iter().map(|stroke| stroke.id).collect();
    assert_eq!(ids.len(), found.len());
}

#[test]
fn every_constant_works() {
    let shape = shape_of(&uv_sphere(24, 12));
    let usual = PublishedPath::default();
    let with =
        |path: PublishedPath| strokes(&shape, &perspective([0.0, 1.0, 4.0]), [200, 160], &path);
    let plain = with(usual);
    let others = [
        PublishedPath {
            oversampling: 4,
            ..usual
        },
        PublishedPath {
            least_visible: 9,
            depth_tolerance: 0.0,
            ..usual
        },
        PublishedPath {
            speck_area: 1e9,
            ..usual
        },
        PublishedPath {
            thin_speck_area: 1e9,
            thinness: 1e9,
            ..usual
        },
        PublishedPath {
            smooth_places: false,
            ..usual
        },
        PublishedPath {
            smooth_radius: 4,
            ..usual
        },
        PublishedPath {
            smooth_sigma: 1.0,
            ..usual
        },
        PublishedPath {
            smooth_passes: 0,
            ..usual
        },
        PublishedPath {
            short: 100_000,
            ..usual
        },
    ];
    for path in others {
        assert!(with(path) != plain, "{path:?}");
    }
    // These decide which sides are culled where curves meet.
    let of_cube = |path: PublishedPath| {
        strokes(
            &shape_of(&cube()),
            &perspective([3.0, 4.0, 5.0]),
            [200, 160],
            &path,
        )
    };
    let culls = [
        PublishedPath {
            fit_radius: 64,
            ..usual
        },
        PublishedPath {
            tangent_radius: 64,
            tangent_sigma: 30.0,
            ..usual
        },
        PublishedPath {
            tangent_sigma: 1.0,
            ..usual
        },
        PublishedPath {
            tangent_passes: 16,
            ..usual
        },
        PublishedPath {
            direction_radius: 2,
            ..usual
        },
        PublishedPath {
            direction_sigma: 1.0,
            ..usual
        },
        PublishedPath {
            least_cos: 0.9,
            ..usual
        },
        PublishedPath {
            vote_radius: 0,
            ..usual
        },
        PublishedPath {
            vote_margin: 15,
            ..usual
        },
    ];
    for path in culls {
        assert!(of_cube(path) != of_cube(usual), "{path:?}");
    }
    let alike = PublishedPath {
        rounds: 16,
        ..usual
    };
    assert!(with(alike) == plain);
    let open = strokes(
        &shape,
        &perspective([0.0, 1.0, 4.0]),
        [200, 160],
        &PublishedPath {
            convex_only: false,
            ..usual
        },
    );
    assert!(open == plain, "a ball has no valleys");
}

#[test]
fn nothing_and_pictures_without_pixels_have_no_strokes() {
    let path = PublishedPath::default();
    assert!(
        strokes(
            &HalfEdgeMesh::default(),
            &perspective([0.0, 0.0, 4.0]),
            [30, 20],
            &path
        )
        .is_empty()
    );
    assert!(
        strokes(
            &shape_of(&cube()),
            &perspective([0.0, 0.0, 4.0]),
            [1, 1],
            &path
        )
        .is_empty()
    );
    let inside = strokes(
        &shape_of(&cube()),
        &perspective([0.0, 0.0, 0.1]),
        [64, 48],
        &path,
    );
    assert!(inside.iter().all(|stroke| stroke.points.len() > 1));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    /// Whatever the mesh, the camera and the constants: strokes lie in the picture, and threads change nothing.
    #[test]
    fn any_scene_gives_sound_strokes(
        seed: u64, faces in 0usize..30, eye in prop::array::uniform3(-4.0..4.0f32),
        size in prop::array::uniform2(1u32..60),
        numbers in prop::array::uniform6(0u32..100),
        reals in prop::array::uniform4(prop_oneof![-1.0..40.0f32, Just(f32::NAN)]),
    ) {
        let shape = if seed % 3 == 0 { shape_of(&icosphere(1)) } else { shape_of(&random_soup(faces, seed)) };
        let path = PublishedPath {
            oversampling: numbers[0] % 12,
            least_visible: numbers[1] % 12,
            smooth_radius: numbers[2],
            fit_radius: numbers[3],
            vote_radius: numbers[4],
            short: numbers[5] % 9,
            speck_area: reals[0],
            smooth_sigma: reals[1],
            depth_tolerance: reals[2],
            least_cos: reals[3] / 40.0,
            ..PublishedPath::default()
        };
        let found = strokes(&shape, &perspective(eye), size, &path);
        for stroke in &found {
            prop_assert!(stroke.points.len() >= 2);
            for point in &stroke.points {
                let is_inside = |i| (-0.1..f64::from(size[i]) + 0.1).contains(&point.position[i]);
                prop_assert!((0..2).all(is_inside), "{:?}", point.position);
            }
        }
    }
}
