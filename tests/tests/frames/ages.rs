//! What tells the looks of comics from one another, measured on pictures large enough to show it.

use npr_core::camera::{Camera, Projection};
use npr_mesh::testing::icosphere;
use npr_render::Frame;
use npr_scene::Scene;
use npr_stylesheet::Style;
use npr_tests::comic::{front, pixel};
use npr_tests::{Ink, Object, asset, draw_from, placed, scene_of};
use std::collections::BTreeMap;

/// Width and height of pictures: 288 pixels are a unit.
const SIZE: [u32; 2] = [960, 720];

/// Settings that leave fills alone.
const NO_LINES: &[&str] = &["line.method=none"];

/// Settings that leave lines alone, on white.
const LINES_ALONE: &[&str] = &[
    "background=#ffffff",
    "line.color=#000000",
    "shade.mode=paper",
    "shade.paper=#ffffff",
    "shade.ramp=[{ at = 0.0, light = 1.0 }]",
    "ink.tone=none",
    "highlight.edge=none",
];

fn preset(name: &str, settings: &[&str]) -> Style {
    let mut style = Style::preset(name).unwrap();
    for setting in settings {
        style.set(setting).unwrap();
    }
    style
}

fn drawn(scene: &Scene, style: &Style) -> Frame {
    draw_from(scene, style, &front(), SIZE).frame
}

/// A ball of radius 1 in one colour.
fn ball(color: [f32; 3]) -> Scene {
    scene_of(&[Object::new("Ball", icosphere(6)).colored(color)])
}

/// An egg that lies along x, 2 units long and 0.8 high: sharply bent at its tips, gently above and below.
fn egg() -> Scene {
    scene_of(&[Object::new(
        "Egg",
        placed(&icosphere(6), [1.0, 0.4, 0.4], [0.0; 3]),
    )])
}

/// Colours that cover more than one pixel in a hundred of the ball, up to a step of 2 of 255, with their shares.
fn tones(frame: &Frame) -> Vec<([u8; 3], f32)> {
    let is_inside = |x: u32, y: u32| {
        let [dx, dy] = [x as f32 + 0.5 - 480.0, y as f32 + 0.5 - 360.0];
        dx.hypot(dy) < 270.0
    };
    let mut counts: BTreeMap<[u8; 3], u32> = BTreeMap::new();
    let places = (0..SIZE[0]).flat_map(|x| (0..SIZE[1]).map(move |y| (x, y)));
    for (x, y) in places.filter(|(x, y)| is_inside(*x, *y)) {
        *counts
            .entry(pixel(frame, x, y).map(|v| v / 3 * 3))
            .or_default() += 1;
    }
    let all: u32 = counts.values().sum();
    let shares = counts
        .into_iter()
        .map(|(color, count)| (color, count as f32 / all as f32));
    shares.filter(|(_, share)| *share > 0.01).collect()
}

/// Widths of the egg's outline at its tips and its sides, in pixels.
fn outline_widths(name: &str) -> [f32; 2] {
    let ink = Ink::of(&drawn(&egg(), &preset(name, LINES_ALONE)));
    let widest = |at: [f32; 2], along: [f32; 2]| {
        let nearby = (-14..=14).map(|i| [at[0] + along[0] * i as f32, at[1] + along[1] * i as f32]);
        let inked = nearby.filter(|[x, y]| ink.at(*x as i32, *y as i32));
        inked.map(|place| ink.run(place, along)).fold(0.0, f32::max)
    };
    let (tip, side) = ([480.5 + 288.0, 360.5], [480.5, 360.5 - 0.4 * 288.0]);
    [widest(tip, [1.0, 0.0]), widest(side, [0.0, 1.0])]
}

