//! Keys and options that cannot act are told, once and by name.

mod case;
mod drawings;
mod films;
mod others;

use crate::trace::encoded;
use crate::workplace::Workplace;
use case::{
    Case,
    Does::{Acts, Told},
};
use clap::Command;
use drawings::DRAWINGS;
use films::ANIMATIONS;
use image::{ImageFormat, Rgb, RgbImage};
use others::{SMOKES, TRACINGS};

const SMALL: [&str; 4] = ["--size", "96x64", "--backend", "cpu"];

/// Options that change no drawing by their nature or are tested elsewhere, with the reason.
const EXCEPTIONS: &[(&str, &str)] = &[
    ("output", "it names the file"),
    ("format", "it says what the file is, whatever its name"),
    ("quiet", "it is about messages"),
    ("timings", "it is about messages"),
    (
        "resume",
        "it is about work that is done; `animate::` tests it",
    ),
    (
        "turntable",
        "it is in every film that has no --orbit, and not beside it",
    ),
    ("backend", "engines agree"),
    ("cache", "it is about time"),
    ("method", "it says where lines come from"),
    ("smooth", "`lines::` tests it"),
    (
        "camera",
        "`scenes::` tests it, and a scene without cameras refuses it",
    ),
    ("dump_style", "it prints a style in place of a drawing"),
    ("allow_external", "it is about what may be read"),
    ("memory_limit", "it is a limit"),
    ("max_file", "it is a limit"),
    ("max_json", "it is a limit"),
    ("max_json_objects", "it is a limit"),
    ("max_nodes", "it is a limit"),
    ("max_triangles", "it is a limit"),
    ("max_image_side", "it is a limit"),
    ("max_image", "it is a limit"),
    ("max_images", "it is a limit"),
    (
        "spur",
        "`trace::` tests it; without --centreline it is refused",
    ),
];

/// Blots, a speck and two corners that touch, grey at the edges.
fn blots() -> Vec<u8> {
    let gray = |x: u32, y: u32| {
        let (x, y) = (x as i32, y as i32);
        let of = |cx: i32, cy: i32, r: i32| (x - cx) * (x - cx) + (y - cy) * (y - cy) < r * r;
        let touches = (40..48).contains(&x) && (40..48).contains(&y)
            || (48..56).contains(&x) && (48..56).contains(&y);
        match () {
            () if of(16, 16, 9) || of(45, 16, 3) || touches => Rgb([0; 3]),
            () if of(16, 16, 12) => Rgb([90; 3]),
            () => Rgb([255; 3]),
        }
    };
    encoded(&RgbImage::from_fn(64, 64, gray).into(), ImageFormat::Png)
}

/// A box whose normals run on from its front to its right side, and break elsewhere, and a leaf that nearly touches
/// it.
const BOX: &[u8] = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n\
    vn 1 0 1\nvn 0 1 0\nvn 0 -1 0\nvn -1 0 0\nvn 0 0 -1\n\
    f 5//1 6//1 7//1 8//1\nf 6//1 2//1 3//1 7//1\nf 8//2 7//2 3//2 4//2\nf 1//3 2//3 6//3 5//3\n\
    f 1//4 5//4 8//4 4//4\nf 2//5 1//5 4//5 3//5\n\
    v 1.05 0 0\nv 2 0 0\nv 2 1 0\nv 1.05 1 0\nf 9//5 10//5 11//5 12//5\n";

/// Puts what moves into a folder: a wing, and an avatar with a motion and a pose.
fn put_figures(place: &Workplace) {
    place.put("wing.glb", &npr_scene::testing::wing());
    place.put(
        "avatar.vrm",
        &npr_scene::testing::avatar(npr_scene::testing::Vrm::One),
    );
    let eyes = npr_scene::Eyes::Expressions;
    let puppet = npr_scene::testing::puppet(npr_scene::testing::Vrm::One, eyes);
    place.put("puppet.vrm", &puppet);
    place.put("wave.vrma", &npr_scene::testing::gesture());
    place.put(
        "bow.json",
        br#"{"pose":{"spine":{"rotation":[0.5,0,0,0.8]}}}"#,
    );
}

