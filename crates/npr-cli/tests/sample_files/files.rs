//! Scene files that lie beside the checkout.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Extensions of scenes that are read.
pub const SCENES: [&str; 6] = ["gltf", "glb", "vrm", "obj", "stl", "ply"];

/// Extensions of volumes that are read.
pub const VOLUMES: [&str; 2] = ["vdb", "npy"];

/// Extensions of images that are traced.
pub const IMAGES: [&str; 10] = [
    "png", "jpg", "jpeg", "webp", "tif", "tiff", "bmp", "pbm", "pgm", "ppm",
];

/// Every file below a folder of the samples that ends in one of `extensions`, in any case, sorted.
///
/// None, with a line that says so, where there is no such folder.
pub fn samples(folder: &str, extensions: &[&str]) -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/assets");
    let root = root.join(folder);
    if !root.is_dir() {
        eprintln!("skipped: there are no {folder} files beside the checkout");
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
            } else if extensions.contains(&extension.to_lowercase().as_str()) {
                files.push(path);
            }
        }
    }
    files.sort();
    files
}

/// What the command writes to standard output for a sound file; a word on standard error is a fault.
pub fn written(arguments: &[&str], file: &Path) -> Vec<u8> {
    let output = Command::new(env!("CARGO_BIN_EXE_npr"))
        .args(arguments)
        .args(["-o", "-"])
        .arg(file)
        .stdin(Stdio::null())
        .output()
        .expect("it starts");
    let name = file.display();
    assert_eq!(String::from_utf8_lossy(&output.stderr), "", "{name}");
    assert_eq!(output.status.code(), Some(0), "{name}");
    output.stdout
}
