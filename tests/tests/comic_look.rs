//! Ink, hatching, highlights and beams in whole frames, on the processor.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

use npr_mesh::testing::{icosphere, plane};
use npr_render::Frame;
use npr_scene::Scene;
use npr_style::Style;
use npr_tests::comic::{self, direction, draw, front, pixel, style, wall};
use npr_tests::{Object, draw_from, placed, scene_of};

/// Width and height of pictures.
const SIZE: [u32; 2] = comic::SIZE;

fn ball() -> Scene {
    scene_of(&[Object::new("Ball", icosphere(5))])
}

/// Share of black among the pixels of a column of the ball, between `top` and `bottom`.
fn darkness(frame: &Frame, x: std::ops::Range<u32>, y: std::ops::Range<u32>) -> f32 {
    let count = (x.len() * y.len()) as f32;
    let dark = |x: u32, y: u32| 1.0 - f32::from(pixel(frame, x, y)[0]) / 255.0;
    let sum: f32 = x.flat_map(|x| y.clone().map(move |y| dark(x, y))).sum();
    sum / count
}

/// Darkness left, in the middle and right on the ball, which is lit from the right.
fn across(frame: &Frame) -> [f32; 3] {
    [70..80, 150..170, 240..250].map(|x| darkness(frame, x, 100..140))
}

#[test]
fn each_tone_draws_its_part_of_the_shade() {
    let tone = |name: &str| across(&draw(&ball(), &[&format!("ink.tone={name}")]));
    assert_eq!(tone("none"), [0.0; 3]);
    let [left, middle, right] = tone("ink");
    assert!(left == 1.0 && right == 0.0, "ink: {left} {middle} {right}");
    let [left, middle, right] = tone("ink+hatch");
    assert!(left == 1.0 && right == 0.0, "ink+hatch: {left} {right}");
    assert!((0.15..0.85).contains(&middle), "hatched middle: {middle}");
    let [left, middle, right] = tone("hatch");
    assert!((0.4..0.95).contains(&left), "hatch leaves paper: {left}");
    assert!(
        (0.15..0.85).contains(&middle) && right == 0.0,
        "hatch: {middle} {right}"
    );
}

#[test]
fn ink_and_strokes_are_cut_hard() {
    let frame = draw(&ball(), &["ink.tone=ink+hatch"]);
    let middle = (140..180).flat_map(|x| (60..180).map(move |y| (x, y)));
    let values: Vec<u8> = middle.map(|(x, y)| pixel(&frame, x, y)[0]).collect();
    let grey = values.iter().filter(|v| (40..215).contains(*v)).count();
    assert!(
        grey * 3 < values.len(),
        "{grey} of {} are grey",
        values.len()
    );
    assert!(values.contains(&0) && values.contains(&255));
}

#[test]
fn darker_light_gives_more_ink() {
    let mut last = 1.1;
    for light_at in ["1.0", "0.8", "0.6", "0.4"] {
        let setting = format!("ink.light_at={light_at}");
        let frame = draw(
            &ball(),
            &["ink.tone=ink+hatch", "ink.dark_at=0.2", &setting],
        );
        let all = darkness(&frame, 80..240, 80..160);
        assert!(all < last, "{light_at}: {all} after {last}");
        last = all;
    }
}

#[test]
fn the_outline_merges_with_the_ink() {
    let settings = [
        "ink.tone=ink",
        "line.method=shape",
        "line.color=#000000",
        "line.width.base=12",
        "line.width.source=constant",
    ];
    let frame = draw(&ball(), &settings);
    // On the dark side black runs on from the ink to where the background begins.
    let row: Vec<[u8; 3]> = (0..100).map(|x| pixel(&frame, x, 120)).collect();
    let first = row.iter().position(|p| p[2] < 60).unwrap();
    assert!(
        row[first..].iter().all(|p| p[0] < 30 && p[2] < 60),
        "{row:?}"
    );
}