#[test]
fn lines_swell_in_the_silver_age_and_are_thin_and_even_in_the_modern() {
    let [silver, modern] = ["comic-silver", "comic-modern"].map(outline_widths);
    assert!(
        silver[0] > 1.5 * silver[1],
        "tips and sides of the Silver Age: {silver:?}"
    );
    assert!(
        (modern[0] - modern[1]).abs() < 0.75,
        "those of the Modern Age: {modern:?}"
    );
    assert!(
        silver[0] > 1.5 * modern[0] && modern[1] > 0.9,
        "{silver:?} {modern:?}"
    );
    let older = outline_widths("comic-modern@1");
    assert!(
        older[0] > 1.3 * older[1],
        "before they were even: {older:?}"
    );
}

#[test]
fn fills_are_flat_in_the_silver_age_and_run_smoothly_in_the_modern() {
    let fill = |name: &str, color: [f32; 3]| {
        let settings = [NO_LINES, &["ink.tone=none", "highlight.edge=none"]].concat();
        drawn(&ball(color), &preset(name, &settings))
    };
    // One tone, the material's.
    let [red, blue] = [[0.8, 0.25, 0.1], [0.1, 0.25, 0.8]].map(|color| {
        let tones = tones(&fill("comic-silver", color));
        assert_eq!(tones.len(), 1, "{tones:?}");
        tones[0].0.map(u32::from)
    });
    assert!(
        red[0] > red[2] + 80 && blue[2] > blue[0] + 80,
        "{red:?} {blue:?}"
    );
    let modern = fill("comic-modern", [0.8, 0.25, 0.1]);
    // From the upper left, where light comes from, to the lower right.
    let along = |i: i32| pixel(&modern, (480 + i) as u32, (360 + i) as u32)[0];
    let row: Vec<u8> = (-180..180).map(along).collect();
    let steps = row.windows(2).map(|pair| pair[0].abs_diff(pair[1]));
    let (lit, shaded) = (row[0], row[row.len() - 1]);
    assert!(lit > shaded + 60, "lit {lit}, shaded {shaded}");
    assert!(steps.max().unwrap() <= 3, "no edge between them: {row:?}");
}

#[test]
fn cels_have_two_tones_or_three_with_a_highlight_under_thin_lines() {
    let fill = |name: &str| tones(&drawn(&ball([0.6, 0.3, 0.2]), &preset(name, NO_LINES)));
    let [two, three] = ["cel-2", "cel-3"].map(fill);
    assert_eq!((two.len(), three.len()), (2, 3), "{two:?} {three:?}");
    let brightest = |tones: &[([u8; 3], f32)]| tones.iter().map(|(color, _)| color[1]).max();
    assert!(
        brightest(&three) > brightest(&two),
        "the third is the highlight"
    );
    for name in ["cel-2", "cel-3"] {
        let [tip, side] = outline_widths(name);
        assert!(
            tip.max(side) < 3.0 && tip.min(side) > 0.4,
            "{name}: {tip} {side}"
        );
        assert!(
            outline_widths("comic-silver")[0] > 1.5 * tip,
            "thinner than in comics"
        );
    }
}

#[test]
fn the_simple_comic_is_a_cel_with_black_shade_and_a_thick_line() {
    let fill = tones(&drawn(
        &ball([0.6, 0.3, 0.2]),
        &preset("simple-comic", NO_LINES),
    ));
    assert_eq!(fill.len(), 2, "{fill:?}");
    let (black, paint) = (fill[0], fill[1]);
    assert_eq!(black.0, [0; 3]);
    assert!((0.1..0.5).contains(&black.1), "{black:?}");
    assert!(
        paint.0[0] > 150 && paint.0[0] > paint.0[2] + 40,
        "{paint:?}"
    );
    let [tip, side] = outline_widths("simple-comic");
    assert!(
        (tip - side).abs() <= 1.0 && tip.min(side) >= 4.0,
        "{tip} {side}"
    );
    let cel = outline_widths("cel-2");
    assert!(side > 2.0 * cel[0].max(cel[1]), "{side} against {cel:?}");
}

