//! `cargo xtask measure`: runs a measuring program and keeps the tables that it prints.

use std::path::Path;
use std::process::Stdio;

use anyhow::{Context, Result, ensure};

use crate::file::write_whole;
use crate::packages::cargo;

/// Where the tables of line drawings are kept.
const LINES: &str = "benches/results/lines.md";

/// Flags of a run that is only part of the whole, so that its tables are not kept.
const PARTIAL: [&str; 3] = ["--quick", "--only", "--strokes"];

/// Measures line drawings in release and prints the tables; those of a whole run become the results.
pub fn lines(root: &Path, arguments: &[&str]) -> Result<()> {
    let run = [
        "run",
        "--release",
        "-p",
        "npr-benches",
        "--bin",
        "lines",
        "--",
    ];
    let output = cargo(root)
        .args(run)
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
    if keeps(arguments) {
        write_whole(&root.join(LINES), &output.stdout)?;
    }
    Ok(())
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
