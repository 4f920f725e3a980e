//! Where width comes from.

use super::fixture::{front, front_camera, parts_scene, with};
use npr_gpu::processor::Processor;
use npr_mesh::testing::{plane, uv_sphere};
use npr_render::{
    LineModel, LineModelOptions, LineOptions, Picture, RenderError, RendererOptions, Subject,
};
use npr_scene::Scene;
use npr_stylesheet::Style;
use npr_tests::{Ink, Object, draw, draw_from, lines, placed, scene_of};

/// Lines whose width follows `source`, from 2 to 16 pixels.
fn swelling(source: &str) -> Style {
    let source = format!("line.width.source={source}");
    with(
        lines("shape"),
        &[
            "line.width.base=8px",
            "line.width.min=0.25",
            "line.width.max=2",
            &source,
        ],
    )
}

/// Width of an ellipsoid's outline at its right tip and at its top, in pixels; `long` is its half length along `axis`.
fn tip_and_top(axis: usize, long: f32, source: &str) -> [f32; 2] {
    let mut scale = [0.4; 3];
    scale[axis] = long;
    let object = Object::new("Egg", placed(&uv_sphere(96, 64), scale, [0.0; 3]));
    let ink = Ink::of(&front(&[object], &swelling(source)).frame);
    let [right, top] = [100.0 + 100.0 * scale[0], 100.0 - 100.0 * scale[1]];
    let widest = |points: [[f32; 2]; 5], along: [f32; 2]| {
        points
            .map(|point| ink.run(point, along))
            .into_iter()
            .fold(0.0, f32::max)
    };
    [
        widest(
            [-2.0, -1.0, 0.0, 1.0, 2.0].map(|d| [right + d - 0.5, 100.5]),
            [1.0, 0.0],
        ),
        widest(
            [-2.0, -1.0, 0.0, 1.0, 2.0].map(|d| [100.5, top + d + 0.5]),
            [0.0, 1.0],
        ),
    ]
}

#[test]
fn curvature_swells_tight_bends() {
    let [tip, top] = tip_and_top(0, 0.9, "curvature");
    assert!(tip > top + 1.5, "{tip} px at the tip, {top} on the flank");
    let [tip, top] = tip_and_top(0, 0.9, "constant");
    assert!(
        (tip - top).abs() < 1.5,
        "{tip} px at the tip, {top} on the flank"
    );
}

#[test]
fn projected_curvature_follows_the_line_as_seen() {
    // From its side an egg swells at the tip, to a fifth of the radius that the line turns with there.
    let [tip, top] = tip_and_top(0, 0.9, "projected-curvature");
    assert!(tip >= 2.0 * top, "{tip} px at the tip, {top} on the flank");
    // Seen along its axis it is a circle, and the line does not know how long the egg is.
    let [short, _] = tip_and_top(2, 0.4, "projected-curvature");
    let [long, _] = tip_and_top(2, 0.9, "projected-curvature");
    assert!(
        (short - long).abs() < 2.0,
        "{short} px on a ball, {long} on an egg from its end"
    );
}

/// Widths of the line in which an egg pokes through a wall of the same object: at its long ends, and on its flanks.
fn joint_widths(method: &str) -> [f32; 2] {
    let egg = placed(&uv_sphere(96, 64), [0.8, 0.3, 0.3], [0.0, 0.0, -0.1]);
    let wall = placed(&plane(1, 1), [4.0, 4.0, 1.0], [-2.0, -2.0, 0.0]);
    let settings = [
        "line.width.base=8px",
        "line.width.min=0.25",
        "line.width.max=2",
        "line.width.source=curvature",
        "line.width.gain=0.2",
    ];
    let style = with(lines(method), &settings);
    let scene = parts_scene(&[(egg, 0), (wall, 0)]);
    let ink = Ink::of(&draw_from(&scene, &style, &front_camera(), [200, 200]).frame);
    // Seen from the front, the line is the ellipse with 0.943 of the egg's axes.
    let (right, top) = (100.0 + 75.4, 100.0 - 28.3);
    let widest = |runs: [f32; 5]| runs.into_iter().fold(0.0, f32::max);
    let off = [-2.0, -1.0, 0.0, 1.0, 2.0];
    [
        widest(off.map(|d| ink.run([right + d, 100.5], [1.0, 0.0]))),
        widest(off.map(|d| ink.run([100.5, top + d], [0.0, 1.0]))),
    ]
}

#[test]
fn a_line_that_the_hull_misses_swells_with_curvature() {
    assert_eq!(joint_widths("hull"), [0.0; 2]);
    let [end, flank] = joint_widths("filter+hull");
    assert!(
        end <= 3.0 && flank <= 3.0,
        "thin and uniform: {end} and {flank} px"
    );
    let [end, flank] = joint_widths("shape");
    assert!(
        flank > 4.0 && end > flank + 1.5,
        "{end} px at the ends, {flank} on the flanks"
    );
}

#[test]
fn control_points_swell_the_lines_around_them() {
    let object = Object::new("Ball", placed(&uv_sphere(96, 64), [0.7; 3], [0.0; 3]));
    let point =
        "line.width.control_points=[{ position = [0.7, 0.0, 0.0], radius = 0.5, factor = 2.0 }]";
    let mut style = with(
        lines("shape"),
        &["line.width.base=8px", "line.width.max=2", point],
    );
    style.set("line.width.source=control-points").unwrap();
    let ink = Ink::of(&front(&[object], &style).frame);
    let (near, far) = (
        ink.run([169.5, 100.5], [1.0, 0.0]),
        ink.run([30.5, 100.5], [1.0, 0.0]),
    );
    assert!(
        near > 13.0 && far < 10.0,
        "{near} px near the point, {far} px away from it"
    );
}