/// Mean thickness and number of strokes over a range of columns, from the rows of the picture.
fn strokes(frame: &Frame, x: std::ops::Range<u32>, y: std::ops::Range<u32>) -> [f32; 2] {
    let columns = x.len() as f32;
    let (mut dark, mut count) = (0.0, 0.0);
    for x in x {
        let mut before = 1.0;
        for y in y.clone() {
            let ink = 1.0 - f32::from(pixel(frame, x, y)[0]) / 255.0;
            dark += ink;
            if ink > 0.5 && before <= 0.5 {
                count += 1.0;
            }
            before = ink;
        }
    }
    [dark / f32::max(count, 1.0), count / columns]
}

/// Even strokes across a tube that stands up, in light from the right: the shade fades from left to right.
fn strokes_across_a_tube(settings: &[&str]) -> Frame {
    const EVEN: &[&str] = &[
        "ink.tone=ink+hatch",
        "ink.mapping=screen",
        "ink.hatch.angle_deg=90",
        "ink.hatch.spacing=24px",
        "ink.hatch.length=200",
        "ink.hatch.wobble=0",
        "ink.hatch.variation=0",
    ];
    let style = npr_tests::comic::style(&[EVEN, settings].concat());
    let tube = placed(&icosphere(6), [1.0, 6.0, 1.0], [0.0; 3]);
    drawn(&scene_of(&[Object::new("Tube", tube)]), &style)
}

#[test]
fn strokes_taper_faster_on_a_steeper_ramp_and_slower_by_their_gain() {
    // The shade ramp is 0.5 at the coordinate 0.55, column 509, in both; strokes are 12 pixels thick there.
    let (wide, narrow) = (
        ["ink.dark_at=0.2", "ink.light_at=0.9"],
        ["ink.dark_at=0.35", "ink.light_at=0.75"],
    );
    let fall = |ramp: [&str; 2], gain: &str| {
        let gain = format!("ink.hatch.gain={gain}");
        let frame = strokes_across_a_tube(&[ramp[0], ramp[1], &gain]);
        let [thick, thin] = [484..494, 524..534].map(|x| strokes(&frame, x, 160..560)[0]);
        thick - thin
    };
    let found = [(wide, "1"), (narrow, "1"), (wide, "2"), (narrow, "2")];
    let [wide, narrow, wide_gained, narrow_gained] = found.map(|(ramp, gain)| fall(ramp, gain));
    // Thickness falls as 1 / (light_at - dark_at) / gain: 1.75 times as fast on the narrow ramp, half as fast by
    // the gain.
    let by_ramp = narrow / wide;
    assert!(
        wide > 2.0 && (1.4..2.4).contains(&by_ramp),
        "{wide} {narrow}"
    );
    for (plain, gained) in [(wide, wide_gained), (narrow, narrow_gained)] {
        assert!((0.3..0.7).contains(&(gained / plain)), "{plain} {gained}");
    }
}

#[test]
fn strokes_run_from_the_dark_into_the_light_and_end_in_points() {
    let frame = strokes_across_a_tube(&["ink.dark_at=0.2", "ink.light_at=0.9"]);
    let [across, _] = npr_tests::comic::direction(&frame, 440..560, 200..520);
    assert!(across < -0.5, "strokes lie across the tube: {across}");
    let places = [400..420, 450..470, 500..520, 550..570, 600..620];
    let found = places.map(|x| strokes(&frame, x, 160..560));
    println!("{found:?}");
    for pair in found.windows(2) {
        assert!(
            pair[1][0] < pair[0][0] - 0.5,
            "thinner towards the light: {found:?}"
        );
    }
    assert!(found[0][0] > 2.0 * found[3][0], "{found:?}");
    // They thin out instead of becoming fewer.
    assert!(
        found[3][1] > 0.7 * found[1][1] && found[1][1] > 8.0,
        "{found:?}"
    );
}

/// Linear light of a byte.
fn linear(byte: u8) -> f32 {
    npr_core::color::linear_from_byte(byte)
}

