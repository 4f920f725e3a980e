//! Strokes of single parts that rules give a pressure, a taper, a hand or dashes of their own.

use npr_gpu::engine::Engine;
use npr_gpu::processor::Processor;
use npr_render::{Frame, LineOptions, RendererOptions, Subject};
use npr_scene::Scene;
use npr_stylesheet::Style;
use npr_tests::comic::{SIZE, front};
use npr_tests::{Agreement, Object, boxed, device, lines, scene_of};
use npr_vector::stroke::Stroke;
use std::ops::Range;

/// Keys and values, each of which strokes of boxes show.
const MANNERS: [(&str, &str); 7] = [
    ("line.dash.pattern", "['24px', '16px']"),
    ("line.hand.wobble", "'9px'"),
    ("line.hand.copies", "3"),
    ("line.hand.overshoot", "'20px'"),
    ("line.hand.undershoot", "'20px'"),
    ("line.width.taper.start", "'60px'"),
    (
        "line.width.pressure",
        "[{ at = 0.0, factor = 0.3 }, { at = 1.0, factor = 1.5 }]",
    ),
];

/// Two boxes beside each other; between the columns of [`SIDES`] nothing is drawn.
fn scene() -> Scene {
    scene_of(&[
        Object::new("Left", boxed([-1.1, -0.5, -0.4], [-0.3, 0.5, 0.4])),
        Object::new("Right", boxed([0.3, -0.5, -0.4], [1.1, 0.5, 0.4])),
    ])
}

/// Strokes of which each is a side of a box.
fn style(settings: &[String]) -> Style {
    let mut style = lines("strokes");
    let own = [
        "line.width.base=5px",
        "line.split_angle_deg=60",
        "line.width.taper.ends=all",
        "line.hand.spread=6px",
    ];
    for setting in own
        .into_iter()
        .chain(settings.iter().map(|setting| &setting[..]))
    {
        style.set(setting).unwrap();
    }
    style
}

/// The style with a rule that gives the right box a manner.
fn with_rule((key, value): (&str, &str), settings: &[String]) -> Style {
    let mut style = style(settings);
    let rule = format!("[[rule]]\nmatch.object = 'Right'\n{key} = {value}");
    style.rule = Style::from_toml(&rule, &|_| Err(String::new()))
        .unwrap()
        .rule;
    style
}

fn drawn(engine: &dyn Engine, style: &Style) -> Frame {
    let scene = scene();
    let subject = Subject::new(&scene, style).unwrap();
    let options = RendererOptions::new(SIZE);
    let mut renderer = subject.renderer(engine, style, &options).unwrap();
    renderer.draw(&front()).unwrap()
}

/// Number of pixels of some columns that differ.
fn differ(one: &Frame, other: &Frame, columns: Range<usize>) -> usize {
    let pixels = one.rgba.chunks(4).zip(other.rgba.chunks(4)).enumerate();
    pixels
        .filter(|(slot, (a, b))| columns.contains(&(slot % SIZE[0] as usize)) && a != b)
        .count()
}

#[test]
fn a_rule_gives_a_part_a_manner_of_its_own() {
    let half = SIZE[0] as usize / 2;
    let (left, right) = (0..half, half..SIZE[0] as usize);
    for visibility in ["exact", "sampled"] {
        let settings = [format!("line.visibility={visibility}")];
        let plain = drawn(&Processor, &style(&settings));
        for (key, value) in MANNERS {
            let manner = format!("{key}={value}");
            let all = drawn(&Processor, &style(&[settings[0].clone(), manner.clone()]));
            let mixed = drawn(&Processor, &with_rule((key, value), &settings));
            let of = |other: &Frame, columns: &Range<usize>| differ(&mixed, other, columns.clone());

            // What dashes and ends need is an exact sight, which may cover some pixels otherwise than a sampled one.
            let is_exact =
                visibility == "exact" || !(key.contains("dash") || key.contains("shoot"));
            if is_exact {
                assert_eq!(of(&plain, &left), 0, "{manner} on the left, {visibility}");
            }
            assert_eq!(of(&all, &right), 0, "{manner} on the right, {visibility}");
            assert!(
                of(&all, &left) > 100,
                "{manner} of all on the left, {visibility}"
            );
            assert!(of(&plain, &right) > 100, "{manner} shows, {visibility}");
        }
    }
}

#[test]
fn a_drawing_has_the_manners_of_its_parts() {
    let scene = scene();
    let of_part = |style: &Style, object: &str| -> Vec<Stroke> {
        let subject = Subject::new(&scene, style).unwrap();
        let options = LineOptions::of_style(style, SIZE);
        let lines = subject.lines.as_ref().unwrap();
        let drawing = lines.draw(&front(), style, &options).unwrap();
        let is_own = |stroke: &Stroke| drawing.surfaces[stroke.surface as usize].object == object;
        drawing
            .strokes
            .iter()
            .filter(|stroke| is_own(stroke))
            .cloned()
            .collect()
    };
    let plain = style(&[]);
    for (key, value) in MANNERS {
        let all = style(&[format!("{key}={value}")]);
        let mixed = with_rule((key, value), &[]);
        assert_eq!(of_part(&mixed, "Left"), of_part(&plain, "Left"), "{key}");
        assert_eq!(of_part(&mixed, "Right"), of_part(&all, "Right"), "{key}");
        assert_ne!(of_part(&all, "Right"), of_part(&plain, "Right"), "{key}");
    }
}

