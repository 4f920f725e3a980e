//! `cargo xtask measure`: runs a measuring program and keeps the tables that it prints.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context, Result, ensure};

use crate::file::write_whole;
use crate::packages::cargo;

/// Where the tables of line drawings are kept.
const LINES: &str = "benches/results/lines.md";

/// Where the tables of sampled sights are kept.
const SIGHTS: &str = "benches/results/sights.md";

/// Where the tables of comic pictures are kept.
const COMIC: &str = "benches/results/comic.md";

/// Where the tables of smoke are kept.
const SMOKE: &str = "benches/results/smoke.md";

/// Where the tables of outlines before backgrounds are kept.
const OUTLINE_COLOR: &str = "benches/results/outline_color.md";

/// Where the tables of dashes are kept.
const DASHES: &str = "benches/results/dashes.md";

/// Where the tables of lines that move are kept.
const MOTION: &str = "benches/results/motion.md";

/// Where the tables of ink that moves are kept.
const INK: &str = "benches/results/motion_ink.md";

/// Where the tables of frames on graphics cards are kept.
const DEVICE: &str = "benches/results/device_model.md";

/// Where the tables of tracings are kept.
const TRACE: &str = "benches/results/trace.md";

/// Where the tables of files in other viewers are kept.
const VIEWERS: &str = "benches/results/viewers.md";

/// Where the tables of the window are kept.
const VIEW: &str = "benches/results/view.md";

/// Where the tables of figures beside three-vrm are kept, and their pictures.
const MTOON: [&str; 2] = ["benches/results/mtoon.md", "benches/results/mtoon.png"];

