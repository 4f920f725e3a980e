//! Speed lines along the way that things really moved, in frames and in drawings of lines.

use npr_drawing::artwork::ArtworkOptions;
use npr_drawing::drawing::rasterise;
use npr_gpu::engine::Engine;
use npr_gpu::processor::Processor;
use npr_mesh::testing::icosphere;
use npr_render::{
    Drawing, Frame, Kind, LineModel, LineModelOptions, LineOptions, LineRenderer, Model, Movement,
    RenderError, Renderer, RendererOptions, Subject,
};
use npr_scene::Scene;
use npr_stylesheet::Style;
use npr_tests::comic::{SIZE, front, pixel, style, wall};
use npr_tests::{Object, boxed, device, placed, scene_of};
use npr_vector::stroke::Stroke;
use std::sync::Arc;

/// A wall, a ball that moves before it, and a rock that stands still.
fn scene() -> Scene {
    scene_of(&[
        Object::new("Wall", wall(2.0, -1.0)),
        Object::new("Ball", placed(&icosphere(4), [0.4; 3], [0.0; 3])),
        Object::new("Rock", placed(&icosphere(4), [0.2; 3], [-0.6, -0.7, 0.0])),
    ])
}

/// Style keys of every test: a full second is followed.
fn following(settings: &[&str]) -> Style {
    let common = [
        "motion.shutter=0.25",
        "motion.follow=4",
        "motion.spacing=8px",
        "motion.least=6px",
    ];
    style(&[&common, settings].concat())
}

/// The scene with its ball where `way` has it so many seconds before, and where all of it was.
fn moved(style: &Style, way: impl Fn(f32) -> [f32; 3]) -> (Scene, Option<Arc<Movement>>) {
    let mut scene = scene();
    let stand = |scene: &mut Scene, seconds: f32| {
        let [x, y, z] = way(seconds);
        scene.nodes[1].world_from_node[3] = [x, y, z, 1.0];
    };
    stand(&mut scene, 0.0);
    let movement = Movement::of_style(&mut scene, (style, u64::MAX), stand).unwrap();
    (scene, movement)
}

fn frame_on(engine: &dyn Engine, style: &Style, way: impl Fn(f32) -> [f32; 3]) -> Frame {
    let (scene, movement) = moved(style, way);
    let model = Model::new(&scene).unwrap();
    let options = RendererOptions::new(SIZE);
    let mut renderer = Renderer::new(engine, &model, style, &options).unwrap();
    renderer.set_movement(movement);
    renderer.draw(&front()).unwrap()
}

fn drawing(style: &Style, way: impl Fn(f32) -> [f32; 3]) -> Drawing {
    let (scene, movement) = moved(style, way);
    let lines = LineModel::for_style(&scene, style, &LineModelOptions::default(), None).unwrap();
    let mut renderer = LineRenderer::new(&Processor, &lines);
    renderer.set_movement(movement);
    let options = LineOptions::of_style(style, SIZE);
    renderer.draw(&front(), style, &options).unwrap()
}

/// The speed lines of a drawing.
fn trails(drawing: &Drawing) -> Vec<&Stroke> {
    let surface = |stroke: &Stroke| &drawing.surfaces[stroke.surface as usize];
    let strokes = drawing.strokes.iter();
    strokes
        .filter(|stroke| surface(stroke).object == "speed lines")
        .collect()
}

/// From the left to where it stands, to the right of the middle.
fn from_the_left(seconds: f32) -> [f32; 3] {
    [0.5 - 1.2 * seconds, 0.3, 0.0]
}

fn still(_: f32) -> [f32; 3] {
    from_the_left(0.0)
}

/// Places where two pictures differ.
fn changed(a: &Frame, b: &Frame) -> Vec<[u32; 2]> {
    let all = (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| [x, y]));
    all.filter(|[x, y]| pixel(a, *x, *y) != pixel(b, *x, *y))
        .collect()
}

