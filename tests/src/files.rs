//! Where models for tests lie.

use npr_scene::{LoadOptions, Scene, load};
use std::path::{Path, PathBuf};

/// Ending of files that can be drawn.
const ENDINGS: [&str; 6] = ["glb", "gltf", "vrm", "obj", "stl", "ply"];

/// A sample of the project, by file name.
///
/// # Panics
///
/// Where it cannot be loaded.
pub fn asset(name: &str) -> Scene {
    load(&root().join("assets").join(name), &LoadOptions::default()).expect("a sample")
}

/// The project's own samples, in order of their names.
pub fn samples() -> Vec<PathBuf> {
    models_below(&root().join("assets"))
}

/// The models beside the checkout, in order of their paths; none, said on standard error, where there is no such
/// folder.
pub fn models() -> Vec<PathBuf> {
    let folder = root().join("../shared/assets/models");
    if !folder.is_dir() {
        eprintln!("skipped: there is no folder shared/assets/models beside the checkout");
        return Vec::new();
    }
    models_below(&folder)
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn models_below(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).expect("a readable folder");
    let mut found = Vec::new();
    for path in entries.map(|entry| entry.expect("a readable folder").path()) {
        let ending = path.extension().unwrap_or_default();
        if path.is_dir() {
            found.extend(models_below(&path));
        } else if ENDINGS.iter().any(|known| ending == *known) {
            found.push(path);
        }
    }
    found.sort();
    found
}
