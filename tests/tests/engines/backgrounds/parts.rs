//! Values that a rule gives one part: it looks as if the whole style had them, and its neighbour as if nothing had.

use super::fixture::{draw, engines, pixel, places, styled, two_balls};
use npr_gpu::engine::Engine;
use npr_mesh::Mesh;
use npr_mesh::testing::{cube, mapped};
use npr_render::Frame;
use npr_scene::Scene;
use npr_stylesheet::Style;
use npr_tests::{Agreement, Object, scene_of};

const SIZE: [u32; 2] = [200, 100];

/// A key, and two of its values.
type Choice = (&'static str, [&'static str; 2]);

/// Settings in which a key shows, and the key.
type Case = (&'static [&'static str], Choice);

const CONTRAST: &[&str] = &["line.background.method='contrast'"];
const NEAR: &[&str] = &[
    "line.background.method='contrast'",
    "line.background.lightness=0.05",
];
const RIM: &[&str] = &[
    "line.background.method='contrast'",
    "line.background.lightness=0.05",
    "line.background.start='rim'",
];
const WCAG: &[&str] = &[
    "line.background.method='contrast'",
    "line.background.measure='wcag'",
];
const PUBLISHED: &[&str] = &["line.background.method='published'"];
const ALIKE: &[&str] = &[
    "line.background.method='published'",
    "line.background.likeness.rgb=1.0",
];

/// Every key of `line.background` that a rule has.
const MINDING: [Case; 14] = [
    (&[], ("line.background.method", ["'off'", "'contrast'"])),
    (
        CONTRAST,
        ("line.background.direction", ["'brighter'", "'darker'"]),
    ),
    (CONTRAST, ("line.background.lightness", ["0.25", "0.6"])),
    (
        CONTRAST,
        ("line.background.measure", ["'lightness'", "'wcag'"]),
    ),
    (WCAG, ("line.background.ratio", ["2.0", "9.0"])),
    (NEAR, ("line.background.start", ["'line'", "'rim'"])),
    (RIM, ("line.background.factor", ["0.1", "1.0"])),
    (CONTRAST, ("line.background.scope", ["'outline'", "'all'"])),
    (PUBLISHED, ("line.background.intensity", ["2.0", "5.0"])),
    (
        PUBLISHED,
        ("line.background.direction", ["'brighter'", "'darker'"]),
    ),
    (PUBLISHED, ("line.background.likeness.rgb", ["0.01", "0.9"])),
    (ALIKE, ("line.background.likeness.value", ["0.01", "0.9"])),
    (
        ALIKE,
        ("line.background.likeness.saturation", ["0.01", "0.9"]),
    ),
    (
        ALIKE,
        ("line.background.likeness.hue_deg", ["1.0", "179.0"]),
    ),
];

const SPOT: &[&str] = &["highlight.edge='soft'", "highlight.exponent=20"];
const LONG: &[&str] = &[
    "highlight.edge='soft'",
    "highlight.exponent=20",
    "highlight.stretch=0.8",
];
const BACK: &[&str] = &["highlight.back.on=true"];
const FLAT: &[&str] = &["highlight.streak.angle_deg=0", "highlight.streak.offset=0"];
const STREAK: &[&str] = &[
    "highlight.streak.on=true",
    "highlight.streak.angle_deg=0",
    "highlight.streak.offset=0",
];

const ALL_ON: &[&str] = &[
    "highlight.edge='soft'",
    "highlight.back.on=true",
    "highlight.streak.on=true",
];

/// Every key of `highlight` that a rule has.
const HIGHLIGHTS: [Case; 22] = [
    (SPOT, ("highlight.edge", ["'crisp'", "'soft'"])),
    (SPOT, ("highlight.model", ["'blinn'", "'phong'"])),
    (SPOT, ("highlight.color", ["'#ffffff'", "'#ff8000'"])),
    (SPOT, ("highlight.exponent", ["20.0", "80.0"])),
    (SPOT, ("highlight.threshold", ["0.2", "0.6"])),
    (SPOT, ("highlight.gradient", ["0.5", "4.0"])),
    (SPOT, ("highlight.shift", ["[0.0, 0.0]", "[0.3, -0.2]"])),
    (LONG, ("highlight.turn_deg", ["0.0", "60.0"])),
    (SPOT, ("highlight.stretch", ["0.0", "0.8"])),
    (SPOT, ("highlight.split", ["[0.0, 0.0]", "[0.2, 0.2]"])),
    (SPOT, ("highlight.square", ["0.0", "1.0"])),
    (&[], ("highlight.back.on", ["false", "true"])),
    (BACK, ("highlight.back.color", ["'#ffffff'", "'#40a0ff'"])),
    (
        BACK,
        (
            "highlight.back.direction",
            ["[0.7, 0.5, -0.6]", "[-0.9, 0.1, -0.5]"],
        ),
    ),
    (BACK, ("highlight.back.from", ["0.4", "0.72"])),
    (BACK, ("highlight.back.to", ["0.76", "1.0"])),
    (FLAT, ("highlight.streak.on", ["false", "true"])),
    (STREAK, ("highlight.streak.angle_deg", ["0.0", "15.0"])),
    (STREAK, ("highlight.streak.offset", ["0.0", "0.15"])),
    (STREAK, ("highlight.streak.width", ["0.1", "0.25"])),
    (STREAK, ("highlight.streak.facing", ["0.1", "0.9"])),
    // Lines that catch the light behind, from where the part has it.
    (
        &["line.paint.light.rim=1.0", "line.width.base='6px'"],
        (
            "highlight.back.direction",
            ["[0.7, 0.5, -0.6]", "[-0.9, 0.1, -0.5]"],
        ),
    ),
];

