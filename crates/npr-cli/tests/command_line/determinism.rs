//! The same input gives the same bytes.

use crate::workplace::{Outcome, Workplace};
use std::path::Path;

/// The project's own sample models.
const MODELS: [&str; 4] = ["cube_plane", "teapot_box_plane", "two_balls", "still_life"];

/// What a command writes of a sample model with a number of threads.
fn drawn(place: &Workplace, command: &str, model: &str, more: &[&str], threads: &str) -> Vec<u8> {
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../assets/{model}.glb"));
    let scene = scene.to_str().expect("UTF-8");
    let fixed = ["-o", "-", "--size", "160x96", "--camera", "0"];
    let mut command = place.command(&[&[command, scene], &fixed[..], more].concat());
    command
        .env("RAYON_NUM_THREADS", threads)
        .env("LC_ALL", "de_DE.UTF-8");
    let outcome = Outcome::of(command.output().expect("the command starts"));
    outcome.assert_silent_success();
    outcome.stdout
}

/// A picture with a number of threads.
fn picture(place: &Workplace, model: &str, style: &str, threads: &str) -> Vec<u8> {
    let more = ["--backend", "cpu", "--style", style];
    drawn(place, "render", model, &more, threads)
}

/// A line drawing with a number of threads.
fn lines(place: &Workplace, model: &str, more: &[&str], threads: &str) -> Vec<u8> {
    let more = [&["--hidden", "layer"], more].concat();
    drawn(place, "lines", model, &more, threads)
}

#[test]
fn pictures_are_the_same_for_any_number_of_threads() {
    let place = Workplace::new();
    for model in MODELS {
        for style in ["toon", "ink", "technical"] {
            let first = picture(&place, model, style, "1");
            for threads in ["1", "2", "8"] {
                let again = picture(&place, model, style, threads);
                assert!(
                    first == again,
                    "{model} in {style} differs with {threads} threads"
                );
            }
        }
    }
}

#[test]
fn line_drawings_are_the_same_for_any_number_of_threads() {
    let place = Workplace::new();
    for model in MODELS {
        for format in ["svg", "json", "pdf", "png"] {
            for method in ["edges", "surface"] {
                let more = ["--format", format, "--method", method, "--style", "ink"];
                let first = lines(&place, model, &more, "1");
                for threads in ["2", "8"] {
                    assert!(
                        first == lines(&place, model, &more, threads),
                        "{model} as {format} by {method} differs with {threads} threads"
                    );
                }
            }
        }
    }
}

#[test]
fn line_drawings_are_the_same_in_every_run() {
    let place = Workplace::new();
    for more in [&["--fill"][..], &["--svg", "centreline", "--page", "A4"]] {
        let first = lines(&place, "still_life", more, "8");
        for run in 0..20 {
            assert!(
                first == lines(&place, "still_life", more, "8"),
                "run {run} of {more:?}"
            );
        }
    }
}