#[test]
fn lines_follow_what_moved_and_nothing_else() {
    let style = following(&[]);
    let lines = drawing(&style, from_the_left);
    let found = trails(&lines);
    assert!(found.len() >= 6, "{}", found.len());
    // The ball's middle shows at (208, 91), and its radius is 38 pixels: it came along 115 of them.
    for stroke in &found {
        assert_eq!(stroke.kind, Kind::Marked);
        let [first, last] = [stroke.points[0], stroke.points[stroke.points.len() - 1]];
        assert!(first.position[0] < 215.0, "{first:?}");
        assert!(last.position[0] < first.position[0] - 5.0);
        assert!((first.position[1] - last.position[1]).abs() < 0.5, "level");
        assert!(last.position[0] > 50.0, "{last:?}");
        assert!((53.0..130.0).contains(&first.position[1]));
        assert_eq!(last.width, 0.0);
    }
    let material = &lines.surfaces[found[0].surface as usize].material;
    assert_eq!(material, "Ball");
    assert!(trails(&drawing(&style, still)).is_empty());
    let unlike = Style::default();
    assert!(trails(&drawing(&unlike, from_the_left)).is_empty());

    // Lines differ in length and width, and no two lie at one place.
    let lengths: Vec<f64> = found.iter().map(|stroke| stroke.length()).collect();
    let [least, most] = [f64::min, f64::max].map(|of| lengths.iter().copied().reduce(of).unwrap());
    assert!(most > 1.5 * least, "{lengths:?}");
}

#[test]
fn frames_and_files_have_the_same_lines() {
    let style = following(&["motion.color=#ff0000", "line.method='none'"]);
    let frame = frame_on(&Processor, &style, from_the_left);
    let plain = frame_on(&Processor, &style, still);
    let lines = drawing(&style, from_the_left);
    let mut alone = lines.clone();
    let is_trail: Vec<u64> = trails(&lines).iter().map(|stroke| stroke.id).collect();
    alone.strokes.retain(|stroke| is_trail.contains(&stroke.id));
    let file = rasterise(&alone, &ArtworkOptions::default());

    // What is inked in one is inked in the other, and nothing else of the frame changes.
    let mut count = 0;
    for (i, ink) in file.chunks_exact(4).enumerate() {
        let [x, y] = [i as u32 % SIZE[0], i as u32 / SIZE[0]];
        let [before, after] = [pixel(&plain, x, y), pixel(&frame, x, y)];
        if ink[3] == 0 {
            assert_eq!(before, after, "{x} {y}");
        }
        if ink[3] > 200 {
            count += 1;
            assert!(after[0] > 200 && after[1] < 60, "{x} {y}: {after:?}");
        }
    }
    assert!(count > 50, "{count}");
}

#[test]
fn nothing_is_drawn_over_what_moves_or_stands_before_it() {
    let style = following(&[]);
    let [frame, plain] = [
        frame_on(&Processor, &style, from_the_left),
        frame_on(&Processor, &style, still),
    ];
    let on_ball = |place: &[u32; 2]| {
        let [x, y] = [0, 1].map(|i| place[i] as f32 + 0.5 - [208.0, 91.2][i]);
        x * x + y * y < 36.0 * 36.0
    };
    assert_eq!(
        changed(&frame, &plain)
            .iter()
            .filter(|place| on_ball(place))
            .count(),
        0
    );

    // A slab before the way, which stands still, cuts the lines.
    let slab = Object::new("Slab", boxed([-0.3, -0.4, 0.9], [-0.1, 1.0, 1.0]));
    let mut scene = scene_of(&[
        Object::new("Ball", placed(&icosphere(4), [0.4; 3], [0.0; 3])),
        slab,
    ]);
    let movement = Movement::of_style(&mut scene, (&style, u64::MAX), |scene, seconds| {
        let [x, y, z] = from_the_left(seconds);
        scene.nodes[0].world_from_node[3] = [x, y, z, 1.0];
    });
    let lines = LineModel::for_style(&scene, &style, &LineModelOptions::default(), None).unwrap();
    let mut renderer = LineRenderer::new(&Processor, &lines);
    renderer.set_movement(movement.unwrap());
    let options = LineOptions::of_style(&style, SIZE);
    let lines = renderer.draw(&front(), &style, &options).unwrap();
    let found = trails(&lines);
    let points = found.iter().flat_map(|stroke| &stroke.points);
    let on_slab = |x: f64| (132.5..149.5).contains(&x);
    assert_eq!(points.filter(|point| on_slab(point.position[0])).count(), 0);
    let ends_behind =
        |stroke: &&&Stroke| stroke.points[stroke.points.len() - 1].position[0] < 132.0;
    assert!(
        found.iter().filter(ends_behind).count() > 2,
        "they go on behind it"
    );
}