/// Two boxes seen from a corner, `Left` and `Right`, with lines within.
fn two_boxes() -> Scene {
    let turned = |x: f32| -> Mesh {
        mapped(&cube(), move |[px, py, pz]| {
            let [a, b] = [px * 0.8 + pz * 0.6, pz * 0.8 - px * 0.6];
            [
                0.42 * a + x,
                0.42 * (py * 0.8 + b * 0.6),
                0.42 * (b * 0.8 - py * 0.6),
            ]
        })
    };
    scene_of(&[
        Object::new("Left", turned(-1.2)).colored([0.008, 0.01, 0.03]),
        Object::new("Right", turned(1.2)).colored([0.03, 0.016, 0.014]),
    ])
}

fn base() -> Style {
    let settings = [
        "background='#050d09'",
        "line.color='#000000'",
        "line.width.base='4px'",
        "line.background.subjects='object'",
        "light.direction=[0.3,0.3,0.9]",
        "light.space='camera'",
    ];
    styled(Style::preset("toon").unwrap(), &settings, "")
}

/// The scene with the first values, with the second, and with the first but for a rule on the right.
fn frames(engine: &dyn Engine, scene: &Scene, settings: &[&str], choices: &[Choice]) -> [Frame; 3] {
    let all = |value: usize| -> Vec<String> {
        let chosen = choices
            .iter()
            .map(|(key, values)| format!("{key}={}", values[value]));
        settings
            .iter()
            .map(|text| (*text).to_owned())
            .chain(chosen)
            .collect()
    };
    let rule: Vec<String> = choices
        .iter()
        .map(|(key, values)| format!("{key} = {}", values[1]))
        .collect();
    let rule = format!("[[rule]]\nmatch.object = 'Right'\n{}", rule.join("\n"));
    let drawn = |settings: Vec<String>, rules: &str| {
        let settings: Vec<&str> = settings.iter().map(String::as_str).collect();
        draw(engine, scene, &styled(base(), &settings, rules), SIZE, None)
    };
    [drawn(all(0), ""), drawn(all(1), ""), drawn(all(0), &rule)]
}

/// Pixels of one half in which two frames differ.
fn apart(one: &Frame, two: &Frame, is_left: bool) -> usize {
    let half = places(SIZE).filter(|(x, _)| (*x < SIZE[0] / 2) == is_left);
    half.filter(|(x, y)| pixel(one, *x, *y) != pixel(two, *x, *y))
        .count()
}

#[track_caller]
fn check([first, second, mixed]: &[Frame; 3], what: &str) {
    for is_left in [true, false] {
        let changed = apart(first, second, is_left);
        assert!(
            changed > 10,
            "{what} changes {changed} pixels, left {is_left}"
        );
    }
    assert_eq!(
        apart(mixed, first, true),
        0,
        "{what}: the left part is as without the rule"
    );
    assert_eq!(
        apart(mixed, second, false),
        0,
        "{what}: the right part is as if all had its values"
    );
}

#[test]
fn every_value_of_how_lines_mind_the_background_may_be_a_part_s_own() {
    let scene = two_boxes();
    for (settings, choice) in MINDING {
        let (_, engine) = engines()[0];
        check(&frames(engine, &scene, settings, &[choice]), choice.0);
    }
}

#[test]
fn every_value_of_highlights_may_be_a_part_s_own() {
    let scene = two_balls();
    for (settings, choice) in HIGHLIGHTS {
        let (_, engine) = engines()[0];
        check(&frames(engine, &scene, settings, &[choice]), choice.0);
    }
}

#[test]
fn both_engines_draw_parts_of_different_values_alike() {
    let of = |cases: &[Case]| -> Vec<Choice> { cases.iter().map(|(_, choice)| *choice).collect() };
    let mut highlights = of(&HIGHLIGHTS[..21]);
    highlights.retain(|(key, _)| !key.ends_with(".on"));
    let groups: [(Scene, &[&str], Vec<Choice>); 3] = [
        (two_boxes(), CONTRAST, of(&MINDING[1..8])),
        (two_boxes(), PUBLISHED, of(&MINDING[8..])),
        (two_balls(), ALL_ON, highlights),
    ];
    for (scene, settings, choices) in groups {
        let drawn: Vec<[Frame; 3]> = engines()
            .into_iter()
            .map(|(name, engine)| {
                let frames = frames(engine, &scene, settings, &choices);
                check(&frames, &format!("{settings:?} on the {name}"));
                frames
            })
            .collect();
        if let [processor, device] = &drawn[..] {
            let agreement = Agreement::between(&processor[2], &device[2], 2);
            assert!(agreement.holds(), "{settings:?}: {agreement}");
        }
    }
}
