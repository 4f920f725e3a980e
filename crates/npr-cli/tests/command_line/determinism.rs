//! The same input gives the same bytes.

use crate::workplace::{Outcome, Workplace};
use std::path::Path;

/// The project's own sample models.
const MODELS: [&str; 4] = ["cube_plane", "teapot_box_plane", "two_balls", "still_life"];

/// A picture with a number of threads.
fn picture(place: &Workplace, model: &str, style: &str, threads: &str) -> Vec<u8> {
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../assets/{model}.glb"));
    let scene = scene.to_str().expect("UTF-8");
    let mut command = place.command(&[
        "render",
        scene,
        "-o",
        "-",
        "--size",
        "160x96",
        "--backend",
        "cpu",
    ]);
    command.args(["--style", style, "--camera", "0"]);
    command
        .env("RAYON_NUM_THREADS", threads)
        .env("LC_ALL", "de_DE.UTF-8");
    let outcome = Outcome::of(command.output().expect("the command starts"));
    outcome.assert_silent_success();
    outcome.stdout
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
