//! Strokes that mind what lies behind them.

use crate::scenes::{SIZE, add, camera_at, scene_of};
use npr_drawing::json::{read_json, write_json};
use npr_gpu::processor::Processor;
use npr_mesh::testing::{icosphere, mapped};
use npr_render::{
    Drawing, LineModel, LineModelOptions, LineOptions, LineRenderer, LineSource, Model, Picture,
    RendererOptions,
};
use npr_scene::Scene;
use npr_style::backdrop::{Rule, contrast};
use npr_stylesheet::Style;
use proptest::prelude::*;

const EYE: [f32; 3] = [0.0, 0.0, 5.0];

/// Black lines on dark surfaces, in front of a picture; 0.3 of lightness is wanted.
const DARK: &str = r##"
    background = "two.png"
    shade.mode = "paper"
    shade.paper = "#101010"
    shade.ramp = [{ at = 0.0, light = 1.0 }]
    light.intensity = 0.0
    antialias.samples = 1
    line.color = "#000000"
    line.background.method = "contrast"
"##;

/// Black left of a column, white from there on.
fn two_colors(split: u32) -> Picture {
    let texel = |i: u32| match i % SIZE[0] < split {
        true => [0, 0, 0, 255],
        false => [255; 4],
    };
    Picture {
        size: SIZE,
        rgba: (0..SIZE[0] * SIZE[1]).flat_map(texel).collect(),
    }
}

fn style(text: &str) -> Style {
    Style::from_toml(text, &|_| Err(String::new())).expect("a style")
}

fn drawn(
    scene: &Scene,
    style: &Style,
    eye: [f32; 3],
    split: u32,
    options: &LineOptions,
) -> Drawing {
    let lines = LineModel::for_style(scene, style, &LineModelOptions::default(), None);
    let lines = lines.expect("small");
    let model = Model::new(scene).expect("small");
    let behind = RendererOptions {
        background_image: Some(two_colors(split)),
        ..RendererOptions::new(SIZE)
    };
    let renderer = LineRenderer::new(&Processor, &lines);
    let mut renderer = renderer.with_backdrop(&model, &behind);
    renderer
        .draw(&camera_at(eye), style, options)
        .expect("drawn")
}

fn lines_of(scene: &Scene, text: &str) -> Drawing {
    drawn(
        scene,
        &style(text),
        EYE,
        SIZE[0] / 2,
        &LineOptions::new(SIZE),
    )
}

/// Every point's place and colour, sRGB-encoded; that of its surface where it has none of its own.
fn points(drawing: &Drawing) -> Vec<([f64; 2], [f32; 3])> {
    let mut found = Vec::new();
    for stroke in &drawing.strokes {
        let own = drawing.surfaces[stroke.surface as usize].line_color;
        for point in &stroke.points {
            let [r, g, b, _] = point.color.unwrap_or(own);
            found.push((
                point.position,
                [r, g, b].map(|byte| f32::from(byte) / 255.0),
            ));
        }
    }
    found
}

fn is_plain(drawing: &Drawing) -> bool {
    let points = drawing.strokes.iter().flat_map(|stroke| &stroke.points);
    !drawing.strokes.is_empty() && points.into_iter().all(|point| point.color.is_none())
}

/// Whether a colour has the contrast that is wanted, but for the rounding of bytes.
fn reads(color: [f32; 3], behind: [f32; 3]) -> bool {
    contrast(color, behind, &Rule::CONTRAST) > Rule::CONTRAST.goal - 0.01
}

/// Asserts that points read before black and keep their colour before white, but for those `near_px` to the border.
fn assert_read(drawing: &Drawing, split: u32, near_px: f64) -> Result<(), TestCaseError> {
    for (place, color) in points(drawing) {
        let off = place[0] - f64::from(split);
        if off < -near_px {
            prop_assert!(reads(color, [0.0; 3]), "{color:?} at {place:?}");
        } else if off > near_px {
            prop_assert_eq!(color, [0.0; 3], "{:?}", place);
        }
    }
    Ok(())
}

