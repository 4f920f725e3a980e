//! Crates as their users get them: linted with one feature at a time, checked for browsers, packed and checked from
//! their packages.

use std::path::Path;
use std::process::Command;

use anyhow::{Context, Result, ensure};

use crate::file::write_whole;
use crate::packages::{Package, WINDOWS, cargo, members, output};

/// The target of browsers.
const BROWSERS: &str = "wasm32-unknown-unknown";

/// Lints every published crate without features, and with each of its features alone but for [`WINDOWS`].
///
/// The workspace as a whole hides what a crate lacks when nobody else asks for it.
pub fn lint_features(root: &Path) -> Result<()> {
    for package in published(root)? {
        let is_alone = |name: &&String| {
            let opens_window = WINDOWS.contains(&(package.name.as_str(), name.as_str()));
            *name != "default" && !opens_window
        };
        let own = package.features.keys().filter(is_alone);
        let alone = own.map(|name| vec!["--features", name.as_str()]);
        for feature in [Vec::new()].into_iter().chain(alone) {
            let name = ["--package", package.name.as_str()];
            let lints = ["--", "-D", "warnings"];
            let mut command = cargo(root);
            command.args(["clippy", "--quiet", "--no-default-features"]);
            let status = command.args(name).args(&feature).args(lints).status()?;
            ensure!(
                status.success(),
                "{} fails alone with {feature:?}",
                package.name
            );
        }
    }
    Ok(())
}

/// Checks that every published library compiles for browsers without its default features, where the compiler has
/// that target.
pub fn check_for_browsers(root: &Path) -> Result<()> {
    let ask = ["--print", "target-libdir", "--target", BROWSERS];
    let folder = output(Command::new("rustc").current_dir(root).args(ask))?;
    if !Path::new(folder.trim()).is_dir() {
        println!(
            "browsers: the compiler has no target {BROWSERS}; `rustup target add {BROWSERS}` gives it one"
        );
        return Ok(());
    }
    let libraries = published(root)?
        .into_iter()
        .filter(|package| package.name != "npr-cli");
    let names = libraries.flat_map(|package| ["--package".to_owned(), package.name]);
    let mut command = cargo(root);
    command.args([
        "check",
        "--quiet",
        "--lib",
        "--no-default-features",
        "--target",
        BROWSERS,
    ]);
    let status = command.args(names).status()?;
    ensure!(status.success(), "a library does not compile for browsers");
    Ok(())
}

/// Packs every published crate, and checks that what is in the packages compiles without the rest of the checkout.
pub fn check_packages(root: &Path) -> Result<()> {
    // Pack the crates.
    let packages = published(root)?;
    let folder = root.join("target/packed");
    let target = ["--target-dir", "target"];
    let names = packages
        .iter()
        .flat_map(|package| ["--package", package.name.as_str()]);
    let mut command = cargo(root);
    command
        .args(["package", "--quiet", "--no-verify", "--allow-dirty"])
        .args(target);
    let status = command.args(names).status()?;
    ensure!(status.success(), "cargo package failed");

    // Unpack them into a workspace of their own, which takes each from its package and not from a registry.
    if folder.exists() {
        std::fs::remove_dir_all(&folder)?;
    }
    std::fs::create_dir_all(&folder)?;
    let manifest = std::fs::read_to_string(root.join("Cargo.toml"))?;
    let profiles = manifest
        .find("[profile.dev]")
        .context("the workspace has profiles")?;
    let mut own =
        "[workspace]\nresolver = \"3\"\nmembers = [\"*\"]\n\n[patch.crates-io]\n".to_owned();
    for Package { name, version, .. } in &packages {
        let packed = root.join(format!("target/package/{name}-{version}.crate"));
        let mut tar = Command::new("tar");
        tar.current_dir(&folder).arg("xzf").arg(packed);
        ensure!(tar.status()?.success(), "cannot unpack {name}");
        own += &format!("{name} = {{ path = \"{name}-{version}\" }}\n");
    }
    own += "\n";
    own += &without_absent(&manifest[profiles..], &packages);
    write_whole(&folder.join("Cargo.toml"), own.as_bytes())?;
    std::fs::copy(root.join("Cargo.lock"), folder.join("Cargo.lock"))?;

    // Check them there, with the target folder of the checkout, which holds what others wrote.
    let mut command = cargo(&folder);
    command.args([
        "check",
        "--quiet",
        "--workspace",
        "--lib",
        "--bins",
        "--target-dir",
    ]);
    let status = command.arg(root.join("target")).status()?;
    ensure!(status.success(), "a package lacks what it needs");
    println!(
        "packages: {} crates compile from what is packed",
        packages.len()
    );
    Ok(())
}

/// The profiles of a manifest but for those of our own packages that are not published.
fn without_absent(profiles: &str, published: &[Package]) -> String {
    let is_kept = |section: &&str| {
        let name = section
            .strip_prefix("[profile.dev.package.")
            .and_then(|rest| rest.split(']').next());
        let is_own = name.is_some_and(|name| name.starts_with("npr-") || name == "xtask");
        !is_own || published.iter().any(|package| name == Some(&package.name))
    };
    profiles.split_inclusive("\n\n").filter(is_kept).collect()
}

/// The crates that are meant for others.
fn published(root: &Path) -> Result<Vec<Package>> {
    let mut packages = members(root)?;
    packages.retain(Package::is_published);
    Ok(packages)
}