/// A ball whose texture coordinates run from 0 at its left to 1 at its right, and from its top to its bottom.
fn ball_with_a_chart() -> Scene {
    let ball = placed(&uv_sphere(96, 64), [0.7; 3], [0.0; 3]);
    let mut scene = scene_of(&[Object::new("Ball", ball)]);
    let part = &mut scene.meshes[0].parts[0];
    let chart = |[x, y, _]: &[f32; 3]| [0.5 + 0.5 * x, 0.5 - 0.5 * y];
    part.uvs = Some(part.positions.iter().map(chart).collect());
    scene
}

#[test]
fn a_picture_thins_lines_where_it_is_black_and_swells_them_where_it_is_white() {
    let scene = ball_with_a_chart();
    // One half of each picture is white.
    let picture = |is_white: fn(u32, u32) -> bool| {
        let texel = |i: u32| match is_white(i % 16, i / 16) {
            true => [255; 4],
            false => [0, 0, 0, 255],
        };
        Picture {
            size: [16; 2],
            rgba: (0..256).flat_map(texel).collect(),
        }
    };
    let pictures = [
        ("right", picture(|x, _| x >= 8)),
        ("left", picture(|x, _| x < 8)),
        ("top", picture(|_, y| y < 8)),
        ("bottom", picture(|_, y| y >= 8)),
    ];
    for method in ["strokes", "shape", "okuya", "edges", "hull", "filter+hull"] {
        for (white, picture) in &pictures {
            let style = with(swelling("constant"), &["line.width.texture=white.png"]);
            let style = with(
                style,
                &[
                    "line.width.source=texture",
                    &format!("line.method={method}"),
                ],
            );
            let options = RendererOptions {
                pictures: [("white.png".to_owned(), picture.clone())].into(),
                ..RendererOptions::new([200; 2])
            };
            let subject = Subject::new(&scene, &style).unwrap();
            let mut renderer = subject.renderer(&Processor, &style, &options).unwrap();
            let ink = Ink::of(&renderer.draw(&front_camera()).unwrap());
            let sides = [
                ("left", [30.5, 100.5], [1.0, 0.0]),
                ("right", [169.5, 100.5], [1.0, 0.0]),
                ("top", [100.5, 30.5], [0.0, 1.0]),
                ("bottom", [100.5, 169.5], [0.0, 1.0]),
            ];
            let across = |side: &str| side == "left" || side == "right";
            for (side, at, along) in sides {
                // The middle of the other sides is where black meets white.
                if across(side) != across(white) {
                    continue;
                }
                // Hulls lie outside of the outline.
                let near = [-2.0, -1.0, 0.0, 1.0, 2.0].map(|off| {
                    let [x, y] = [0, 1].map(|axis| at[axis] + off * along[axis]);
                    ink.run([x, y], along)
                });
                let width = near.into_iter().fold(0.0, f32::max);
                let wanted = if side == *white {
                    12.0..=17.0
                } else {
                    1.0..=4.0
                };
                assert!(
                    wanted.contains(&width),
                    "{method}, white {white}: {side} {width} px"
                );
            }
        }
    }
}

/// A ramp of grey across the ball: in a drawing of lines every point is as wide as the picture is white there.
#[test]
fn drawings_follow_a_picture_from_place_to_place() {
    let scene = ball_with_a_chart();
    let settings = ["line.width.texture=ramp.png", "line.width.source=texture"];
    let style = with(swelling("constant"), &settings);
    let mut model =
        LineModel::for_style(&scene, &style, &LineModelOptions::default(), None).unwrap();
    let ramp = Picture {
        size: [256, 1],
        rgba: (0..=255).flat_map(|v| [v, v, v, 255]).collect(),
    };
    let options = LineOptions::of_style(&style, [200; 2]);
    let missing = model.draw(&front_camera(), &style, &options);
    assert!(matches!(missing, Err(RenderError::MissingPicture { .. })));
    model.set_pictures([("ramp.png".to_owned(), ramp)].into());
    let drawing = model.draw(&front_camera(), &style, &options).unwrap();
    let points = drawing.strokes.iter().flat_map(|stroke| &stroke.points);
    let mut widths = Vec::new();
    for point in points {
        // The chart is the picture of the ball from the front, but for what the lens does at its rim.
        let share = 0.5 + 0.5 * f64::from(point.world[0]);
        let wanted = 2.0 + 14.0 * share;
        assert!(
            (point.width - wanted).abs() < 0.7,
            "{} px wide at {share}, not {wanted}",
            point.width
        );
        widths.push(point.width);
    }
    let [least, most] = [f64::min, f64::max].map(|f| widths.iter().copied().reduce(f).unwrap());
    assert!(least < 5.0 && most > 13.0, "{least} to {most} px");
}

#[test]
fn a_larger_copy_of_a_scene_has_the_same_lines() {
    for source in ["curvature", "projected-curvature"] {
        let width = |factor: f32| {
            let mesh = placed(
                &uv_sphere(48, 32),
                [0.9 * factor, 0.4 * factor, 0.4 * factor],
                [0.0; 3],
            );
            let scene = scene_of(&[Object::new("Egg", mesh)]);
            Ink::of(&draw(&scene, &swelling(source), [200, 200])).count() as f32
        };
        let (small, large) = (width(0.01), width(100.0));
        assert!(
            (small - large).abs() <= 0.01 * small,
            "{source}: {small} px of ink, {large} on the large copy"
        );
    }
}
