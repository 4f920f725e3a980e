//! Ink, hatching, highlights and beams in whole frames, on the processor.

use npr_core::grain::paper_height;
use npr_gpu::processor::Processor;
use npr_mesh::testing::{icosphere, plane};
use npr_render::{Frame, Model};
use npr_scene::Scene;
use npr_stylesheet::Style;
use npr_tests::comic::{self, direction, draw, front, pixel, style, wall};
use npr_tests::{Object, draw_from, draw_on, placed, scene_of};

/// Width and height of pictures.
const SIZE: [u32; 2] = comic::SIZE;

pub fn ball() -> Scene {
    scene_of(&[Object::new("Ball", icosphere(5))])
}

/// Two smaller balls beside each other.
fn pair() -> [Object; 2] {
    [("Left", -0.7), ("Right", 0.7)]
        .map(|(name, x)| Object::new(name, placed(&icosphere(4), [0.6; 3], [x, 0.0, 0.0])))
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
    // It ends where the coordinate is 0.475, at column 155.2.
    assert!((0.2..0.32).contains(&middle), "ink: {middle}");
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

/// How often black and white change along a column of a picture.
fn changes(frame: &Frame, x: u32, y: std::ops::Range<u32>) -> usize {
    let column: Vec<bool> = y.map(|y| pixel(frame, x, y)[0] < 128).collect();
    column.windows(2).filter(|pair| pair[0] != pair[1]).count()
}

#[test]
fn strokes_are_drawn_where_the_tone_has_them() {
    // Columns where ink alone is black, and where it is white.
    let strokes = |tone: &str| {
        let frame = draw(&ball(), &[&format!("ink.tone={tone}")]);
        [145, 165].map(|x| changes(&frame, x, 60..180))
    };
    assert_eq!(strokes("none"), [0, 0]);
    assert_eq!(strokes("ink"), [0, 0]);
    for tone in ["hatch", "ink+hatch"] {
        let found = strokes(tone);
        assert!(found.iter().all(|count| *count > 4), "{tone}: {found:?}");
    }
}

/// Strokes across the balls of [`pair`], where ink alone ends: changes along a column of each, at most.
fn strokes_of_pair(frame: &Frame) -> [usize; 2] {
    let most = |x: std::ops::Range<u32>| x.map(|x| changes(frame, x, 80..160)).max().unwrap();
    [80..106, 214..240].map(most)
}

#[test]
fn metal_is_inked_and_cloth_is_hatched_unless_a_rule_says_otherwise() {
    let mut balls = pair();
    balls[1].material.metallic = 1.0;
    let drawn = |rules: &str| {
        let settings = [
            "ink.tone=auto",
            "ink.mapping=screen",
            "ink.hatch.angle_deg=45",
        ];
        let mut style = style(&settings);
        style.rule = Style::from_toml(rules, &|_| Err(String::new()))
            .unwrap()
            .rule;
        strokes_of_pair(&draw_from(&scene_of(&balls), &style, &front(), SIZE).frame)
    };
    let [cloth, metal] = drawn("");
    assert!(cloth > 4 && metal == 0, "{cloth} {metal}");
    let [cloth, metal] = drawn(
        "[[rule]]\nmatch.object = \"Left\"\nink.tone = \"ink\"\n\
         [[rule]]\nmatch.object = \"Right\"\nink.tone = \"hatch\"\n",
    );
    assert!(cloth == 0 && metal > 4, "by rule: {cloth} {metal}");
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
    // On the dark side black runs on from the ink to where the background begins.
    let black_from = |more: &[&str]| {
        let frame = draw(&ball(), &[&settings, more].concat());
        let row: Vec<[u8; 3]> = (0..100).map(|x| pixel(&frame, x, 120)).collect();
        let first = row.iter().position(|p| p[2] < 60).unwrap();
        assert!(
            row[first..].iter().all(|p| p[0] < 30 && p[2] < 60),
            "{row:?}"
        );
        first
    };
    let [both, ink] = [&[][..], &["line.method=none"]].map(black_from);
    assert!(both < ink, "the line adds to the ink: {both} {ink}");
}

#[test]
fn parts_may_be_hatched_in_their_own_way() {
    let scene = scene_of(&pair());
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
    let scene = scene_of(&pair());
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
fn vertex_colors_are_paint_too() {
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
    // Left of the middle all is as the style has it, right as if the whole style had the method of the rule.
    let half = |frame: &Frame, columns: std::ops::Range<u32>| -> Vec<[u8; 3]> {
        let places = columns.flat_map(|x| (0..SIZE[1]).map(move |y| (x, y)));
        places.map(|(x, y)| pixel(frame, x, y)).collect()
    };
    let drawn = |style: &str, rule: &str| {
        let style = format!("line.method={style}");
        let rule = format!("line.method = \"{rule}\"");
        let frame = two_balls(&[&settings[..], &[style.as_str()]].concat(), &rule);
        [half(&frame, 0..160), half(&frame, 160..320)]
    };
    for (style, rule) in [
        ("shape", "hull"),
        ("shape", "angle"),
        ("angle", "shape"),
        ("angle", "strokes"),
        ("angle", "potrace"),
    ] {
        let [both, as_style, as_rule] =
            [(style, rule), (style, style), (rule, rule)].map(|(style, rule)| drawn(style, rule));
        assert!(both[0] == as_style[0], "{rule}: the left as by {style}");
        assert!(both[1] == as_rule[1], "{rule}: the right as by {rule}");
        let pairs = both[1].iter().zip(&as_style[1]);
        let count = pairs.filter(|(ruled, other)| ruled != other).count();
        assert!(count > 500, "{rule} is not {style}: {count}");
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
fn crossed_strokes_run_both_ways_and_no_two_patterns_are_alike() {
    let wall = scene_of(&[Object::new("Wall", wall(1.5, 0.0))]);
    let patterns = ["parallel", "cross", "stipple", "pencil", "dots", "brush"];
    let frames = patterns.map(|pattern| {
        let settings = [
            "ink.tone=ink+hatch",
            "light.direction=[0,0.95,0.1]",
            "ink.direction=[0,1,0]",
            "ink.dark_at=0.3",
            "ink.light_at=0.9",
            "ink.hatch.cross_at=0.7",
            &format!("ink.hatch.pattern={pattern}"),
        ];
        draw(&wall, &settings)
    });
    let upright = [&frames[0], &frames[1]].map(|frame| direction(frame, 60..260, 40..200)[0]);
    assert!(
        upright[0] > 0.6 && upright[1].abs() < 0.4,
        "parallel and cross: {upright:?}"
    );
    for (i, one) in frames.iter().enumerate() {
        for (other, pattern) in frames.iter().zip(patterns).skip(i + 1) {
            let places = (60..260).flat_map(|x| (40..200).map(move |y| (x, y)));
            let apart = places
                .filter(|(x, y)| pixel(one, *x, *y)[0].abs_diff(pixel(other, *x, *y)[0]) > 128);
            let count = apart.count();
            assert!(count > 200, "{} and {pattern}: {count}", patterns[i]);
        }
    }
}

/// Hatching leaves the same valleys of the paper white as strokes do, and more on rougher paper.
#[test]
fn hatching_shows_the_grain_of_the_paper() {
    let wall = scene_of(&[Object::new("Wall", wall(1.5, 0.0))]);
    let drawn = |grain: &str, size: &str| {
        let settings = [
            "ink.tone=ink+hatch",
            "light.direction=[0,0,-1]",
            &format!("ink.hatch.grain={grain}"),
            &format!("paper.size={size}"),
        ];
        draw(&wall, &settings)
    };
    let dark = |frame: &Frame| -> f32 {
        let inside = (60..260).flat_map(|x| (40..200).map(move |y| (x, y)));
        let ink = inside.map(|(x, y)| 1.0 - f32::from(pixel(frame, x, y)[0]) / 255.0);
        ink.sum::<f32>() / (200.0 * 160.0)
    };
    let [smooth, little, some, rough] = ["0", "0.5", "1.2", "1.8"].map(|grain| drawn(grain, "4px"));
    assert!(
        dark(&smooth) > 0.97,
        "all of the wall is ink: {}",
        dark(&smooth)
    );
    assert!(dark(&little) < dark(&smooth) - 0.01 && dark(&some) < dark(&little) - 0.03);
    assert!(dark(&some) < 0.97 && dark(&rough) < dark(&some) - 0.03);
    // Where paper is high there is ink, where it is low there is none.
    for (x, y) in (60..260).flat_map(|x| (40..200).map(move |y| (x, y))) {
        let height = paper_height([x as f32 + 0.5, y as f32 + 0.5], 0.25);
        let white = pixel(&rough, x, y)[0];
        assert!(white < 100 || height < 0.6, "{x} {y}: {height} {white}");
        assert!(white > 100 || height > 0.3, "{x} {y}: {height} {white}");
    }
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

/// Black where no light comes and white where it is full, under no main light.
const BY_LIGHT: [&str; 4] = [
    "light.intensity=0",
    "light.space=world",
    "shade.softness=0.5",
    "shade.ramp=[{ at = 0.0, light = 0.0 }, { at = 0.25, light = 0.5 }, { at = 0.75, light = 1.0 }]",
];

#[test]
fn a_spot_lights_a_disc_on_a_wall() {
    let wall = scene_of(&[Object::new("Wall", wall(2.0, 0.0))]);
    let spot = "light.extra=[{ kind = \"spot\", position = [0, 0, 3], direction = [0, 0, 1], \
                intensity = 1, inner_deg = 8, outer_deg = 12 }]";
    let frame = draw(&wall, &[&BY_LIGHT[..], &[spot]].concat());
    // The cone is full up to 40 pixels from the middle and ends after 61.
    for (aside, is_lit) in [(0, true), (38, true), (63, false), (110, false)] {
        for [dx, dy] in [[1, 0], [-1, 0], [0, 1], [0, -1]] {
            let [x, y] = [160 + aside * dx, 120 + aside * dy];
            let value = pixel(&frame, x as u32, y as u32)[1];
            let wanted = if is_lit { value > 240 } else { value == 0 };
            assert!(wanted, "{x}, {y}: {value}");
        }
    }
    for (x, y) in [(2, 2), (317, 2), (2, 237), (317, 237)] {
        assert_eq!(pixel(&frame, x, y), [0; 3], "{x}, {y}");
    }
}

/// Pixels of a ball in which a spot shows its highlight, on grey paper; the spot stands at (0, 0, 4) and shines
/// towards a place on the plane z = 1.
fn shining(target: [f32; 2], more: &[&str]) -> usize {
    let [x, y] = target;
    let spot = format!(
        "light.extra=[{{ kind = \"spot\", position = [0, 0, 4], direction = [{}, {}, 3], \
         intensity = 1, inner_deg = 5, outer_deg = 6 }}]",
        -x, -y
    );
    let settings = [
        "shade.paper=#808080",
        "highlight.edge=crisp",
        "light.intensity=0",
        &spot,
    ];
    let style = style(&[&settings, more].concat());
    let model = Model::new(&ball()).unwrap();
    let frame = draw_on(&Processor, &model, &style, &front(), SIZE);
    #[cfg(feature = "gpu")]
    if let Some(device) = npr_tests::device() {
        let other = draw_on(device, &model, &style, &front(), SIZE);
        let agreement = npr_tests::Agreement::between(&frame, &other, 2);
        assert!(agreement.holds(), "{agreement}");
    }
    (0..SIZE[0] * SIZE[1])
        .filter(|i| pixel(&frame, i % SIZE[0], i / SIZE[0]) == [255; 3])
        .count()
}

#[test]
fn a_spot_beside_a_ball_leaves_no_highlight_on_it() {
    for model in ["blinn", "phong"] {
        let model = format!("highlight.model={model}");
        let at_the_middle = shining([0.0, 0.0], &[&model]);
        assert!(at_the_middle > 100, "{model}: {at_the_middle}");
        assert_eq!(shining([2.0, 0.0], &[&model]), 0, "{model}");
    }
}

#[test]
fn a_highlight_fades_with_the_light_that_makes_it() {
    let lamp = |keys: &str| {
        let lamp = format!("light.extra=[{{ position = [0, 0, 4], {keys} }}]");
        shining([0.0, 0.0], &[&lamp])
    };
    let [full, weak] = [lamp("intensity = 1"), lamp("intensity = 0.7")];
    assert!(full > weak + 20 && weak > 20, "{full} {weak}");
    assert_eq!(lamp("intensity = 0.5"), 0, "no stronger than the threshold");
    assert_eq!(lamp("intensity = 4"), full, "and never stronger than 1");
    // The ball begins three units from the lamp.
    assert_eq!(lamp("intensity = 1, range = 2.9"), 0);
    assert!(lamp("intensity = 1, range = 20") > 20);
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
        "[[rule]]\nmatch = {{ object = \"Beam\" }}\nbeam = {{ overlap = \"{overlap}\", ramp = [{{ at = 0.0, \
         color = \"#ff0000\" }}] }}\n"
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
fn a_beam_lights_the_wall_behind_it_in_its_own_color() {
    let wall = Object::new("Wall", wall(2.0, 0.0));
    let tube = Object::new(
        "Beam",
        placed(&icosphere(4), [0.5, 0.1, 0.1], [-1.0, 0.0, 0.5]),
    );
    let scene = scene_of(&[wall, tube]);
    let lit = |light: f32| {
        let mut style = style(&BY_LIGHT);
        let rule = format!(
            "[[rule]]\nmatch.object = \"Beam\"\n\
             beam = {{ light = {light}, ramp = [{{ at = 0.0, color = \"#ff0000\" }}] }}\n"
        );
        style.rule = Style::from_toml(&rule, &|_| Err(String::new()))
            .unwrap()
            .rule;
        let frame = draw_from(&scene, &style, &front(), SIZE).frame;
        // Just above the beam, whose middle is at column 64, and far to its right.
        [64, 270].map(|x| pixel(&frame, x, 95))
    };
    let [near, far] = lit(0.7);
    assert!(near[0] > 100 && near[1] == 0 && near[2] == 0, "{near:?}");
    assert_eq!(far, [0; 3]);
    assert_eq!(lit(0.0), [[0; 3]; 2], "a beam without light lights nothing");
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
    let (red, white) = (("#ff0000", [255, 0, 0]), ("#ffffff", [255; 3]));
    // Deep outside, and deep inside.
    for (rim, middle) in [(red, white), (white, red)] {
        let mut style = style(&[]);
        let rule = format!(
            "[[rule]]\nbeam.softness = 0.0\n\
             beam.ramp = [{{ at = 0.0, color = \"{}\" }}, {{ at = 0.5, color = \"{}\" }}]\n",
            rim.0, middle.0
        );
        style.rule = Style::from_toml(&rule, &|_| Err(String::new()))
            .unwrap()
            .rule;
        let frame = draw_from(&scene, &style, &front(), SIZE).frame;
        // E.N is 0.5 where the ball is 0.866 from its middle; 96 pixels are a unit.
        assert_eq!(pixel(&frame, 160 + 80, 120), middle.1);
        assert_eq!(pixel(&frame, 160 + 87, 120), rim.1);
    }
}

#[test]
fn shade_narrower_than_its_strokes_are_apart_is_black_or_paper() {
    // Stand upright strips in an even tone, as a draughtsman would cut them out of a sheet.
    let inked = |width_px: f32, pattern: &str, light_at: &str| {
        let width = width_px * 2.5 / SIZE[1] as f32;
        let strip = placed(&plane(2, 8), [width, 2.0, 1.0], [-0.5 * width, -1.0, 0.0]);
        let settings = [
            "ink.tone=hatch",
            "ink.mapping=screen",
            "ink.dark_at=0.1",
            &format!("ink.light_at={light_at}"),
            &format!("ink.hatch.pattern={pattern}"),
        ];
        let scene = scene_of(&[Object::new("Strip", strip)]);
        let middle = 0.4 * width_px;
        let columns = (160.0 - middle) as u32..(160.0 + middle) as u32;
        darkness(&draw(&scene, &settings), columns, 60..180)
    };

    // Tone shows where it has room, and gives way to its own edge where it has none.
    for pattern in ["dots", "parallel"] {
        let [light, dark] = ["0.72", "1.0"].map(|at| inked(60.0, pattern, at));
        assert!(
            light > 0.1 && dark > light && dark < 0.9,
            "{pattern}: {light} {dark}"
        );
        assert_eq!(inked(7.0, pattern, "0.72"), 0.0, "{pattern}");
        assert_eq!(inked(7.0, pattern, "1.0"), 1.0, "{pattern}");
    }
}