/// A program, arguments with which it only says that it is there, and whence it comes.
type Need = (&'static str, &'static [&'static str], &'static str);

/// What the tables of files in other viewers need.
const VIEWERS_NEEDS: [Need; 4] = [
    ("resvg", &["--version"], "cargo install resvg"),
    ("chromium", &["--version"], "apt: chromium"),
    ("inkscape", &["--version"], "apt: inkscape"),
    (
        "python3",
        &["-c", "import numpy, PIL"],
        "with numpy and pillow",
    ),
];

/// What the tables of figures beside three-vrm need.
const MTOON_NEEDS: [Need; 3] = [
    ("chromium", &["--version"], "apt: chromium"),
    ("npm", &["--version"], "apt: npm"),
    (
        "python3",
        &["-c", "import numpy, PIL"],
        "with numpy and pillow",
    ),
];

/// What the tables of tracings need.
const TRACE_NEEDS: [Need; 4] = [
    ("/usr/bin/time", &["--version"], "apt: time"),
    ("potrace", &["--version"], "apt: potrace"),
    ("resvg", &["--version"], "cargo install resvg"),
    (
        "python3",
        &["-c", "import numpy, PIL, cv2, vtracer"],
        "with numpy, pillow, opencv-python-headless and vtracer",
    ),
];

/// Flags of a run that is only part of the whole, so that its tables are not kept.
const PARTIAL: [&str; 3] = ["--quick", "--only", "--strokes"];

/// Measures line drawings in release and prints the tables; those of a whole run become the results.
pub fn lines(root: &Path, arguments: &[&str]) -> Result<()> {
    let tables = tables_of(root, "lines", arguments)?;
    if keeps(arguments) {
        write_whole(&root.join(LINES), &tables)?;
    }
    Ok(())
}

/// Measures what sampled sights lose and wrongly show in release and prints the tables; those of a whole run become the
/// results.
pub fn sights(root: &Path, arguments: &[&str]) -> Result<()> {
    let tables = tables_of(root, "lines", &[&["--sights"], arguments].concat())?;
    if keeps(arguments) {
        write_whole(&root.join(SIGHTS), &tables)?;
    }
    Ok(())
}

/// Measures comic pictures in release, prints the tables and keeps them.
pub fn comic(root: &Path) -> Result<()> {
    let tables = tables_of(root, "comic", &[])?;
    write_whole(&root.join(COMIC), &tables)
}

/// Measures smoke in release, prints the tables and keeps them.
pub fn smoke(root: &Path) -> Result<()> {
    let tables = tables_of(root, "smoke", &[])?;
    write_whole(&root.join(SMOKE), &tables)
}

/// Measures outlines before backgrounds in release, prints the tables and keeps them.
pub fn outline_color(root: &Path) -> Result<()> {
    let tables = tables_of(root, "outline", &[])?;
    write_whole(&root.join(OUTLINE_COLOR), &tables)
}

/// Counts dashes in pictures of lines in release and prints the tables; those of the usual style become the results.
pub fn dashes(root: &Path, arguments: &[&str]) -> Result<()> {
    let tables = tables_of(root, "dashes", arguments)?;
    if arguments.is_empty() {
        write_whole(&root.join(DASHES), &tables)?;
    }
    Ok(())
}

/// Measures how still lines lie while cameras and figures move in release and prints the tables, then those of [`ink`];
/// those of a whole run become the results.
pub fn motion(root: &Path, arguments: &[&str]) -> Result<()> {
    let tables = tables_of(root, "motion", arguments)?;
    if keeps(arguments) {
        write_whole(&root.join(MOTION), &tables)?;
    }
    ink(root, arguments)
}

/// Measures how much ink of hatching and brushes changes without cause in release and prints the tables; those of a
/// whole run become the results.
pub fn ink(root: &Path, arguments: &[&str]) -> Result<()> {
    let tables = tables_of(root, "motion", &[&["--ink"], arguments].concat())?;
    if keeps(arguments) {
        write_whole(&root.join(INK), &tables)?;
    }
    Ok(())
}

/// Counts what a frame asks of a graphics device in release, and prints the times that this predicts on cards beside
/// those of the adapter that is there; the tables of the usual frame become the results.
pub fn device(root: &Path, arguments: &[&str]) -> Result<()> {
    let tables = tables_of(root, "device_model", arguments)?;
    if arguments.is_empty() {
        write_whole(&root.join(DEVICE), &tables)?;
    }
    Ok(())
}

/// Measures how much files of lines differ from frames in other viewers, prints the tables and keeps them.
pub fn viewers(root: &Path) -> Result<()> {
    check_needs(&VIEWERS_NEEDS)?;
    let models = root.join("../shared/assets/models");
    ensure!(models.is_dir(), "there is no {}", models.display());
    let mut program = Command::new("python3");
    program
        .arg(root.join("benches/peers/viewers.py"))
        .arg(release_npr(root)?)
        .arg(models);
    write_whole(&root.join(VIEWERS), &printed(program)?)
}

/// Measures how far figures in the preset mtoon are from those that three-vrm draws, prints the tables and keeps them.
pub fn mtoon(root: &Path) -> Result<()> {
    check_needs(&MTOON_NEEDS)?;
    let models = root.join("../shared/assets/models");
    ensure!(models.is_dir(), "there is no {}", models.display());
    let [tables, picture] = MTOON.map(|path| root.join(path));
    let mut program = Command::new("python3");
    program
        .arg(root.join("benches/peers/mtoon.py"))
        .arg(release_npr(root)?)
        .arg(models)
        .arg(picture);
    write_whole(&tables, &printed(program)?)
}

/// Measures how fast the picture of the window follows the hand in release, prints the table and keeps it.
pub fn view(root: &Path) -> Result<()> {
    let models = root.join("../shared/assets/models");
    ensure!(models.is_dir(), "there is no {}", models.display());
    let scenes = ["kenney_alien.glb", "flight_helmet.glb"].map(|name| models.join(name));
    let mut program = cargo(root);
    program
        .args(["test", "--release", "-p", "npr-cli", "--lib", "--"])
        .args(["--ignored", "--nocapture", "--exact"])
        .arg("view::tests::hand::measured")
        .env("NPR_VIEW_SCENES", std::env::join_paths(scenes)?);
    let printed = String::from_utf8(printed(program)?)?;
    let is_table = |line: &&str| line.starts_with(['#', '|', '-']) || line.is_empty();
    let lines: Vec<&str> = printed.lines().filter(is_table).collect();
    let tables = format!("{}\n", lines.join("\n").trim());
    write_whole(&root.join(VIEW), tables.as_bytes())
}

/// Measures tracings beside other programs, prints the tables and keeps them.
pub fn trace(root: &Path) -> Result<()> {
    check_needs(&TRACE_NEEDS)?;
    let shared = root.join("../shared");
    let bitmaps = shared.join("assets/bitmaps");
    ensure!(bitmaps.is_dir(), "there is no {}", bitmaps.display());
    let npr = release_npr(root)?;
    let made = tempfile::tempdir()?;
    let maker = Command::new("python3")
        .arg(shared.join("peers/make_bitmaps.py"))
        .arg(made.path())
        .stdout(Stdio::null())
        .status()?;
    ensure!(maker.success(), "make_bitmaps.py failed: {maker}");
    // As it lies where it is installed: what a linker wrote piece by piece lies in small pages of the system's cache
    // and starts slower.
    let installed = made.path().join("npr");
    std::fs::copy(npr, &installed)?;
    let mut program = Command::new("python3");
    program
        .arg(root.join("benches/peers/trace.py"))
        .arg(installed)
        .arg("--made")
        .arg(made.path())
        .args([bitmaps.join("edge_cases"), bitmaps]);
    write_whole(&root.join(TRACE), &printed(program)?)
}

/// Fails where a program is missing, and names all that are.
fn check_needs(needs: &[Need]) -> Result<()> {
    let missing: Vec<String> = needs
        .iter()
        .filter(|(program, arguments, _)| !is_there(program, arguments))
        .map(|(program, _, whence)| format!("{program} ({whence})"))
        .collect();
    ensure!(missing.is_empty(), "missing: {}", missing.join(", "));
    Ok(())
}

/// The command, built in release.
fn release_npr(root: &Path) -> Result<PathBuf> {
    let build = ["build", "--release", "-p", "npr-cli"];
    let status = cargo(root).args(build).status();
    ensure!(
        status.context("cannot run cargo")?.success(),
        "npr does not build"
    );
    let target = std::env::var_os("CARGO_TARGET_DIR");
    let target = target.map_or_else(|| root.join("target"), PathBuf::from);
    Ok(target.join("release/npr"))
}

/// Whether a program runs with some arguments.
fn is_there(program: &str, arguments: &[&str]) -> bool {
    let mut command = Command::new(program);
    command.args(arguments).stdin(Stdio::null());
    command.stdout(Stdio::null()).stderr(Stdio::null());
    command.status().is_ok_and(|status| status.success())
}

/// What a measuring program prints, printed once more.
fn tables_of(root: &Path, program: &str, arguments: &[&str]) -> Result<Vec<u8>> {
    let mut command = cargo(root);
    command
        .args(["run", "--release", "-p", "npr-benches"])
        .args(["--features", "wgpu", "--bin", program])
        .arg("--")
        .args(arguments);
    printed(command)
}

/// What a command prints, printed once more.
fn printed(mut command: Command) -> Result<Vec<u8>> {
    let output = command.stderr(Stdio::inherit()).output();
    let output = output.context("cannot run the measuring program")?;
    print!("{}", String::from_utf8_lossy(&output.stdout));
    ensure!(
        output.status.success(),
        "the measuring program failed: {}",
        output.status
    );
    Ok(output.stdout)
}

/// Whether the tables of a run become the results.
fn keeps(arguments: &[&str]) -> bool {
    !arguments.iter().any(|argument| PARTIAL.contains(argument))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_whole_runs_become_results() {
        assert!(keeps(&["--models", "assets"]) && keeps(&[]));
        assert!(!keeps(&["--models", "assets", "--quick"]));
        assert!(!keeps(&["--only", "bunny"]));
    }
}