#[test]
fn a_gradient_is_the_flat_comic_times_a_ramp_under_the_same_ink() {
    let flat = ["ink.tone=ink+hatch", "ink.dark_at=0.2", "ink.light_at=0.6"];
    let ramp = "shade.ramp=[{ at = 0.0, light = 0.2 }, { at = 0.5, light = 1.0 }]";
    let gradient = [&flat[..], &[ramp, "shade.softness=0.5"]].concat();
    let [red, blue] = [[0.8, 0.25, 0.1], [0.2, 0.3, 0.9]].map(|color| {
        let of = |settings: &[&str]| {
            let mut style = npr_tests::comic::style(settings);
            style.set("shade.mode=ramp").unwrap();
            drawn(&ball(color), &style)
        };
        [of(&flat), of(&gradient)]
    });
    let (mut inked, mut painted, mut darkest) = (0, 0, 1.0f32);
    for (x, y) in (220..740)
        .step_by(3)
        .flat_map(|x| (300..420).map(move |y| (x, y)))
    {
        let at = |frames: &[Frame; 2]| [pixel(&frames[0], x, y), pixel(&frames[1], x, y)];
        let ([flat_red, soft_red], [flat_blue, soft_blue]) = (at(&red), at(&blue));
        if flat_red == [0; 3] {
            assert_eq!(soft_red, [0; 3], "ink at {x}, {y}");
            inked += 1;
        } else if flat_red[0] > 200 && flat_blue[2] > 200 {
            let factor = linear(soft_red[0]) / linear(flat_red[0]);
            let other = linear(soft_blue[2]) / linear(flat_blue[2]);
            assert!(
                (factor - other).abs() < 0.03,
                "one factor for all paint: {factor} {other}"
            );
            darkest = darkest.min(factor);
            painted += 1;
        }
    }
    assert!(inked > 1000 && painted > 1000, "{inked} {painted}");
    assert!(darkest < 0.7, "{darkest}");
}

#[test]
fn what_is_brighter_than_the_flat_comic_comes_from_the_highlight() {
    let of = |settings: &[&str]| {
        let mut style = npr_tests::comic::style(settings);
        style.set("shade.mode=ramp").unwrap();
        style.set("light.direction=[0.3,0.3,0.9]").unwrap();
        drawn(&ball([0.5, 0.2, 0.1]), &style)
    };
    let [flat, lit] = [
        of(&[]),
        of(&["highlight.edge=soft", "highlight.exponent=30"]),
    ];
    let rises = (300..660).map(|x| {
        let [before, after] = [&flat, &lit].map(|frame| pixel(frame, x, 310)[1]);
        assert!(after >= before, "{x}: {before} {after}");
        after - before
    });
    let rises: Vec<u8> = rises.collect();
    assert!(rises.iter().max().unwrap() > &60, "{rises:?}");
    assert!(
        rises.iter().filter(|rise| (5..50).contains(*rise)).count() > 10,
        "a gradient: {rises:?}"
    );
}

/// Black of a ball in a pattern: its share in three bands of light, and how long its edge is against its area.
fn medium(pattern: &str) -> ([f32; 3], f32) {
    let settings = ["ink.tone=hatch", "ink.hatch.spacing=10px"];
    let mut style = npr_tests::comic::style(&settings);
    style.set(&format!("ink.hatch.pattern={pattern}")).unwrap();
    let ink = Ink::of(&drawn(&ball([1.0; 3]), &style));
    let share = |x: std::ops::Range<i32>| {
        let places = x.flat_map(|x| (260..460).map(move |y| (x, y)));
        let [mut dark, mut all] = [0.0, 0.0];
        for (x, y) in places {
            dark += f32::from(u8::from(ink.at(x, y)));
            all += 1.0;
        }
        dark / all
    };
    let (mut edge, mut area) = (0.0, 0.0);
    for (x, y) in (300..600).flat_map(|x| (260..460).map(move |y| (x, y))) {
        area += f32::from(u8::from(ink.at(x, y)));
        edge += f32::from(u8::from(ink.at(x, y) != ink.at(x + 1, y)));
        edge += f32::from(u8::from(ink.at(x, y) != ink.at(x, y + 1)));
    }
    ([300..380, 440..520, 580..660].map(share), edge / area)
}

