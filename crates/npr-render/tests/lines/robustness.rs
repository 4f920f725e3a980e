//! Anything that loads can be drawn, the same way every time.

use crate::scenes::{SIZE, camera_at, even_style, model_of, scene_of};
use npr_core::camera::{Camera, Projection};
use npr_mesh::testing::{cube, icosphere, mapped, random_soup, torus};
use npr_render::{Drawing, LineModel, LineModelOptions, LineOptions, LineSource, RenderError};
use npr_scene::Scene;
use npr_stylesheet::Style;
use proptest::prelude::*;

/// Asserts what every drawing promises.
fn check(drawing: &Drawing) {
    let room = f64::from(SIZE[0]);
    for stroke in &drawing.strokes {
        assert!(stroke.points.len() >= if stroke.closed { 3 } else { 2 });
        assert!((stroke.surface as usize) < drawing.surfaces.len());
        for point in &stroke.points {
            let [x, y] = point.position;
            assert!(
                x.is_finite() && y.is_finite() && point.depth.is_finite() && point.u.is_finite()
            );
            assert!(point.width.is_finite() && point.width >= 0.0);
            assert!(point.world.iter().all(|v| v.is_finite()));
            assert!(
                x > -room && x < 2.0 * room && y > -room && y < 2.0 * room,
                "{x} {y}"
            );
        }
    }
}

fn draw(model: &LineModel, camera: &Camera, options: &LineOptions) -> Drawing {
    let drawing = model
        .draw(camera, &Style::default(), options)
        .expect("a drawing");
    check(&drawing);
    drawing
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn any_soup_is_drawn_from_anywhere(
        faces in 0usize..40, seed: u64, eye in prop::array::uniform3(-4f32..4.0),
        target in prop::array::uniform3(-1f32..1.0), scale in -18i32..12, parallel: bool, surface: bool,
        smooth: bool, hidden: bool,
    ) {
        let factor = 10f32.powi(scale);
        let soup = mapped(&random_soup(faces, seed), |p| p.map(|v| v * factor));
        let projection = if parallel {
            Projection::Parallel { height: 5.0 * factor }
        } else {
            Projection::Perspective { fov_y: 1.0 }
        };
        let [eye, target] = [eye, target].map(|p| p.map(|v| v * factor));
        let camera = Camera { eye, target, up: [0.0, 1.0, 0.0], projection };
        let method = if surface { LineSource::Surface } else { LineSource::Edges };
        let options = LineOptions { method, smooth, hidden, ..LineOptions::new(SIZE) };
        draw(&model_of(&scene_of(&soup)), &camera, &options);
    }
}

#[test]
fn nothing_to_see_gives_an_empty_drawing() {
    let options = LineOptions {
        fill: true,
        ..LineOptions::new(SIZE)
    };
    let empty = model_of(&Scene::default());
    assert!(
        draw(&empty, &empty.framing(1.6, 0.7), &options)
            .strokes
            .is_empty()
    );

    let ball = model_of(&scene_of(&icosphere(2)));
    let behind = Camera {
        target: [0.0, 0.0, 20.0],
        ..camera_at([0.0, 0.0, 10.0])
    };
    assert!(draw(&ball, &behind, &options).strokes.is_empty());
    draw(&ball, &camera_at([0.0, 0.0, 0.2]), &options);
    draw(&ball, &camera_at([0.0, 0.0, 1e6]), &options);
    draw(&ball, &camera_at([0.0; 3]), &options);
}

#[test]
fn a_frame_needs_pixels() {
    let model = model_of(&scene_of(&cube()));
    for size in [[0, 5], [5, 0], [40_000, 5]] {
        let drawn = model.draw(
            &camera_at([0.0, 0.0, 5.0]),
            &Style::default(),
            &LineOptions::new(size),
        );
        assert!(drawn.is_err(), "{size:?}");
    }
    for size in [[1, 1], [1, 300], [300, 1]] {
        let options = LineOptions::new(size);
        let drawn = model.draw(&camera_at([3.0, 2.0, 5.0]), &Style::default(), &options);
        assert!(drawn.is_ok(), "{size:?}");
    }
}

#[test]
fn memory_is_planned_before_it_is_taken() {
    let options = LineModelOptions {
        memory_limit: 1000,
        ..LineModelOptions::default()
    };
    let refused = LineModel::new(&scene_of(&cube()), &options);
    assert!(matches!(refused, Err(RenderError::Memory(_))));
}

#[test]
fn drawings_do_not_depend_on_threads_or_on_what_was_drawn_before() {
    let scene = scene_of(&torus(48, 24, 1.0, 0.45));
    let camera = camera_at([1.5, 2.0, 3.0]);
    let wanted = LineOptions {
        hidden: true,
        fill: true,
        ..LineOptions::new(SIZE)
    };
    let with_threads = |count: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(count)
            .build()
            .expect("threads");
        pool.install(|| draw(&model_of(&scene), &camera, &wanted))
    };
    let first = with_threads(1);
    assert!(first.strokes.len() > 2);
    for count in [2, 8] {
        assert_eq!(with_threads(count), first, "{count} threads");
    }
    let model = model_of(&scene);
    for run in 0..20 {
        let other = LineOptions {
            crease: 0.1,
            hidden: run % 2 == 0,
            ..LineOptions::new(SIZE)
        };
        model
            .draw(&camera_at([0.5, 3.0, 1.0]), &even_style("1px"), &other)
            .expect("drawn");
        assert_eq!(draw(&model, &camera, &wanted), first, "run {run}");
    }
}
