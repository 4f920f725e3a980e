//! Every sample model gives a line drawing.

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