#[test]
fn pencil_is_another_texture_at_the_same_tones() {
    let ((pen, smooth), (pencil, rough)) = (medium("parallel"), medium("pencil"));
    for (pen, pencil) in pen.iter().zip(pencil) {
        assert!((pen - pencil).abs() < 0.12, "as dark: {pen} {pencil}");
    }
    assert!(
        pencil[0] > pencil[1] + 0.1 && pencil[1] > pencil[2] + 0.1,
        "{pencil:?}"
    );
    assert!(
        rough > 1.1 * smooth,
        "grain breaks strokes up: {rough} against {smooth}"
    );
}

#[test]
fn every_medium_is_one_ink_on_one_paper() {
    let (ink, paper) = ([0x10, 0x20, 0x60], [0xff, 0xf0, 0xd8]);
    for pattern in ["parallel", "cross", "stipple", "pencil", "dots", "brush"] {
        let settings = [
            "shade.paper=#fff0d8",
            "background=#fff0d8",
            "ink.color=#102060",
            "ink.tone=ink+hatch",
            "light.direction=[1,0.2,0.3]",
        ];
        let mut style = npr_tests::comic::style(&settings);
        style.set(&format!("ink.hatch.pattern={pattern}")).unwrap();
        let frame = drawn(&ball([0.1, 0.9, 0.2]), &style);
        let mut pure = [0, 0];
        for pixel in frame.rgba.as_chunks::<4>().0 {
            let [r, g, b, _] = *pixel;
            // How much ink the red says; green and blue have to say the same.
            let share = |i: usize, v: u8| {
                (linear(v) - linear(paper[i])) / (linear(ink[i]) - linear(paper[i]))
            };
            let [red, green, blue] = [share(0, r), share(1, g), share(2, b)];
            assert!(
                (red - green).abs() < 0.03 && (red - blue).abs() < 0.03,
                "{pattern}: {pixel:?}"
            );
            pure[0] += u32::from([r, g, b] == ink);
            pure[1] += u32::from([r, g, b] == paper);
        }
        assert!(
            pure.iter().all(|count| *count > 20_000),
            "{pattern}: {pure:?}"
        );
    }
}

#[test]
fn every_beam_of_the_sample_shows() {
    let scene = asset("beams.glb");
    let beams = ["Laser", "MuzzleFlash", "HitFlash", "Explosion", "Trail"];
    let model = npr_render::Model::new(&scene).unwrap();
    let camera = npr_tests::models_camera(&model, SIZE);
    let picture = |rule: &str| {
        let text = format!("extends = \"comic-light\"\n{rule}");
        let style = Style::from_toml(&text, &|_| Err(String::new())).unwrap();
        npr_tests::draw_on(
            &npr_gpu::processor::Processor,
            &model,
            &style,
            &camera,
            SIZE,
        )
    };
    let whole = picture("");
    for name in beams {
        let clear = format!(
            "[[rule]]\nmatch.object = \"{name}*\"\nbeam.ramp = [{{ at = 0.0, color = \"#00000000\" }}]\n"
        );
        let without = picture(&clear);
        let pairs = whole
            .rgba
            .as_chunks::<4>()
            .0
            .iter()
            .zip(without.rgba.as_chunks::<4>().0);
        // Light is brighter than what it lies over.
        let shown = pairs.filter(|(with, without)| {
            let sum = |pixel: &[u8; 4]| pixel[..3].iter().map(|v| u32::from(*v)).sum::<u32>();
            sum(with) > sum(without) + 60
        });
        let count = shown.count();
        println!("{name}: {count} pixels");
        assert!(count > 400, "{name} shows in {count} pixels");
    }
}