#[test]
fn lines_bend_with_the_way() {
    // Around the middle of the picture: every point of the ball's rim keeps the ball's way, shifted.
    let around = |seconds: f32| {
        let angle = 1.5 * seconds;
        [
            0.8 * npr_core::math::cos(angle),
            0.8 * npr_core::math::sin(angle) - 0.2,
            0.0,
        ]
    };
    let lines = drawing(&following(&["motion.variation=0"]), around);
    let found = trails(&lines);
    assert!(found.len() >= 4);
    for stroke in found {
        // Their ends and middles lie on a circle of 0.8 x 96 pixels.
        let at = |share: f64| {
            let last = stroke.points.len() - 1;
            stroke.points[(share * last as f64) as usize].position
        };
        let [a, b, c] = [at(0.0), at(0.5), at(1.0)];
        let side = |p: [f64; 2], q: [f64; 2]| (p[0] - q[0]).hypot(p[1] - q[1]);
        let area = 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).abs();
        let radius = side(a, b) * side(b, c) * side(c, a) / (4.0 * area);
        assert!((60.0..95.0).contains(&radius), "{radius}");
    }
}

#[test]
fn lines_lag_behind_on_the_trailing_side() {
    // A shutter of a quarter of a second is 28.8 pixels of way.
    let of = |smear: &str| {
        let style = following(&["motion.follow=0", smear]);
        let drawing = drawing(&style, from_the_left);
        let ball = drawing
            .surfaces
            .iter()
            .position(|surface| surface.object == "Ball");
        let ball = ball.unwrap() as u32;
        let strokes = drawing
            .strokes
            .iter()
            .filter(|stroke| stroke.surface == ball);
        let points = strokes.flat_map(|stroke| &stroke.points);
        let places: Vec<[f64; 2]> = points.map(|point| point.position).collect();
        let x = places.iter().map(|place| place[0]);
        let y = places.iter().map(|place| place[1]);
        [
            x.clone().fold(f64::MAX, f64::min),
            x.fold(f64::MIN, f64::max),
            y.fold(f64::MIN, f64::max),
        ]
    };
    let [plain, smeared] = ["motion.smear=0", "motion.smear=2"].map(of);
    assert!(
        (plain[0] - smeared[0] - 57.6).abs() < 1.0,
        "{plain:?} {smeared:?}"
    );
    assert!(
        (plain[1] - smeared[1]).abs() < 0.5,
        "the leading side stays: {smeared:?}"
    );
    assert!(
        (plain[2] - smeared[2]).abs() < 0.5,
        "it goes level: {smeared:?}"
    );
}

/// Of a ball that goes 28.8 pixels a shutter, and a tenth of the picture's height is 18 and more.
#[test]
fn lines_swell_with_their_speed() {
    let widths = |keys: &[&str], way: fn(f32) -> [f32; 3]| {
        let own = ["motion.follow=0", "line.width.source=constant"];
        let style = following(&[&own, keys].concat());
        let drawing = drawing(&style, way);
        let mut widths = [f64::MAX, 0.0];
        for stroke in &drawing.strokes {
            let surface = &drawing.surfaces[stroke.surface as usize];
            if surface.object == "Ball" && stroke.is_visible() {
                for point in &stroke.points {
                    widths = [widths[0].min(point.width), widths[1].max(point.width)];
                }
            }
        }
        widths
    };
    let plain = widths(&["motion.swell=0"], from_the_left);
    let is_near = |[a, b]: [f64; 2], by: f64| {
        (a - by * plain[0]).abs() < 1e-3 * a && (b - by * plain[1]).abs() < 1e-3 * b
    };
    assert!(is_near(widths(&["motion.swell=1"], from_the_left), 2.0));
    assert!(is_near(widths(&["motion.swell=-0.5"], from_the_left), 0.5));
    assert!(is_near(widths(&["motion.swell=1"], still), 1.0));
    // A quarter of the shutter is a quarter of the way, 7.2 pixels.
    let slow = widths(&["motion.swell=1", "motion.shutter=0.0625"], from_the_left);
    let share = 7.2 / (0.1 * f64::from(SIZE[1]));
    assert!(share < 0.5, "{share}");
    let off = (slow[1] / plain[1] - 1.0 - share).abs();
    assert!(off < 0.01, "{slow:?} of {plain:?}, not by {share}");
}

