//! `cargo xtask gallery`: draws every preset on the shared models, a sheet each.

use std::path::Path;

use anyhow::{Context, Result, ensure};

use crate::packages::cargo;

/// Draws the sheets of all presets, or of those named, into `target/gallery`.
pub fn draw(root: &Path, presets: &[&str]) -> Result<()> {
    let run = [
        "run",
        "--release",
        "-p",
        "npr-benches",
        "--bin",
        "comic",
        "--",
        "gallery",
    ];
    let status = cargo(root)
        .args(run)
        .arg(root.join("target/gallery"))
        .args(presets)
        .status()
        .context("cannot run cargo")?;
    ensure!(status.success(), "the gallery was not drawn: {status}");
    Ok(())
}