/// Share of a square of the picture that the surface-angle method inks.
fn angle_ink(scene: &Scene, camera: &Camera, settings: &[&str]) -> (Frame, usize) {
    let style = preset(
        "toon",
        &[LINES_ALONE, &["line.method=angle"], settings].concat(),
    );
    let frame = draw_from(scene, &style, camera, SIZE).frame;
    let count = Ink::of(&frame).count();
    (frame, count)
}

#[test]
fn flat_faces_have_no_surface_angle_line_however_grazing() {
    let slab = npr_tests::boxed([-1.0, -0.5, -3.0], [1.0, -0.3, 3.0]);
    let camera = Camera {
        eye: [0.0, 0.1, 6.0],
        target: [0.0, -0.4, 0.0],
        projection: Projection::Perspective { fov_y: 0.6 },
        ..front()
    };
    let of = |mesh| scene_of(&[Object::new("Thing", mesh)]);
    let wide = ["line.angle_threshold_deg=40"];
    assert_eq!(angle_ink(&of(slab), &camera, &wide).1, 0);
    let (_, round) = angle_ink(&of(icosphere(5)), &camera, &wide);
    assert!(round > 500, "a ball has: {round}");
}

#[test]
fn the_surface_angle_line_darkens_towards_the_rim_by_its_ramp() {
    let scene = ball([1.0; 3]);
    let row = |settings: &[&str]| {
        let (frame, _) = angle_ink(&scene, &front(), settings);
        // From the rim inwards: the ball ends at column 480 - 288.
        (193..480)
            .map(|x| pixel(&frame, x, 360)[0])
            .collect::<Vec<u8>>()
    };
    let inked = |row: &[u8]| row.iter().map(|v| 1.0 - linear(*v)).sum::<f32>();
    let wide = ["line.angle_threshold_deg=25", "line.width.base=40"];
    let [cut, soft] = ["0", "1"].map(|softness| {
        let softness = format!("line.angle_softness={softness}");
        row(&[&wide[..], &[softness.as_str()]].concat())
    });
    for row in [&cut, &soft] {
        assert!(
            row.windows(2).all(|pair| pair[1] >= pair[0]),
            "never darker inwards: {row:?}"
        );
        assert_eq!(row[286], 255);
    }
    assert!(
        cut[..20].iter().all(|v| *v == 0),
        "dark at the rim: {:?}",
        &cut[..40]
    );
    // The soft ramp by hand, at the middle of each pixel: N . E is the height of the ball there.
    let threshold = npr_core::math::sin(25f32.to_radians());
    for (i, value) in soft.iter().enumerate().skip(2).take(120) {
        let from_middle = (480.0 - 193.5 - i as f32) / 288.0;
        let facing = (1.0 - from_middle * from_middle).sqrt();
        let t = ((facing / threshold - 0.5) / 1.0).clamp(0.0, 1.0);
        let wanted = t * t * (3.0 - 2.0 * t);
        assert!(
            (linear(*value) - wanted).abs() < 0.05,
            "{i}: {} for {wanted}",
            linear(*value)
        );
    }
    let between = |row: &[u8]| row.iter().filter(|v| (20..235).contains(*v)).count();
    assert!(
        between(&cut) <= 2 && between(&soft) > 8,
        "{} {}",
        between(&cut),
        between(&soft)
    );
    // A cut band of 25 degrees is 1 - cos 25 of the radius wide.
    assert!(
        (inked(&cut) - 288.0 * 0.0937).abs() < 1.5,
        "{}",
        inked(&cut)
    );
    // And never wider than six lines: 2 pixels each here.
    let thin = row(&[
        "line.angle_threshold_deg=25",
        "line.width.base=2px",
        "line.width.source=constant",
        "line.angle_softness=0",
        "line.width.max=1",
    ]);
    assert!(
        inked(&thin) < 13.0 && inked(&thin) > 8.0,
        "{}",
        inked(&thin)
    );
}
