//! Every sample model gives a line drawing.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Extensions of scenes.
const EXTENSIONS: [&str; 6] = ["gltf", "glb", "vrm", "obj", "stl", "ply"];

#[test]
fn every_model_has_lines() {
    for file in models() {
        let output = Command::new(env!("CARGO_BIN_EXE_npr"))
            .args(["lines", "--size", "320x240", "--quiet", "-o", "-"])
            .args(["--format", "json"])
            .arg(&file)
            .stdin(Stdio::null())
            .output()
            .expect("it starts");
        let name = file.display();
        assert_eq!(String::from_utf8_lossy(&output.stderr), "", "{name}");
        assert_eq!(output.status.code(), Some(0), "{name}");
        let data: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
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

/// Every model beside the checkout; none, with a line that says so, where there are none.
fn models() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/assets/models");
    if !root.is_dir() {
        eprintln!("skipped: there are no models beside the checkout");
        return Vec::new();
    }
    let mut folders = vec![root];
    let mut files = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            let extension = path.extension().unwrap_or_default().to_string_lossy();
            if path.is_dir() {
                folders.push(path);
            } else if EXTENSIONS.contains(&extension.as_ref()) {
                files.push(path);
            }
        }
    }
    files.sort();
    files
}
