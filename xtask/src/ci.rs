//! `cargo xtask ci`: what must pass before a change is handed in.

use std::path::Path;

use anyhow::{Result, bail, ensure};

use crate::packages::cargo;
use crate::{
    alone, assets, circles, constants, coverage, decoders, examples, floors, harness, licences,
    names, passes, suite,
};

/// A step: its name, and what it runs at the root of the workspace.
type Step = (&'static str, fn(&Path) -> Result<()>);

/// The steps, quick ones first.
const STEPS: [Step; 19] = [
    ("format", |root| {
        run_cargo(root, &["fmt", "--all", "--check"], &[])
    }),
    ("names", names::check),
    ("floors", floors::check),
    ("circles", circles::check),
    ("decoders", decoders::check),
    ("devices", harness::check_devices),
    ("constants", constants::check),
    ("coverage", coverage::check),
    ("passes", passes::check),
    ("assets", |root| assets::check(&root.join("assets"))),
    ("licences", licences::check),
    ("clippy", |root| run_cargo(root, &CLIPPY, &[])),
    ("features", alone::lint_features),
    ("browsers", alone::check_for_browsers),
    ("packages", alone::check_packages),
    ("docs", |root| {
        run_cargo(root, &DOCS, &[("RUSTDOCFLAGS", "-D warnings")])
    }),
    ("tests", |root| suite::run(root, &[])),
    ("properties", suite::again),
    ("examples", examples::run),
];

/// Lints of everything that compiles.
const CLIPPY: [&str; 7] = [
    "clippy",
    "--workspace",
    "--all-targets",
    "--all-features",
    "--",
    "-D",
    "warnings",
];

/// Documentation of our own crates.
const DOCS: [&str; 4] = ["doc", "--workspace", "--no-deps", "--all-features"];

/// Runs every step, whatever the others say, and fails with the names of those that failed.
pub fn run(root: &Path) -> Result<()> {
    let mut failed = Vec::new();
    for (name, step) in STEPS {
        eprintln!("\n== {name}");
        if let Err(error) = step(root) {
            eprintln!("xtask: {error:#}");
            failed.push(name);
        }
    }
    if !failed.is_empty() {
        bail!("failed: {}", failed.join(", "));
    }
    eprintln!("\nall {} steps passed", STEPS.len());
    Ok(())
}

/// Runs cargo with arguments and environment.
fn run_cargo(root: &Path, arguments: &[&str], environment: &[(&str, &str)]) -> Result<()> {
    let status = cargo(root)
        .args(arguments)
        .envs(environment.iter().copied())
        .status()?;
    ensure!(status.success(), "cargo {} failed", arguments.join(" "));
    Ok(())
}