#[test]
fn parts_may_be_hatched_in_their_own_way() {
    let scene = scene_of(&[
        Object::new("Left", placed(&icosphere(4), [0.6; 3], [-0.7, 0.0, 0.0])),
        Object::new("Right", placed(&icosphere(4), [0.6; 3], [0.7, 0.0, 0.0])),
    ]);
    let mut style = style(&["ink.tone=ink+hatch"]);
    let rule = "[[rule]]\nmatch = { object = \"Right\" }\nink = { tone = \"none\" }\n";
    let more = Style::from_toml(rule, &|_| Err(String::new())).unwrap();
    style.rule = more.rule;
    let frame = draw_from(&scene, &style, &front(), SIZE).frame;
    assert!(darkness(&frame, 40..160, 60..180) > 0.2);
    assert_eq!(darkness(&frame, 190..230, 100..140), 0.0);
}

#[test]
fn hatching_on_the_screen_has_one_direction_everywhere() {
    let settings = [
        "ink.tone=ink+hatch",
        "ink.mapping=screen",
        "ink.hatch.angle_deg=45",
    ];
    let frame = draw(&ball(), &settings);
    for y in [60..100, 100..140, 140..180] {
        let [along, slant] = direction(&frame, 130..190, y.clone());
        assert!(
            slant.abs() > 0.6 && along.abs() < 0.35,
            "{y:?}: {along} {slant}"
        );
    }
}

/// Two balls, of which a rule says something about the right one.
fn two_balls(settings: &[&str], rule: &str) -> Frame {
    let scene = scene_of(&[
        Object::new("Left", placed(&icosphere(4), [0.6; 3], [-0.7, 0.0, 0.0])),
        Object::new("Right", placed(&icosphere(4), [0.6; 3], [0.7, 0.0, 0.0])),
    ]);
    let mut style = style(settings);
    let rule = format!("[[rule]]\nmatch = {{ object = \"Right\" }}\n{rule}\n");
    style.rule = Style::from_toml(&rule, &|_| Err(String::new()))
        .unwrap()
        .rule;
    draw_from(&scene, &style, &front(), SIZE).frame
}

#[test]
fn mapping_and_strokes_are_chosen_by_part() {
    let settings = [
        "ink.tone=ink+hatch",
        "ink.mapping=screen",
        "ink.hatch.angle_deg=45",
        "light.direction=[0,1,0]",
    ];
    let middles = |rule: &str| {
        let frame = two_balls(&settings, rule);
        [
            direction(&frame, 75..110, 110..150),
            direction(&frame, 210..245, 110..150),
        ]
    };
    let [left, right] = middles("ink.hatch.angle_deg = -45");
    assert!(
        left[1].abs() > 0.5 && right[1].abs() > 0.5,
        "{left:?} {right:?}"
    );
    assert!(
        left[1] * right[1] < 0.0,
        "across each other: {left:?} {right:?}"
    );
    let [left, right] =
        middles("ink = { mapping = \"surface\", direction = [1, 0, 0], hatch.angle_deg = 0 }");
    assert!(left[1].abs() > 0.5, "on the picture: {left:?}");
    assert!(right[0] < -0.5, "along x on the surface: {right:?}");
}

/// A square wall to either side, painted as bright as `left` and `right` say, linear light; it faces the light.
fn painted_walls(left: f32, right: f32, settings: &[&str]) -> [f32; 2] {
    let wall = |name: &str, x: f32, paint: f32| {
        let mesh = placed(&plane(8, 8), [1.0, 1.0, 1.0], [x - 0.5, -0.5, 0.0]);
        Object::new(name, mesh).colored([paint; 3])
    };
    let scene = scene_of(&[wall("Left", -0.7, left), wall("Right", 0.7, right)]);
    let settings = [&["light.direction=[0,0,1]"], settings].concat();
    let frame = draw(&scene, &settings);
    [70..115, 205..250].map(|x| darkness(&frame, x, 90..150))
}

#[test]
fn dark_paint_is_drawn_on_paper_where_the_style_says() {
    let pen = ["ink.tone=ink+hatch", "ink.paint=1"];
    // All ink, but for a trace of grey between strokes that only just meet.
    let [black, white] = painted_walls(0.0, 0.9, &pen);
    assert!(black > 0.99 && white == 0.0, "{black} {white}");
    assert_eq!(painted_walls(0.0, 0.9, &["ink.tone=ink+hatch"]), [0.0; 2]);
    let [dark, light] = painted_walls(0.05, 0.2, &pen);
    assert!(
        dark > light + 0.2 && light > 0.05 && dark < 0.98,
        "{dark} {light}"
    );
    // Where no strokes come between, only what is dark enough turns black.
    assert_eq!(
        painted_walls(0.01, 0.4, &["ink.tone=ink", "ink.paint=1"]),
        [1.0, 0.0]
    );
    let gentle = painted_walls(0.05, 0.2, &["ink.tone=ink+hatch", "ink.paint=0.3"]);
    assert!(gentle[0] < dark && gentle[1] < light, "{gentle:?}");
}