#[test]
fn engines_draw_the_same_manners() {
    let Some(device) = device() else {
        return;
    };
    for visibility in ["exact", "sampled"] {
        let settings = [format!("line.visibility={visibility}")];
        for manner in [MANNERS[1], MANNERS[5], MANNERS[6]] {
            let style = with_rule(manner, &settings);
            let [one, other] =
                [&Processor as &dyn Engine, device].map(|engine| drawn(engine, &style));
            let agreement = Agreement::between(&one, &other, 2);
            assert!(agreement.holds(), "{} {visibility}: {agreement}", manner.0);
        }
    }
}

/// A rule whose pressure runs back is refused, as that of the style is.
#[test]
fn a_rule_with_unsorted_pressure_is_refused() {
    let text =
        "[[rule]]\nline.width.pressure = [{ at = 0.9, factor = 1 }, { at = 0.1, factor = 1 }]";
    let error = Style::from_toml(text, &|_| Err(String::new())).unwrap_err();
    assert!(
        error.to_string().contains("rule.0.line.width.pressure"),
        "{error}"
    );
}

/// With a greatest length no stroke is longer, and no ink is lost.
#[test]
fn long_lines_are_drawn_in_several_strokes() {
    let scene = scene();
    let strokes = |settings: &[String]| {
        let style = style(settings);
        let subject = Subject::new(&scene, &style).unwrap();
        let options = LineOptions::of_style(&style, SIZE);
        subject
            .lines
            .as_ref()
            .unwrap()
            .draw(&front(), &style, &options)
            .unwrap()
            .strokes
    };
    let lengths = |strokes: &[Stroke]| strokes.iter().map(Stroke::length).collect::<Vec<f64>>();
    let whole = lengths(&strokes(&[]));
    let cut = lengths(&strokes(&["line.longest=30px".to_owned()]));
    assert!(whole.iter().any(|length| *length > 60.0));
    assert!(cut.iter().all(|length| *length <= 30.0 + 1e-6));
    let [before, after] = [&whole, &cut].map(|lengths| lengths.iter().sum::<f64>());
    assert!((before - after).abs() < 1e-3 * before, "{before} {after}");
    let frames = [&[][..], &["line.longest=30px".to_owned()]].map(|s| drawn(&Processor, &style(s)));
    assert!(
        differ(&frames[0], &frames[1], 0..SIZE[0] as usize) < 200,
        "round ends close the cuts"
    );
}

/// At twice the scale strokes are twice as wide, and what they sway by is twice as much.
#[test]
fn the_scale_of_strokes_scales_all_their_lengths() {
    let twice = [
        "line.scale=2",
        "line.width.base=5px",
        "line.hand.wobble=4px",
        "line.width.taper.start=30px",
    ];
    let plain = [
        "line.scale=1",
        "line.width.base=10px",
        "line.hand.wobble=8px",
        "line.width.taper.start=60px",
    ];
    let common = [
        "line.hand.wave=200px",
        "line.hand.spread=6px",
        "line.hand.copies=2",
    ];
    let halved = [
        "line.hand.wave=100px",
        "line.hand.spread=3px",
        "line.hand.copies=2",
    ];
    let of = |own: &[&str], rest: &[&str]| {
        let settings: Vec<String> = own.iter().chain(rest).map(|s| (*s).to_owned()).collect();
        drawn(&Processor, &style(&settings))
    };
    assert!(of(&twice, &halved).rgba == of(&plain, &common).rgba);
}

/// A frame of strokes that are enlarged is the small frame, pixel by pixel the mean of what the large one has there.
#[test]
fn an_enlarged_frame_is_the_same_drawing() {
    const BY: u32 = 3;
    let scene = scene();
    let size = SIZE.map(|side| side * BY);
    let darkness = |frame: &Frame| -> Vec<f64> {
        let pixels = frame.rgba.chunks(4);
        pixels
            .map(|pixel| 1.0 - f64::from(pixel[1]) / 255.0)
            .collect()
    };
    for visibility in ["exact", "sampled"] {
        let sight = format!("line.visibility={visibility}");
        let settings = [
            "line.hand.wobble=6px",
            "line.width.taper.start=60px",
            "line.hand.copies=2",
            &sight,
        ];
        let style = style(&settings.map(str::to_owned));
        let subject = Subject::new(&scene, &style).unwrap();
        let small = darkness(&drawn(&Processor, &style));
        let large = |enlarged: u32| {
            let options = RendererOptions {
                enlarged,
                ..RendererOptions::new(size)
            };
            let mut renderer = subject.renderer(&Processor, &style, &options).unwrap();
            darkness(&renderer.draw(&front()).unwrap())
        };
        let apart = |large: &[f64]| {
            let mean = |slot: usize| {
                let [x, y] = [slot as u32 % SIZE[0], slot as u32 / SIZE[0]];
                let at = |i: u32| large[((y * BY + i / BY) * size[0] + x * BY + i % BY) as usize];
                (0..BY * BY).map(at).sum::<f64>() / f64::from(BY * BY)
            };
            let all = small.iter().enumerate();
            all.map(|(slot, ink)| (ink - mean(slot)).abs()).sum::<f64>() / small.iter().sum::<f64>()
        };
        let [same, other] = [BY, 1].map(|enlarged| apart(&large(enlarged)));
        assert!(
            same < 0.05,
            "{same} of the ink lies elsewhere, {visibility}"
        );
        assert!(other > 0.3, "as its own drawing {other} does, {visibility}");
    }
}
