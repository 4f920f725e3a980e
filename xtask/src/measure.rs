//! `cargo xtask measure`: runs a measuring program and keeps the tables that it prints.

use std::path::Path;
use std::process::Stdio;

use anyhow::{Context, Result, ensure};

use crate::file::write_whole;
use crate::packages::cargo;

/// Where the tables of line drawings are kept.
const LINES: &str = "benches/results/lines.md";

/// Where the tables of comic pictures are kept.
const COMIC: &str = "benches/results/comic.md";

/// Where the tables of smoke are kept.
const SMOKE: &str = "benches/results/smoke.md";

/// Where the tables of outlines before backgrounds are kept.
const OUTLINE_COLOR: &str = "benches/results/outline_color.md";

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

/// What a measuring program prints, printed once more.
fn tables_of(root: &Path, program: &str, arguments: &[&str]) -> Result<Vec<u8>> {
    let output = cargo(root)
        .args([
            "run",
            "--release",
            "-p",
            "npr-benches",
            "--features",
            "wgpu",
        ])
        .args(["--bin", program])
        .arg("--")
        .args(arguments)
        .stderr(Stdio::inherit())
        .output()
        .context("cannot run cargo")?;
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