#[test]
fn vertex_colours_are_paint_too() {
    let mesh = placed(&plane(8, 8), [2.0, 1.0, 1.0], [-1.0, -0.5, 0.0]);
    let count = mesh.positions().len();
    let black = Object::new("Wall", mesh).painted(&vec![0.0; count]);
    let settings = [
        "light.direction=[0,0,1]",
        "ink.tone=ink+hatch",
        "ink.paint=0.5",
    ];
    let wall = |object: &Object, settings: &[&str]| {
        darkness(
            &draw(&scene_of(std::slice::from_ref(object)), settings),
            100..220,
            90..150,
        )
    };
    assert_eq!(wall(&black, &settings), 1.0);
    assert_eq!(wall(&black, &settings[..2]), 0.0);
    assert_eq!(
        wall(
            &black,
            &[&settings[..], &["shade.use_vertex_colors=false"]].concat()
        ),
        0.0
    );
}

#[test]
fn each_part_has_the_outline_that_its_rule_says() {
    let settings = [
        "line.method=shape",
        "line.color=#000000",
        "line.width.base=20",
        "line.width.source=constant",
    ];
    let rim = |frame: &Frame, x: i32| {
        let row = (0..20).map(|i| pixel(frame, (x + i - 10) as u32, 120));
        row.filter(|p| p[0] < 40 && p[2] < 40).count()
    };
    // The outer rims of both balls, 96 pixels a unit.
    let rims = |rule: &str| {
        let frame = two_balls(&settings, rule);
        [rim(&frame, 160 - 125), rim(&frame, 160 + 125)]
    };
    let [left, right] = rims("");
    assert!(left > 2 && right > 2, "both by the style: {left} {right}");
    let [left, right] = rims("line.method = \"none\"");
    assert!(left > 2 && right == 0, "none: {left} {right}");
    for method in ["hull", "angle"] {
        let [left, right] = rims(&format!("line.method = \"{method}\""));
        // The band of 15 degrees is two pixels wide.
        assert!(left > 2 && right > 1, "{method}: {left} {right}");
    }
    let whole = Style::from_toml(
        "[[rule]]\nline.method = \"filter\"",
        &|_| Err(String::new()),
    );
    assert!(
        whole
            .unwrap_err()
            .to_string()
            .contains("rule.0.line.method")
    );
}

#[test]
fn hatching_on_the_surface_follows_the_direction_it_is_given() {
    let wall = scene_of(&[Object::new("Wall", wall(1.5, 0.0))]);
    let strokes = |direction_setting: &str| {
        let light = "light.direction=[0,0.9,0.1]";
        let settings = ["ink.tone=ink+hatch", light, direction_setting];
        direction(&draw(&wall, &settings), 80..240, 60..180)
    };
    // Strokes along x change along y, and the other way round.
    assert!(strokes("ink.direction=[1,0,0]")[0] < -0.6);
    assert!(strokes("ink.direction=[0,1,0]")[0] > 0.6);
}

#[test]
fn a_crisp_highlight_is_a_white_spot_where_light_is_mirrored() {
    let settings = [
        "shade.paper=#808080",
        "light.direction=[0.6,0,0.8]",
        "highlight.edge=crisp",
        "highlight.exponent=100",
    ];
    let frame = draw(&ball(), &settings);
    let white: Vec<[f32; 2]> = (0..SIZE[0] * SIZE[1])
        .map(|i| (i % SIZE[0], i / SIZE[0]))
        .filter(|(x, y)| pixel(&frame, *x, *y) == [255; 3])
        .map(|(x, y)| [x as f32 + 0.5, y as f32 + 0.5])
        .collect();
    let count = white.len() as f32;
    let mean = |axis: usize| white.iter().map(|p| p[axis]).sum::<f32>() / count;
    // Half way between light and eye the normal is (0.316, 0, 0.949); 96 pixels are a unit.
    assert!(
        (mean(0) - (160.0 + 96.0 * 0.316)).abs() < 1.0,
        "{}",
        mean(0)
    );
    assert!((mean(1) - 120.0).abs() < 1.0, "{}", mean(1));
    // (n.h)^100 > 0.5 within 6.7 degrees, a disc of 11.3 pixels that the tilt narrows.
    let expected = std::f32::consts::PI * 11.3 * 11.3 * 0.949;
    assert!(
        (count / expected - 1.0).abs() < 0.1,
        "{count} of {expected}"
    );
}