fn run_all(place: &Workplace, cases: &[Case], common: &[&str]) {
    let mut wrong = Vec::new();
    for (line, option, does) in cases {
        let file = line[line
            .iter()
            .position(|word| *word == "-o")
            .expect("an output")
            + 1];
        let drawn = |words: &[&[&str]]| {
            let outcome = place.npr(&words.concat());
            assert_eq!(outcome.code, Some(0), "{words:?}: {}", outcome.stderr);
            (place.get(file), outcome.stderr)
        };
        let (before, said_before) = drawn(&[line, common]);
        // What stands in the line already is said anew.
        let (after, said) = drawn(&[&without(line, option), &without(common, option), option]);
        let is_right = match does {
            Acts => before != after,
            Told(text) => {
                let is_told_once = said.matches(text).count() == 1;
                before == after && is_told_once && !said_before.contains(text)
            }
        };
        if !is_right {
            wrong.push(format!("{line:?} {option:?}: {said}"));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// A command line without an option that `more` gives, and without its value.
fn without<'a>(line: &[&'a str], more: &[&str]) -> Vec<&'a str> {
    match line
        .iter()
        .position(|word| word.starts_with("--") && more.first() == Some(word))
    {
        Some(at) => [&line[..at], &line[at + 2..]].concat(),
        None => line.to_vec(),
    }
}

#[test]
fn options_of_drawings_act_or_are_told() {
    let place = Workplace::new();
    place.put("scene.obj", BOX);
    put_figures(&place);
    run_all(&place, DRAWINGS, &SMALL);
}

#[test]
fn options_of_films_act_or_are_told() {
    let place = Workplace::new();
    place.put("scene.obj", BOX);
    put_figures(&place);
    run_all(&place, ANIMATIONS, &SMALL);
}

#[test]
fn options_of_smoke_act_or_are_told() {
    run_all(&Workplace::new(), SMOKES, &SMALL);
}

#[test]
fn options_of_tracings_act_or_are_told() {
    let place = Workplace::new();
    place.put("blots.png", &blots());
    run_all(&place, TRACINGS, &[]);
}

#[test]
fn every_option_of_every_drawing_command_is_tried() {
    let mut command = npr_cli::command();
    command.build();
    let tried = |name: &str| {
        let cases = DRAWINGS
            .iter()
            .chain(ANIMATIONS)
            .chain(SMOKES)
            .chain(TRACINGS);
        let option = format!("--{}", name.replace('_', "-"));
        cases
            .flat_map(|(_, option, _)| option.iter())
            .any(|word| *word == option)
    };
    let mut missing = Vec::new();
    for name in ["render", "lines", "animate", "smoke", "trace"] {
        let found: &Command = command.find_subcommand(name).expect("a command");
        for option in found
            .get_arguments()
            .filter(|option| !option.is_positional())
        {
            let id = option.get_long().expect("a long name").replace('-', "_");
            let is_excused = EXCEPTIONS.iter().any(|(known, _)| *known == id)
                || ["help", "version"].contains(&id.as_str());
            if !is_excused && !tried(&id) {
                missing.push(format!("{name} --{id}"));
            }
        }
    }
    assert!(missing.is_empty(), "{missing:?}");
}

#[test]
fn brushes_are_told_where_a_file_has_even_ink() {
    let place = Workplace::with_scene();
    let brush = ["--set", "line.brush.tip=chalk", "--set", "paper.size=3px"];
    let said = |more: &[&str]| {
        let line = ["lines", "scene.obj", "--size", "48x32"];
        let outcome = place.npr(&[&line[..], &brush, more].concat());
        assert_eq!(outcome.code, Some(0));
        outcome.stderr
    };
    let wanted = "npr: warning: 'line.brush.tip' is ignored by npr lines: drawings of lines have even ink, \
                  but for --svg stamps\n\
                  npr: warning: 'paper.size' is ignored by npr lines: drawings of lines have no grain, \
                  but for --svg stamps\n";
    assert_eq!(said(&[]), wanted);
    for file in ["a.svg", "a.pdf", "a.png"] {
        assert_eq!(said(&["--svg", "stamps", "-o", file]), "", "{file}");
    }
}

#[test]
fn keys_that_cannot_act_are_told_once_and_by_name() {
    let place = Workplace::with_scene();
    let set = ["--set", "ink.tone=hatch", "--set", "shade.softness=0.2"];
    let outcome = place.npr(&[&["lines", "scene.obj", "--size", "48x32"][..], &set].concat());
    assert_eq!(outcome.code, Some(0));
    let wanted = "npr: warning: 'ink.tone' and 'shade.softness' are ignored by npr lines: \
                  it draws no tones and no hatching\n";
    assert_eq!(outcome.stderr, wanted);
    let quiet = place.npr(
        &[
            &["lines", "scene.obj", "--size", "48x32", "--quiet"][..],
            &set,
        ]
        .concat(),
    );
    quiet.assert_silent_success();
    // A preset wishes nothing.
    place
        .npr(&[
            "lines",
            "scene.obj",
            "--size",
            "48x32",
            "--style",
            "crosshatch",
        ])
        .assert_silent_success();
    place
        .render("scene.obj", &["--set", "ink.tone=hatch"])
        .assert_silent_success();
}
