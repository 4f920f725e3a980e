//! Whole frames whose lines mind the background.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

use npr_core::camera::{Camera, Projection};
use npr_gpu::processor::Processor;
use npr_render::{Model, Picture, Stage, StageOptions};
use npr_scene::{Mesh, Node, Part, Scene};
use npr_style::Style;
use npr_style::backdrop::{Rule, contrast};

const SIZE: [u32; 2] = [240, 160];

/// Every pixel left of the middle black, all others white.
fn two_colors() -> Picture {
    let texel = |i: u32| match i % SIZE[0] < SIZE[0] / 2 {
        true => [0, 0, 0, 255],
        false => [255; 4],
    };
    Picture {
        size: SIZE,
        rgba: (0..SIZE[0] * SIZE[1]).flat_map(texel).collect(),
    }
}

/// A square of one unit to each side of the middle for every name, each nearer than the last and half as large.
fn squares(names: &[&str]) -> Model {
    let mut scene = Scene::default();
    for (i, name) in names.iter().enumerate() {
        let (half, z) = (0.5f32.powi(i as i32), i as f32 * 0.3);
        let corner = |x: f32, y: f32| [x * half, y * half, z];
        let part = Part {
            positions: vec![
                corner(-1.0, -1.0),
                corner(1.0, -1.0),
                corner(1.0, 1.0),
                corner(-1.0, 1.0),
            ],
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            ..Part::default()
        };
        scene.meshes.push(Mesh {
            name: String::new(),
            parts: vec![part],
        });
        scene.nodes.push(Node {
            name: (*name).to_owned(),
            mesh: Some(i as u32),
            ..Node::default()
        });
    }
    Model::new(&scene).unwrap()
}

fn style(text: &str) -> Style {
    let base = r##"
        background = "two.png"
        shade.mode = "paper"
        shade.paper = "#101010"
        light.intensity = 0.0
        antialias.samples = 1
        [line]
        color = "#000000"
        width = { base = "4px", source = "constant", min = 1.0, max = 1.0 }
        background.method = "contrast"
    "##;
    let style = Style::from_toml(base, &|_| Err(String::new())).unwrap();
    text.lines()
        .map(str::trim)
        .filter(|line| !line.is_empty())
        .fold(style, |mut style, line| {
            style.set(line).unwrap();
            style
        })
}

fn with_rules(text: &str, rules: &str) -> Style {
    let toml = format!("{}\n{rules}", style(text).to_toml().unwrap());
    Style::from_toml(&toml, &|_| Err(String::new())).unwrap()
}

fn draw(model: &Model, style: &Style, tile_pixels: u32) -> Vec<[u8; 4]> {
    let options = StageOptions {
        background_image: Some(two_colors()),
        tile_pixels,
        ..StageOptions::new(SIZE)
    };
    let camera = Camera {
        eye: [0.0, 0.0, 5.0],
        target: [0.0; 3],
        up: [0.0, 1.0, 0.0],
        projection: Projection::Parallel { height: 3.0 },
    };
    let frame = Stage::new(&Processor, model, style, &options)
        .unwrap()
        .draw(&camera)
        .unwrap();
    frame
        .rgba
        .chunks_exact(4)
        .map(|texel| texel.try_into().unwrap())
        .collect()
}

fn at(frame: &[[u8; 4]], x: u32, y: u32) -> [f32; 3] {
    let [r, g, b, _] = frame[(y * SIZE[0] + x) as usize];
    [r, g, b].map(|byte| f32::from(byte) / 255.0)
}

/// Columns of the left and of the right side of the largest square: 1 unit is 53.3 pixels.
const SIDES: [u32; 2] = [66, 173];

const ALL: u32 = 4_000_000;

#[test]
fn a_black_line_lifts_before_black_and_stays_before_white_by_every_method() {
    let model = squares(&["hero"]);
    for method in ["shape", "okuya", "filter", "edges", "filter+hull"] {
        let frame = draw(&model, &style(&format!("line.method={method}")), ALL);
        // Across the border; the surface itself reads by half as much. A flat square has no hull.
        let across = SIDES[0] - 4..SIDES[0] + 2;
        let reads = across.map(|x| contrast(at(&frame, x, 80), [0.0; 3], &Rule::CONTRAST));
        let reads = reads.fold(0.0, f32::max);
        assert!(reads > 0.2, "{method}: {reads}");
        // Outside of the shape, where only the line may lie.
        let right = (174..177).map(|x| at(&frame, x, 80)[0]).fold(1.0, f32::min);
        assert!(
            right < 0.1 || method.starts_with("filter"),
            "{method}: {right}"
        );
    }
}