#[test]
fn a_line_lifts_before_the_dark_half_alone() {
    let scene = scene_of(&icosphere(3));
    let drawing = lines_of(&scene, DARK);
    assert_read(&drawing, SIZE[0] / 2, 8.0).expect("both halves read");
    let [left, right] = [true, false].map(|left| {
        let is_there = |(place, _): &([f64; 2], _)| (place[0] < 160.0) == left;
        points(&drawing).into_iter().filter(is_there).count()
    });
    assert!(left > 40 && right > 40, "{left} and {right} points");
    // Line data says so.
    let back = read_json(&write_json(&drawing)).expect("own output");
    let colors = |drawing: &Drawing| -> Vec<Option<[u8; 4]>> {
        let points = drawing.strokes.iter().flat_map(|stroke| &stroke.points);
        points.map(|point| point.color).collect()
    };
    assert_eq!(colors(&back), colors(&drawing));
}

#[test]
fn every_method_contrasts() {
    let scene = scene_of(&icosphere(3));
    for method in [LineSource::Edges, LineSource::Surface, LineSource::Potrace] {
        for smooth in [true, false] {
            let options = LineOptions {
                method,
                smooth,
                ..LineOptions::new(SIZE)
            };
            let drawing = drawn(&scene, &style(DARK), EYE, 160, &options);
            let lifted = points(&drawing)
                .into_iter()
                .filter(|(place, color)| place[0] < 150.0 && reads(*color, [0.0; 3]));
            let all = points(&drawing)
                .into_iter()
                .filter(|(place, _)| place[0] < 150.0);
            let (lifted, all) = (lifted.count(), all.count());
            assert!(
                all > 40 && lifted * 100 >= 97 * all,
                "{method:?}, {smooth}: {lifted} of {all}"
            );
        }
    }
}

#[test]
fn nothing_behind_and_no_backdrop_leave_lines_alone() {
    let scene = scene_of(&icosphere(2));
    assert!(is_plain(&lines_of(
        &scene,
        &DARK.replace("two.png", "transparent")
    )));
    assert!(is_plain(&lines_of(
        &scene,
        &DARK.replace("contrast", "off")
    )));
    let style = style(DARK);
    let lines = LineModel::for_style(&scene, &style, &LineModelOptions::default(), None);
    let alone = lines
        .expect("small")
        .draw(&camera_at(EYE), &style, &LineOptions::new(SIZE));
    assert!(is_plain(&alone.expect("drawn")));
}

#[test]
fn parts_follow_their_own_rules_before_their_own_backgrounds() {
    let mut scene = Scene::default();
    let ball = |size: f32, z: f32| {
        mapped(&icosphere(3), move |[x, y, d]| {
            [x * size, y * size, d * size + z]
        })
    };
    add(&mut scene, "back", &ball(1.0, 0.0));
    add(&mut scene, "front", &ball(0.4, 1.5));
    let light = DARK.replace("\"#000000\"", "\"#ffffff\"");
    let colors = "[[rule]]\nmatch.object = 'front'\nshade.color = '#101010'\n[[rule]]\nmatch.object = 'back'\n\
        shade.color = '#f4f4f4'\n";
    let of = |drawing: &Drawing, name: &str| {
        let mut only = drawing.clone();
        only.strokes
            .retain(|stroke| drawing.surfaces[stroke.surface as usize].object == name);
        only
    };
    // A white line around a dark ball does not read on a white one behind it.
    let each = lines_of(
        &scene,
        &format!("{light}line.background.subjects = 'object'\n{colors}"),
    );
    let front = points(&of(&each, "front"));
    let dark = front.iter().filter(|(_, color)| reads(*color, [0.957; 3]));
    assert!(front.len() > 40 && dark.count() == front.len());
    // As one subject they have no border between them.
    let one = lines_of(&scene, &format!("{light}\n{colors}"));
    assert!(is_plain(&of(&one, "front")) && !is_plain(&of(&one, "back")));
    let kept = lines_of(
        &scene,
        &format!(
            "{light}line.background.subjects = 'object'\n{colors}line.background.method = 'off'\n"
        ),
    );
    assert!(
        !is_plain(&of(&kept, "front")) && is_plain(&of(&kept, "back")),
        "the last rule is of the back"
    );
}

