//! Every sample model gives a line drawing, and those with clips play.

use crate::files::{SCENES, samples, written};

#[test]
fn every_model_has_lines() {
    for file in samples("models", &SCENES) {
        let lines = ["lines", "--size", "320x240", "--quiet", "--format", "json"];
        let json = written(&lines, &file);
        let name = file.display();
        let data: serde_json::Value = serde_json::from_slice(&json).expect("JSON");
        let strokes = data["strokes"].as_array().expect("a list");
        assert!(!strokes.is_empty(), "{name} has no lines");
        let inside = |point: &serde_json::Value| {
            let [x, y] = [0, 1].map(|i| point[i].as_f64().expect("a number"));
            (-320.0..640.0).contains(&x) && (-240.0..480.0).contains(&y)
        };
        let mut points = strokes
            .iter()
            .flat_map(|stroke| stroke["points"].as_array().into_iter().flatten());
        assert!(points.all(inside), "{name} has points far outside");
    }
}

/// Crowds of faces are drawn in a gigabyte, and nobody gets a file of all that lies over black paper.
#[test]
fn crowds_of_faces_are_drawn_in_bounds() {
    for file in samples("torture", &["stl"]) {
        let lines = ["lines", "--quiet", "--memory-limit", "1G"];
        let svg = written(&lines, &file);
        assert!(svg.ends_with(b"</svg>\n"), "{}", file.display());
        assert!(
            (10_000..4_000_000).contains(&svg.len()),
            "{}",
            file.display()
        );
    }
}

/// Models with clips: skins, morphs, and parts that move.
const PLAYED: [&str; 4] = [
    "animated_morph_cube",
    "fox",
    "rigged_figure",
    "robot_animated",
];

/// Hatching, strokes and lines lie in a frame of a film where they lie in the picture of its time.
#[test]
fn a_frame_of_a_clip_is_the_picture_of_its_time() {
    let view = "--size 240x136 --quiet --backend cpu --eye 3,2,5 --target 0,1,0 --style";
    let view: Vec<&str> = view.split(' ').collect();
    let is_played = |file: &&std::path::PathBuf| {
        PLAYED
            .iter()
            .any(|name| file.file_stem().is_some_and(|stem| stem == *name))
    };
    let files = samples("models", &["glb"]);
    for file in files.iter().filter(is_played) {
        for style in ["toon", "comic-silver", "manga", "crosshatch"] {
            let drawn = |command: &[&str]| written(&[command, &view, &[style]].concat(), file);
            // Held strokes hang on the frames before, and the still has none.
            let film = ["animate", "--hold", "off", "--frames", "3", "--fps", "8"];
            let frame = drawn(&film);
            let still = drawn(&["render", "--time", "0.375"]);
            assert!(frame == still, "{} in {style}", file.display());
        }
    }
}