#[test]
fn the_publication_s_outline_is_a_pixel_wide_and_multiplies_the_rim() {
    let text = "line.method=rim\nline.background.method=published\nline.background.direction=brighter\nline.background.intensity=4";
    let frame = draw(&squares(&["hero"]), &style(text), ALL);
    let row: Vec<u8> = (0..SIZE[0])
        .map(|x| frame[(80 * SIZE[0] + x) as usize][0])
        .collect();
    let brightened: Vec<usize> = (0..120).filter(|x| row[*x] > 20).collect();
    assert_eq!(brightened.len(), 1, "{row:?}");
    assert_eq!(row[brightened[0]], 4 * row[brightened[0] + 1]);
    assert_eq!((120..240).filter(|x| row[*x] == 0).count(), 1, "{row:?}");
}

#[test]
fn parts_keep_their_line_by_rule_and_belong_to_subjects_by_name() {
    let model = squares(&["body", "hair"]);
    // The small square lies before the large one: a border of two subjects, all dark.
    let [_, inner] = [66, 93];
    let reads = |frame: &[[u8; 4]], x: u32| {
        contrast(at(frame, x, 80), at(frame, x + 8, 80), &Rule::CONTRAST)
    };
    let roots = "line.background.subjects=root";
    let apart = draw(&model, &style(roots), ALL);
    assert!(
        reads(&apart, inner) > 0.2,
        "subjects of their own: {}",
        reads(&apart, inner)
    );
    let hair = "[[rule]]\nmatch.object = \"hair\"\n";
    let kept = draw(
        &model,
        &with_rules(roots, &format!("{hair}line.background.method = \"off\"\n")),
        ALL,
    );
    assert!(
        reads(&kept, inner) < 0.2,
        "hair keeps its line: {}",
        reads(&kept, inner)
    );
    let one = draw(
        &model,
        &with_rules(roots, "[[rule]]\nsubject = \"hero\"\n"),
        ALL,
    );
    assert!(
        reads(&one, inner) < 0.2,
        "one subject: {}",
        reads(&one, inner)
    );
    let all = with_rules(
        "line.background.scope=all",
        "[[rule]]\nsubject = \"hero\"\n",
    );
    let all = draw(&model, &all, ALL);
    assert!(
        reads(&all, inner) > 0.2,
        "lines within it too: {}",
        reads(&all, inner)
    );
    let ground = draw(
        &model,
        &with_rules(roots, "[[rule]]\nsubject = \"background\"\n"),
        ALL,
    );
    let off = draw(&model, &style("line.background.method=off"), ALL);
    assert_eq!(ground, off, "all background: nothing adapts");
}

#[test]
fn nothing_behind_and_nothing_before_leave_lines_alone() {
    for model in [squares(&["hero"]), squares(&[])] {
        let [on, off] = ["contrast", "off"].map(|method| {
            let text = format!("background=transparent\nline.background.method={method}");
            draw(&model, &style(&text), ALL)
        });
        assert_eq!(on, off);
    }
}

#[test]
fn tiles_do_not_show() {
    let model = squares(&["body", "hair"]);
    for text in [
        "",
        "line.background.scope=all\nantialias.samples=4",
        "line.method=rim",
    ] {
        let style = style(text);
        let whole = draw(&model, &style, ALL);
        assert_eq!(whole, draw(&model, &style, 9000), "{text}");
    }
}

/// What was decided for one view must not show in another: a still scene stays still, and a cut starts anew.
#[test]
fn still_frames_are_alike_and_cuts_start_anew() {
    let model = squares(&["body", "hair"]);
    let style = style("line.background.start=rim\nline.background.hold=2");
    let options = StageOptions {
        background_image: Some(two_colors()),
        ..StageOptions::new(SIZE)
    };
    let camera = |x: f32| Camera {
        eye: [x, 0.0, 5.0],
        target: [x, 0.0, 0.0],
        up: [0.0, 1.0, 0.0],
        projection: Projection::Parallel { height: 3.0 },
    };
    let fresh = |x: f32| {
        let mut stage = Stage::new(&Processor, &model, &style, &options).unwrap();
        stage.draw(&camera(x)).unwrap().rgba
    };
    let mut stage = Stage::new(&Processor, &model, &style, &options).unwrap();
    for x in [0.0, 0.0, 0.0, 1.0, 1.0, -0.5] {
        assert_eq!(stage.draw(&camera(x)).unwrap().rgba, fresh(x), "at {x}");
    }
}