/// Two turned boxes with lines within, called `left` and `right`.
fn boxes() -> Scene {
    let mut scene = Scene::default();
    for (name, x) in [("left", -1.1), ("right", 1.1)] {
        let turned = mapped(&npr_mesh::testing::cube(), move |[px, py, pz]| {
            let [a, b] = [px * 0.8 + pz * 0.6, pz * 0.8 - px * 0.6];
            [
                0.4 * a + x,
                0.4 * (py * 0.8 + b * 0.6),
                0.4 * (b * 0.8 - py * 0.6),
            ]
        });
        add(&mut scene, name, &turned);
    }
    scene
}

/// Settings, a key that a rule has, and two of its values.
const OWN_VALUES: [(&str, &str, [&str; 2]); 14] = [
    ("", "method", ["'off'", "'contrast'"]),
    (
        "method = 'contrast'",
        "direction",
        ["'brighter'", "'darker'"],
    ),
    ("method = 'contrast'", "lightness", ["0.25", "0.6"]),
    ("method = 'contrast'", "measure", ["'lightness'", "'wcag'"]),
    (
        "method = 'contrast'; measure = 'wcag'",
        "ratio",
        ["2.0", "9.0"],
    ),
    (
        "method = 'contrast'; lightness = 0.05",
        "start",
        ["'line'", "'rim'"],
    ),
    (
        "method = 'contrast'; lightness = 0.05; start = 'rim'",
        "factor",
        ["0.1", "1.0"],
    ),
    ("method = 'contrast'", "scope", ["'outline'", "'all'"]),
    ("method = 'published'", "intensity", ["2.0", "5.0"]),
    (
        "method = 'published'",
        "direction",
        ["'brighter'", "'darker'"],
    ),
    ("method = 'published'", "likeness.rgb", ["0.01", "0.9"]),
    (
        "method = 'published'; likeness.rgb = 1.0",
        "likeness.value",
        ["0.01", "0.9"],
    ),
    (
        "method = 'published'; likeness.rgb = 1.0",
        "likeness.saturation",
        ["0.01", "0.9"],
    ),
    (
        "method = 'published'; likeness.rgb = 1.0",
        "likeness.hue_deg",
        ["1.0", "179.0"],
    ),
];

/// Every stroke of an object is as if the whole style had the object's values.
#[test]
fn every_value_may_be_a_part_s_own() {
    let scene = boxes();
    let base = "background = '#050d09'\nshade.mode = 'flat'\nlight.intensity = 0.0\nline.color = '#000000'\n\
        line.background.subjects = 'object'\n";
    let colors = "[[rule]]\nmatch.object = 'left'\nshade.color = '#161a30'\n\
        [[rule]]\nmatch.object = 'right'\nshade.color = '#301612'\n";
    let of = |drawing: &Drawing, name: &str| {
        let mut found = Vec::new();
        for stroke in &drawing.strokes {
            if drawing.surfaces[stroke.surface as usize].object == name {
                let points = stroke.points.iter();
                found.extend(points.map(|point| (point.position, point.color)));
            }
        }
        found
    };
    for (settings, key, values) in OWN_VALUES {
        let settings = settings.split("; ").filter(|setting| !setting.is_empty());
        let lines = settings.map(|setting| format!("line.background.{setting}\n"));
        let text = base.to_owned() + &lines.collect::<String>();
        let with = |value: &str| format!("{text}line.background.{key} = {value}\n");
        let [first, second] =
            values.map(|value| lines_of(&scene, &format!("{}{colors}", with(value))));
        let rule = format!("line.background.{key} = {}\n", values[1]);
        let mixed = lines_of(&scene, &format!("{}{colors}{rule}", with(values[0])));
        for name in ["left", "right"] {
            assert!(
                of(&first, name) != of(&second, name),
                "{key} acts on the {name}"
            );
        }
        assert_eq!(
            of(&mixed, "left"),
            of(&first, "left"),
            "{key} stays with the right"
        );
        assert_eq!(
            of(&mixed, "right"),
            of(&second, "right"),
            "{key} of the right"
        );
    }
}