/// Frames have it on both engines.
#[test]
fn strokes_of_frames_swell_alike() {
    let ink = |engine: &dyn Engine, swell: &str| {
        let keys = [
            "motion.follow=0",
            "line.method='strokes'",
            "line.width.base=2px",
            "line.width.source=constant",
            swell,
        ];
        let style = following(&keys);
        let (scene, movement) = moved(&style, from_the_left);
        let subject = Subject::new(&scene, &style).unwrap();
        let options = RendererOptions::new(SIZE);
        let mut renderer = subject.renderer(engine, &style, &options).unwrap();
        renderer.set_movement(movement);
        let frame = renderer.draw(&front()).unwrap();
        let all = (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| [x, y]));
        all.filter(|[x, y]| pixel(&frame, *x, *y)[0] < 100).count()
    };
    let [plain, wide] = ["motion.swell=0", "motion.swell=2"].map(|swell| ink(&Processor, swell));
    assert!(wide > 3 * plain / 2, "{plain} {wide}");
    if let Some(device) = device() {
        assert!(ink(device, "motion.swell=2").abs_diff(wide) < 8);
    }
}

#[test]
fn frames_have_the_lag_of_files() {
    // The leftmost column that has ink of the ball's outline, in a frame of strokes and in a file.
    let leftmost = |smear: &str| {
        let keys = [
            "motion.follow=0",
            "line.method='strokes'",
            "line.width.base=4px",
            "line.width.source=constant",
            smear,
        ];
        let style = following(&keys);
        let (scene, movement) = moved(&style, from_the_left);
        let subject = Subject::new(&scene, &style).unwrap();
        let options = RendererOptions::new(SIZE);
        let mut renderer = subject.renderer(&Processor, &style, &options).unwrap();
        renderer.set_movement(movement);
        let frame = renderer.draw(&front()).unwrap();
        let drawing = drawing(&style, from_the_left);
        let file = rasterise(&drawing, &ArtworkOptions::default());
        let in_row = |is_ink: &dyn Fn(u32) -> bool| (0..SIZE[0]).find(|x| is_ink(*x)).unwrap();
        let row = 91;
        [
            in_row(&|x| pixel(&frame, x, row)[0] < 100),
            in_row(&|x| file[4 * (row * SIZE[0] + x) as usize + 3] > 150),
        ]
    };
    let [plain, smeared] = ["motion.smear=0", "motion.smear=2"].map(leftmost);
    assert!(plain[0].abs_diff(plain[1]) <= 1, "{plain:?}");
    assert!(smeared[0].abs_diff(smeared[1]) <= 1, "{smeared:?}");
    assert!(smeared[0] + 50 < plain[0], "{plain:?} {smeared:?}");
}

