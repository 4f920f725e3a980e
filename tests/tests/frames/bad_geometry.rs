//! Shapes, cameras and frames that go wrong: no panic, and pixels or an error come out.

#[cfg(feature = "gpu")]
mod device;

use npr_core::camera::{Camera, Projection};
use npr_gpu::engine::Engine;
use npr_gpu::processor::Processor;
use npr_mesh::Mesh;
use npr_mesh::testing::{
    cube, fan, icosphere, moebius_strip, plane, random_soup, random_winding, torus, with_doubles,
};
use npr_render::{Frame, Model, RenderError, Renderer, RendererOptions};
use npr_scene::{Node, Part, Scene};
use npr_stylesheet::Style;
use npr_tests::{Ink, Object, boxed, draw, draw_on, lines, placed, scene_of};

const SIZE: [u32; 2] = [64, 48];

/// Styles that between them run every pass.
fn styles() -> Vec<Style> {
    let mut coarse = lines("shape");
    coarse.set("detect.scale=3").unwrap();
    coarse.set("line.width.source=projected-curvature").unwrap();
    let presets = ["toon", "okuya", "filter-hull"].map(|name| Style::preset(name).unwrap());
    presets
        .into_iter()
        .chain([coarse, lines("angle"), lines("edges")])
        .collect()
}

/// Draws a mesh in every style and answers with the frames.
fn draw_all(engine: &dyn Engine, scene: &Scene, camera: &Camera) -> Vec<Frame> {
    let model = Model::new(scene).unwrap();
    let frames = styles()
        .into_iter()
        .map(|style| draw_on(engine, &model, &style, camera, SIZE));
    frames.collect()
}

/// Directions to the faces, edges and corners of a cube.
fn directions() -> impl Iterator<Item = [f32; 3]> {
    let steps = [-1.0, 0.0, 1.0];
    let all = steps.into_iter().flat_map(move |x| {
        steps
            .into_iter()
            .flat_map(move |y| steps.map(|z| [x, y, z]))
    });
    all.filter(|direction| *direction != [0.0; 3])
}

fn camera_at(eye: [f32; 3], target: [f32; 3]) -> Camera {
    Camera {
        eye,
        target,
        up: [0.0, 1.0, 0.0],
        projection: Projection::Perspective { fov_y: 0.8 },
    }
}

/// Meshes with folds, degenerate faces, fans, doubles, pinches and nothing at all.
fn torture() -> Vec<(&'static str, Mesh)> {
    let points = |positions: &[[f32; 3]], triangles: &[[u32; 3]]| {
        Mesh::new(positions.to_vec(), triangles.to_vec()).unwrap()
    };
    let degenerate_face = [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1e-7, 0.0], [0.5, 0.0, 0.0]];
    vec![
        ("nothing", Mesh::default()),
        ("vertices alone", points(&degenerate_face, &[])),
        ("a point thrice", points(&[[0.3; 3]], &[[0, 0, 0]])),
        (
            "no area",
            points(&degenerate_face, &[[0, 1, 3], [0, 1, 1], [0, 1, 2]]),
        ),
        ("a degenerate_face", points(&degenerate_face, &[[0, 1, 2]])),
        (
            "one triangle twice, one turned",
            points(
                &[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
                &[[0, 1, 2], [0, 1, 2], [0, 2, 1]],
            ),
        ),
        ("a fan of seven", fan(7)),
        ("a half twist", moebius_strip(9)),
        ("soup", random_soup(90, 5)),
        ("random winding", random_winding(&icosphere(2), 3)),
        ("doubles", with_doubles(&torus(12, 8, 0.7, 0.3), 2)),
        (
            "a shell in a shell",
            placed(&with_doubles(&cube(), 4), [0.5; 3], [0.0; 3]),
        ),
        ("far off", placed(&cube(), [1e-3; 3], [1e5, 0.0, 0.0])),
        ("huge", placed(&icosphere(1), [1e15; 3], [0.0; 3])),
        ("tiny", placed(&icosphere(1), [1e-15; 3], [0.0; 3])),
    ]
}

#[test]
fn torture_meshes_are_drawn_from_26_directions() {
    for (name, mesh) in torture() {
        let scene = scene_of(&[Object::new(name, mesh)]);
        let radius = Model::new(&scene).unwrap().radius();
        let (low, high) = Model::new(&scene).unwrap().bounds();
        let middle: [f32; 3] = std::array::from_fn(|i| (low[i] + high[i]) * 0.5);
        for direction in directions() {
            let eye = std::array::from_fn(|i| middle[i] + direction[i] * 2.0 * radius);
            let frames = draw_all(&Processor, &scene, &camera_at(eye, middle));
            assert!(
                frames
                    .iter()
                    .all(|frame| frame.rgba.chunks(4).all(|pixel| pixel[3] == 255)),
                "{name}"
            );
        }
    }
}

#[test]
fn a_scene_without_meshes_is_paper() {
    for scene in [
        Scene::default(),
        scene_of(&[]),
        scene_of(&[Object::new("Empty", Mesh::default())]),
    ] {
        let frame = draw(&scene, &lines("shape"), SIZE);
        assert!(frame.rgba.iter().all(|byte| *byte == 255));
    }
}