/// Lines that catch the light behind, from where each part has it.
#[test]
fn light_from_behind_may_be_a_part_s_own() {
    let mut scene = Scene::default();
    for (name, x) in [("left", -1.1), ("right", 1.1)] {
        add(
            &mut scene,
            name,
            &mapped(&icosphere(3), move |[px, y, z]| {
                [0.6 * px + x, 0.6 * y, 0.6 * z]
            }),
        );
    }
    let base = "line = { color = '#000000', paint.light.rim = 1.0 }\n";
    let keys = "direction = [-0.9, 0.1, -0.5], color = '#40a0ff', from = 0.3, to = 0.6";
    let drawing = |text: &str| lines_of(&scene, text);
    let first = drawing(base);
    let second = drawing(&format!("{base}highlight.back = {{ {keys} }}\n"));
    let mixed = drawing(&format!(
        "{base}[[rule]]\nmatch.object = 'right'\nhighlight.back = {{ {keys} }}\n"
    ));
    let of = |drawing: &Drawing, name: &str| {
        let mut only = drawing.clone();
        only.strokes
            .retain(|stroke| drawing.surfaces[stroke.surface as usize].object == name);
        points(&only)
    };
    assert_ne!(of(&first, "left"), of(&second, "left"));
    assert_ne!(of(&first, "right"), of(&second, "right"));
    assert_eq!(of(&mixed, "left"), of(&first, "left"));
    assert_eq!(of(&mixed, "right"), of(&second, "right"));
}

#[test]
fn lines_within_follow_where_all_do() {
    let scene = scene_of(&npr_mesh::testing::cube());
    let eye = [2.0, 1.5, 4.0];
    let options = LineOptions::new(SIZE);
    let inner = |text: &str| {
        let mut drawing = drawn(&scene, &style(text), eye, 0, &options);
        drawing
            .strokes
            .retain(|stroke| stroke.kind == npr_render::Kind::Crease);
        assert!(!drawing.strokes.is_empty());
        drawing
    };
    assert!(
        is_plain(&inner(DARK))
            || points(&inner(DARK))
                .iter()
                .filter(|(_, c)| c[0] > 0.0)
                .count()
                < 20
    );
    let all = points(&inner(&format!("{DARK}\nline.background.scope = 'all'")));
    let lifted = all
        .iter()
        .filter(|(_, color)| reads(*color, [0.063; 3]))
        .count();
    assert!(lifted * 10 > all.len() * 9, "{lifted} of {}", all.len());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// From everywhere, before any two halves, smoothed or not: lines read where they did not, and stay where they did.
    #[test]
    fn lines_read_wherever_the_background_changes(
        split in 40u32..280, level in 1u32..4, smooth: bool, on_surface: bool,
        eye in prop::array::uniform2(-1.0f32..1.0),
    ) {
        let options = LineOptions {
            smooth,
            method: if on_surface { LineSource::Surface } else { LineSource::Edges },
            kinds: [npr_render::Kind::Contour].into_iter().collect(),
            ..LineOptions::new(SIZE)
        };
        let eye = [5.0 * eye[0], 4.0 * eye[1], 5.0];
        let drawing = drawn(&scene_of(&icosphere(level)), &style(DARK), eye, split, &options);
        prop_assert!(!drawing.strokes.is_empty());
        assert_read(&drawing, split, 12.0)?;
    }
}