#[test]
fn three_highlights_add_up() {
    let gray = "shade.paper=#404040";
    let count = |settings: &[&str]| {
        let all = [&[gray, "light.direction=[0.4,0.3,0.85]"], settings].concat();
        let frame = draw(&ball(), &all);
        (0..SIZE[0] * SIZE[1])
            .filter(|i| pixel(&frame, i % SIZE[0], i / SIZE[0]) == [255; 3])
            .count()
    };
    let spot = ["highlight.edge=crisp"];
    let back = ["highlight.back.on=true", "highlight.back.to=0.72"];
    let streak = ["highlight.streak.on=true"];
    let alone = [count(&spot), count(&back), count(&streak)];
    assert!(alone.iter().all(|count| *count > 50), "{alone:?}");
    let together = count(&[spot[0], back[0], back[1], streak[0]]);
    assert!(
        together > *alone.iter().max().unwrap(),
        "{together} of {alone:?}"
    );
    assert!(together <= alone.iter().sum(), "{together} of {alone:?}");
}

/// A beam along x before a ball, in a mode.
fn beam(overlap: &str) -> Frame {
    let tube = placed(&icosphere(4), [1.2, 0.2, 0.2], [0.0, 0.0, 1.3]);
    let scene = scene_of(&[Object::new("Ball", icosphere(4)), Object::new("Beam", tube)]);
    let settings = [
        "line.method=shape",
        "line.color=#000000",
        "line.width.base=20",
    ];
    let mut style = style(&settings);
    let rule = format!(
        "[[rule]]\nmatch = {{ object = \"Beam\" }}\nbeam = {{ overlap = \"{overlap}\", ramp = [{{ at = 0.0, color = \"#ff0000\" }}] }}\n"
    );
    style.rule = Style::from_toml(&rule, &|_| Err(String::new()))
        .unwrap()
        .rule;
    draw_from(&scene, &style, &front(), SIZE).frame
}

#[test]
fn a_beam_lies_over_objects_and_under_their_lines() {
    let frame = beam("lines");
    assert_eq!(pixel(&frame, 160, 120), [255, 0, 0], "over the ball");
    assert_eq!(pixel(&frame, 268, 120), [255, 0, 0], "over the background");
    assert_eq!(pixel(&frame, 254, 120), [0; 3], "the ball's outline");
}

#[test]
fn a_beam_may_cover_lines() {
    assert_eq!(pixel(&beam("covers"), 254, 120), [255, 0, 0]);
}

#[test]
fn a_beam_may_lie_behind_all_objects() {
    let frame = beam("behind");
    assert_eq!(pixel(&frame, 160, 120), [255; 3], "the ball");
    assert_eq!(pixel(&frame, 268, 120), [255, 0, 0], "the background");
}

#[test]
fn a_beam_runs_from_its_rim_to_its_middle() {
    let scene = scene_of(&[Object::new("Beam", icosphere(5))]);
    let mut style = style(&[]);
    let rule = "[[rule]]\nbeam = { softness = 0.0, ramp = [{ at = 0.0, color = \"#ff0000\" }, { at = 0.5, color = \"#ffffff\" }] }\n";
    style.rule = Style::from_toml(rule, &|_| Err(String::new()))
        .unwrap()
        .rule;
    let frame = draw_from(&scene, &style, &front(), SIZE).frame;
    // E.N is 0.5 where the ball is 0.866 from its middle; 96 pixels are a unit.
    assert_eq!(pixel(&frame, 160 + 80, 120), [255; 3]);
    assert_eq!(pixel(&frame, 160 + 87, 120), [255, 0, 0]);
}