#[test]
fn numbers_that_are_none_do_no_harm() {
    for bad in [
        f32::NAN,
        f32::INFINITY,
        f32::NEG_INFINITY,
        f32::MAX,
        -f32::MAX,
    ] {
        let part = Part {
            positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, bad, 0.0], [bad; 3]],
            normals: Some(vec![[bad; 3]; 4]),
            uvs: Some(vec![[bad; 2]; 4]),
            triangles: vec![[0, 1, 2], [1, 2, 3], [3, 3, 3]],
            ..Part::default()
        };
        let scene = Scene {
            nodes: vec![Node {
                mesh: Some(0),
                ..Node::default()
            }],
            meshes: vec![npr_scene::Mesh {
                parts: vec![part],
                ..npr_scene::Mesh::default()
            }],
            ..Scene::default()
        };
        assert_eq!(
            draw_all(&Processor, &scene, &camera_at([0.0, 0.0, 3.0], [0.0; 3])).len(),
            styles().len()
        );
    }
}

/// Cameras inside, beside and against a unit box, and cameras that are none.
fn odd_cameras() -> Vec<Camera> {
    let plain = camera_at([0.0, 0.0, 4.0], [0.0; 3]);
    let bad = [f32::NAN, f32::INFINITY];
    let mut cameras = vec![
        camera_at([0.0; 3], [0.0, 0.0, -1.0]),
        camera_at([0.9, 0.9, 0.99], [0.0; 3]),
        camera_at([0.0, 0.0, 1.0], [0.0; 3]),
        camera_at([0.0, 0.0, 4.0], [0.0, 0.0, 9.0]),
        camera_at([0.0, 0.0, 4.0], [0.0, 0.0, 4.0]),
        camera_at([0.0, 4.0, 0.0], [0.0; 3]),
        Camera {
            up: [0.0; 3],
            ..plain
        },
        Camera {
            projection: Projection::Parallel { height: 0.0 },
            ..plain
        },
        Camera {
            projection: Projection::Parallel { height: 4.0 },
            eye: [0.0; 3],
            ..plain
        },
        Camera {
            projection: Projection::Perspective { fov_y: 3.1 },
            ..plain
        },
        Camera {
            projection: Projection::Perspective { fov_y: 1e-6 },
            ..plain
        },
    ];
    cameras.extend(bad.map(|v| Camera {
        eye: [v, 0.0, 0.0],
        ..plain
    }));
    cameras.extend(bad.map(|v| Camera {
        target: [0.0, v, 0.0],
        ..plain
    }));
    cameras.extend(bad.map(|v| Camera {
        projection: Projection::Perspective { fov_y: v },
        ..plain
    }));
    cameras
}

#[test]
fn odd_cameras_draw_something_or_nothing() {
    let floor = placed(&plane(3, 3), [50.0, 50.0, 1.0], [-25.0, -25.0, -0.5]);
    let scene = scene_of(&[
        Object::new("Box", boxed([-1.0; 3], [1.0; 3])),
        Object::new("Floor", floor),
    ]);
    for camera in odd_cameras() {
        assert_eq!(
            draw_all(&Processor, &scene, &camera).len(),
            styles().len(),
            "{camera:?}"
        );
    }
}

#[test]
fn edges_through_the_near_plane_end_there() {
    // The beam runs from before the eye to behind it, half a unit to its right.
    let beam = scene_of(&[Object::new(
        "Beam",
        boxed([0.5, -0.2, -30.0], [0.9, 0.2, 30.0]),
    )]);
    let model = Model::new(&beam).unwrap();
    let frame = draw_on(
        &Processor,
        &model,
        &lines("shape"),
        &camera_at([0.0; 3], [0.0, 0.0, -1.0]),
        [160, 120],
    );
    let ink = Ink::of(&frame);
    assert!(ink.count() > 100);
    assert!(
        ink.centers().all(|center| center[0] > 80.0),
        "nothing is mirrored to the left"
    );
}

#[test]
fn a_mesh_smaller_than_a_pixel_leaves_at_most_a_dot() {
    let speck = scene_of(&[Object::new(
        "Speck",
        placed(&icosphere(2), [1e-3; 3], [0.0; 3]),
    )]);
    let model = Model::new(&speck).unwrap();
    for style in styles() {
        let frame = draw_on(
            &Processor,
            &model,
            &style,
            &camera_at([0.0, 0.0, 5.0], [0.0; 3]),
            SIZE,
        );
        let marked = frame
            .rgba
            .chunks(4)
            .filter(|pixel| pixel[..3] != frame.rgba[..3]);
        assert!(marked.count() <= 64);
    }
}

#[test]
fn frames_have_a_least_and_a_largest_size() {
    let model = Model::new(&scene_of(&[Object::new("Box", cube())])).unwrap();
    let camera = model.framing(1.0, 0.7);
    let renderer = |size| {
        Renderer::new(
            &Processor,
            &model,
            &lines("shape"),
            &RendererOptions::new(size),
        )
    };
    for size in [[0, 0], [0, 5], [5, 0]] {
        assert!(
            matches!(renderer(size).err(), Some(RenderError::EmptyFrame { .. })),
            "{size:?}"
        );
    }
    for size in [[40_000, 10], [10, 40_000], [u32::MAX, u32::MAX]] {
        assert!(
            matches!(
                renderer(size).err(),
                Some(RenderError::FrameTooLarge { .. })
            ),
            "{size:?}"
        );
    }
    for size in [[1, 1], [1, 90], [90, 1], [2, 3], [20_000, 2]] {
        let frame = renderer(size).unwrap().draw(&camera).unwrap();
        assert_eq!(frame.rgba.len(), (size[0] * size[1] * 4) as usize);
    }
}

#[test]
fn a_plan_beyond_the_memory_limit_is_refused() {
    let model = Model::new(&scene_of(&[Object::new("Box", cube())])).unwrap();
    let options = RendererOptions {
        memory_limit: 1 << 20,
        ..RendererOptions::new([640, 360])
    };
    let refused = Renderer::new(&Processor, &model, &lines("shape"), &options);
    assert!(matches!(refused.err(), Some(RenderError::Memory(_))));
}