#[test]
fn after_images_stand_where_it_was() {
    let keys = [
        "motion.follow=0",
        "motion.ghosts=2",
        "motion.ghost_gap=1.5",
        "line.method='none'",
    ];
    let style = following(&keys);
    let lines = drawing(&style, from_the_left);
    let of = |number: &str| -> Vec<&Stroke> {
        let is_it = |stroke: &&Stroke| {
            let surface = &lines.surfaces[stroke.surface as usize];
            surface.object == "after-images" && surface.material == number
        };
        lines.strokes.iter().filter(is_it).collect()
    };
    // They were 43.2 pixels apart, and the ball's radius is 38.4.
    let widest = |strokes: &[&Stroke]| {
        let points = strokes.iter().flat_map(|stroke| &stroke.points);
        points.map(|point| point.width).fold(0.0, f64::max)
    };
    let [latest, oldest] = ["1", "2"].map(of);
    for (number, strokes) in [(1.0, &latest), (2.0, &oldest)] {
        assert!(!strokes.is_empty(), "{number}");
        let middle = [208.0 - 43.2 * number, 91.2];
        for point in strokes.iter().flat_map(|stroke| &stroke.points) {
            let [x, y] = [0, 1].map(|i| point.position[i] - middle[i]);
            assert!(
                (x.hypot(y) - 38.4).abs() < 1.0,
                "{number}: {:?}",
                point.position
            );
            assert!(x < 20.0, "the later one lies over it");
        }
    }
    assert!(widest(&latest) > 1.1 * widest(&oldest));
    let alpha = |strokes: &[&Stroke]| strokes[0].points[0].color.unwrap()[3];
    assert!(alpha(&latest) > alpha(&oldest));

    // Frames have them, too.
    let plain = following(&["motion.follow=0", "line.method='none'"]);
    let [ghosts, none] = [&style, &plain].map(|style| frame_on(&Processor, style, from_the_left));
    let changed = changed(&ghosts, &none);
    assert!(changed.len() > 60);
    assert!(changed.iter().all(|[x, _]| *x < 195));
}

#[test]
fn cuts_and_numbers_that_are_none_leave_nothing_or_short_lines() {
    let style = following(&["motion.smear=4", "motion.ghosts=3"]);
    let ways: [fn(f32) -> [f32; 3]; 5] = [
        |seconds| [if seconds > 0.0 { 1e30 } else { 0.5 }, 0.3, 0.0],
        |seconds| [0.5, if seconds > 0.4 { f32::NAN } else { 0.3 }, 0.0],
        |seconds| [if seconds > 0.1 { -40.0 } else { 0.5 }, 0.3, 0.0],
        |seconds| [0.5, 0.3, 1e9 * seconds],
        |seconds| [0.5 - 9.0 * seconds, 0.3, f32::INFINITY * seconds.max(0.0)],
    ];
    for (i, way) in ways.into_iter().enumerate() {
        let lines = drawing(&style, way);
        for stroke in trails(&lines) {
            assert!(stroke.length() < f64::from(SIZE[1]), "{i}");
            assert!(
                stroke
                    .points
                    .iter()
                    .all(|point| point.position.iter().all(|v| v.is_finite()))
            );
        }
        let _ = frame_on(&Processor, &style, way);
    }
}

#[test]
fn both_engines_have_the_same_lines() {
    let Some(device) = device() else { return };
    let style = following(&["line.method='none'", "motion.ghosts=2"]);
    let of = |engine: &dyn Engine| {
        let frames = [
            frame_on(engine, &style, from_the_left),
            frame_on(engine, &style, still),
        ];
        changed(&frames[0], &frames[1])
    };
    let ours = of(&Processor);
    assert!(ours.len() > 100 && ours == of(device), "{}", ours.len());
}

/// Where everything was counts towards the limit of memory: 12 bytes for each vertex and moment.
#[test]
fn motion_beyond_the_limit_of_memory_is_refused() {
    let style = following(&[]);
    let vertices: usize = scene()
        .meshes
        .iter()
        .flat_map(|mesh| &mesh.parts)
        .map(|part| part.positions.len())
        .sum();
    let moved = |memory_limit| {
        let mut scene = scene();
        let movement = Movement::of_style(&mut scene, (&style, memory_limit), |scene, seconds| {
            scene.nodes[1].world_from_node[3] = [seconds, 0.0, 0.0, 1.0];
        });
        movement.map(|movement| movement.is_some())
    };
    // Eight moments, and both where they are now and where they lie in their meshes.
    let bytes = (vertices * 12 * 10) as u64;
    assert!(matches!(moved(bytes), Ok(true)));
    assert!(matches!(moved(bytes - 1), Err(RenderError::Memory(_))));
}
