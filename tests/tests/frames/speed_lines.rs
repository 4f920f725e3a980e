//! Speed lines behind parts that move, on the processor.

use npr_core::camera::{Camera, Projection};
use npr_gpu::processor::Processor;
use npr_mesh::testing::icosphere;
use npr_render::{Frame, Model, RendererOptions};
use npr_scene::Scene;
use npr_stylesheet::Style;
use npr_tests::comic::{SIZE, direction, front, pixel, style, wall};
use npr_tests::{Object, draw_with, placed, scene_of};

/// A ball before a wall, and one that stands still.
fn scene() -> Scene {
    scene_of(&[
        Object::new("Wall", wall(2.0, -1.0)),
        Object::new("Ball", placed(&icosphere(4), [0.4; 3], [-0.6, 0.3, 0.0])),
        Object::new("Rock", placed(&icosphere(4), [0.3; 3], [-0.6, -0.7, 0.0])),
    ])
}

fn moving(settings: &[&str], rule: &str) -> Style {
    let mut style = style(settings);
    let rule = format!("[[rule]]\nmatch.object = 'Ball'\n{rule}\n");
    style.rule = Style::from_toml(&rule, &|_| Err(String::new()))
        .unwrap()
        .rule;
    style
}

fn drawn(settings: &[&str], rule: &str) -> Frame {
    let model = Model::new(&scene()).unwrap();
    let options = RendererOptions::new(SIZE);
    draw_with(
        &Processor,
        &model,
        &moving(settings, rule),
        &front(),
        &options,
    )
}

/// Share of black in columns and rows of a picture.
fn black(frame: &Frame, x: std::ops::Range<u32>, y: std::ops::Range<u32>) -> f32 {
    let count = (x.len() * y.len()) as f32;
    let places = x.flat_map(|x| y.clone().map(move |y| (x, y)));
    places
        .filter(|(x, y)| pixel(frame, *x, *y)[0] < 100)
        .count() as f32
        / count
}

#[test]
fn lines_trail_behind_what_moves_and_thin_out() {
    let frame = drawn(&["motion.spacing=6px"], "motion.trail = [1.5, 0, 0]");
    // The ball's middle shows at (102, 91) with a radius of 38 pixels; its trail is 144 pixels long.
    let rows = 65..118;
    let columns = [145..160, 185..200, 230..245];
    let [near, middle, far] = columns.map(|x| black(&frame, x, rows.clone()));
    assert!(near > 0.25 && near < 0.75, "{near}");
    assert!(middle < near && far < middle, "{near} {middle} {far}");
    assert_eq!(black(&frame, 80..125, 75..105), 0.0, "the ball itself");
    assert_eq!(black(&frame, 20..60, 70..110), 0.0, "before the ball");
    assert_eq!(black(&frame, 140..250, 150..200), 0.0, "behind the rock");
    let [across, _] = direction(&frame, 145..200, 65..118);
    assert!(across < -0.6, "lines lie level: {across}");
}

#[test]
fn what_stands_before_the_part_hides_its_lines() {
    // How many pixels of the post are drawn over, which shows where the trail passes, so far from the wall or the ball.
    let drawn_over = |depth: f32| {
        let post = placed(&icosphere(4), [0.15; 3], [0.2, 0.3, depth]);
        let objects = [
            Object::new("Wall", wall(2.0, -1.0)),
            Object::new("Ball", placed(&icosphere(4), [0.4; 3], [-0.6, 0.3, 0.0])),
            Object::new("Post", post),
        ];
        let model = Model::new(&scene_of(&objects)).unwrap();
        let of = |rule: &str| {
            let style = moving(&["motion.spacing=6px"], rule);
            draw_with(
                &Processor,
                &model,
                &style,
                &front(),
                &RendererOptions::new(SIZE),
            )
        };
        let (trailed, still) = (of("motion.trail = [1.5, 0, 0]"), of("line.on = false"));
        let middle = (172..186).flat_map(|x| (84..98).map(move |y| (x, y)));
        middle
            .filter(|(x, y)| pixel(&trailed, *x, *y) != pixel(&still, *x, *y))
            .count()
    };
    assert_eq!(drawn_over(1.0), 0, "lines go behind what stands before");
    assert!(drawn_over(-0.7) > 20, "lines go over what stands behind");
}

#[test]
fn a_trail_of_no_length_or_out_of_sight_draws_nothing() {
    let still = drawn(&[], "line.on = false");
    for trail in ["[0, 0, 0]", "[0, 0, -3]", "[1e9, 1e9, 1e9]"] {
        let frame = drawn(&[], &format!("motion.trail = {trail}"));
        assert_eq!(frame.rgba, still.rgba, "{trail}");
    }
}

#[test]
fn lines_run_past_the_eye() {
    let camera = Camera {
        eye: [0.0, 0.0, 3.0],
        projection: Projection::Perspective { fov_y: 0.9 },
        ..front()
    };
    let model = Model::new(&scene()).unwrap();
    let of = |trail: &str| {
        let style = moving(&["motion.spacing=6px"], &format!("motion.trail = {trail}"));
        let options = RendererOptions::new(SIZE);
        draw_with(&Processor, &model, &style, &camera, &options)
    };
    // From the ball past the right and the upper side of the eye: on the picture its lines run to the border.
    let [whole, still] = [of("[4, 0.4, 6]"), of("[0, 0, 0]")];
    let changed = |x: std::ops::Range<u32>| {
        let places = x.flat_map(|x| (0..SIZE[1]).map(move |y| (x, y)));
        let differ = |(x, y): &(u32, u32)| pixel(&whole, *x, *y) != pixel(&still, *x, *y);
        places.filter(differ).count()
    };
    let thirds = [110..180, 180..250, 250..320].map(changed);
    assert!(thirds.iter().all(|count| *count > 300), "{thirds:?}");
    assert_eq!(changed(0..40), 0, "before the ball");
}

#[test]
fn the_color_covers_as_its_alpha_says() {
    let settings = [
        "motion.color=#ff000080",
        "motion.weight=1",
        "motion.variation=0",
        "motion.spacing=20px",
    ];
    let frame = drawn(&settings, "motion.trail = [3, 0, 0]");
    let reds = (80..102).map(|y| pixel(&frame, 142, y));
    // Half of white's light is 188.
    let red = reds.filter(|[r, g, b]| *r == 255 && g.abs_diff(188) < 3 && b == g);
    assert!(red.count() > 10);
}

#[test]
fn tiles_and_blends_keep_the_lines() {
    let model = Model::new(&scene()).unwrap();
    let mut style = moving(&["motion.spacing=6px"], "motion.trail = [1, -0.4, 0]");
    let of = |style: &Style, tile_pixels: u32| {
        let options = RendererOptions {
            tile_pixels,
            ..RendererOptions::new(SIZE)
        };
        draw_with(&Processor, &model, style, &front(), &options)
    };
    let whole = of(&style, 4_000_000);
    assert_eq!(whole.rgba, of(&style, 20_000).rgba);
    style.set("blend.amount=0.5").unwrap();
    let blended = of(&style, 4_000_000);
    // Half of a black line is the other look's shade at half its light.
    let darkest = |frame: &Frame| {
        let row = (140..180).map(|x| pixel(frame, x, 95)[0]);
        row.min().unwrap()
    };
    assert!(darkest(&whole) == 0, "{}", darkest(&whole));
    assert!(
        (40..120).contains(&darkest(&blended)),
        "{}",
        darkest(&blended)
    );
}
