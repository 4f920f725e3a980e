//! Every broken file gives a picture or one clear line, soon and in little memory.

use crate::files::{IMAGES, SCENES, VOLUMES, samples};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// Longest time that a run may take.
const TIME_LIMIT: Duration = Duration::from_secs(5);

/// Most address space that a run may ask for, in KiB.
const MEMORY_LIMIT_KIB: u32 = 1_500_000;

/// Options of small drawings without a device.
const SMALL: [&str; 4] = ["--size", "64x64", "--backend", "cpu"];

#[test]
fn info_survives_every_malformed_file() {
    for file in [malformed_files(), malformed_volumes()].concat() {
        check(&file, &["info", "--json"], None);
    }
}

#[test]
fn volumes_that_are_broken_or_hold_no_smoke_are_refused() {
    let files = [malformed_volumes(), samples("volumes", &VOLUMES)].concat();
    for command in ["render", "smoke"] {
        survives(&[&[command], &SMALL[..]].concat(), "out.png", &files);
    }
}

#[test]
fn render_survives_every_malformed_file() {
    let render = [&["render"], &SMALL[..]].concat();
    survives(&render, "out.png", &malformed_files());
}

#[test]
fn lines_survives_every_malformed_file() {
    let lines = ["lines", "--hidden", "layer", "--fill"];
    let lines = [&lines, &SMALL[..]].concat();
    survives(&lines, "out.svg", &malformed_files());
}

#[test]
fn trace_survives_every_malformed_file() {
    let files = [malformed_images(), malformed_files(), malformed_volumes()].concat();
    survives(&["trace"], "out.svg", &files);
    survives(&["trace", "--centreline"], "out.svg", &malformed_images());
}

/// Draws files; each gives a picture called `name` or nothing.
fn survives(command: &[&str], name: &str, files: &[PathBuf]) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let picture = folder.path().join(name);
    for file in files {
        let out = picture.to_string_lossy();
        let output = ["-o", out.as_ref()];
        check(file, &[command, &output].concat(), Some(&picture));
        let left = std::fs::read_dir(folder.path())
            .expect("the folder")
            .count();
        assert_eq!(left, 0, "{} left a file behind", file.display());
    }
}

/// Runs the command on a file; asserts how it ends. A picture that it made is removed.
fn check(file: &Path, arguments: &[&str], picture: Option<&Path>) {
    let start = Instant::now();
    let output = limited()
        .args(arguments)
        .arg(file)
        .stdin(Stdio::null())
        .output()
        .expect("it starts");
    let (name, stderr) = (file.display(), String::from_utf8_lossy(&output.stderr));
    assert!(
        start.elapsed() < TIME_LIMIT,
        "{name} took {:?}",
        start.elapsed()
    );
    match output.status.code() {
        Some(0) => assert!(
            stderr
                .lines()
                .all(|line| line.starts_with("npr: warning: ")),
            "{name}: {stderr}"
        ),
        Some(3 | 5) => check_refusal(file, &stderr, picture),
        other => panic!("{name} ends with {other:?}: {stderr}"),
    }
    if let Some(made) = picture.filter(|picture| picture.exists()) {
        std::fs::remove_file(made).expect("the test's own picture");
    }
}

fn check_refusal(file: &Path, stderr: &str, picture: Option<&Path>) {
    let lines: Vec<&str> = stderr
        .lines()
        .filter(|line| !line.starts_with("npr: warning: "))
        .collect();
    let name = file.file_name().expect("a name").to_string_lossy();
    assert!(
        matches!(lines[..], [line] if line.starts_with("npr: ") && line.contains(name.as_ref())),
        "{stderr}"
    );
    assert!(lines[0].chars().count() < 300, "{stderr}");
    assert!(!lines[0].contains("\\u{a}"), "{stderr}");
    assert!(
        picture.is_none_or(|picture| !picture.exists()),
        "{name} was refused but drawn"
    );
}

/// The command, with little memory where the shell can see to that.
fn limited() -> Command {
    let npr = env!("CARGO_BIN_EXE_npr");
    if !cfg!(target_os = "linux") {
        return Command::new(npr);
    }
    let mut shell = Command::new("sh");
    shell.args([
        "-c",
        &format!("ulimit -v {MEMORY_LIMIT_KIB}; exec \"$0\" \"$@\""),
        npr,
    ]);
    shell
}

/// Every malformed scene, and some of a format that is not read.
fn malformed_files() -> Vec<PathBuf> {
    samples("malformed", &[&SCENES[..], &["off"]].concat())
}

/// Every malformed volume.
fn malformed_volumes() -> Vec<PathBuf> {
    samples("malformed", &VOLUMES)
}

/// Every malformed image, and some that only a scene uses wrongly.
fn malformed_images() -> Vec<PathBuf> {
    samples("malformed", &IMAGES)
}
