//! The workspace as cargo sees it.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, ensure};
use serde::Deserialize;

/// A member of the workspace.
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
pub struct Package {
    /// Its name.
    pub name: String,
    /// Its version.
    pub version: String,
    /// Its features, and what each switches on.
    pub features: BTreeMap<String, Vec<String>>,
    /// Its `Cargo.toml`.
    pub manifest_path: PathBuf,
    /// What it asks for, of every kind.
    pub dependencies: Vec<Dependency>,
    /// Registries it may go to; an empty list where it is not published.
    pub publish: Option<Vec<String>>,
}

/// A line of a package's dependency tables.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Dependency {
    /// The name of the package asked for.
    pub name: String,
    /// "dev" or "build"; nothing for a normal dependency.
    pub kind: Option<String>,
}

impl Package {
    /// The folder of its manifest.
    pub fn folder(&self) -> &Path {
        self.manifest_path.parent().unwrap_or(&self.manifest_path)
    }

    /// Whether it is meant for others.
    pub fn is_published(&self) -> bool {
        self.publish
            .as_ref()
            .is_none_or(|registries| !registries.is_empty())
    }
}

/// The members of the workspace at `root`, by name.
pub fn members(root: &Path) -> Result<Vec<Package>> {
    /// The part of `cargo metadata` that is read.
    #[derive(Deserialize)]
    struct Metadata {
        /// The members, since dependencies are left out.
        packages: Vec<Package>,
    }
    let text = output(cargo(root).args(["metadata", "--format-version", "1", "--no-deps"]))?;
    let mut packages = serde_json::from_str::<Metadata>(&text)?.packages;
    packages.sort_by(|a, b| a.name.cmp(&b.name));
    Ok(packages)
}

/// Features that open a window. Their libraries take minutes to compile, and no test needs them: they are linted with
/// the workspace.
pub const WINDOWS: [(&str, &str); 2] = [("npr-view", "window"), ("npr-cli", "view")];

/// Every feature of every member but [`WINDOWS`], as `--features` of cargo takes them.
pub fn tested_features(root: &Path) -> Result<String> {
    let mut all = Vec::new();
    for package in members(root)? {
        let features = package.features.keys().map(String::as_str);
        let is_tested = |feature: &&str| !WINDOWS.contains(&(package.name.as_str(), feature));
        all.extend(
            features
                .filter(is_tested)
                .map(|feature| format!("{}/{feature}", package.name)),
        );
    }
    Ok(all.join(","))
}

/// With which features a package is built.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Features {
    /// Neither optional nor default ones.
    None,
    /// Every one.
    All,
}

/// The names of all packages that `name` links, itself among them.
pub fn linked(root: &Path, name: &str, features: Features) -> Result<Vec<String>> {
    let features = match features {
        Features::None => "--no-default-features",
        Features::All => "--all-features",
    };
    let tree = ["tree", "--edges", "normal", "--prefix", "none", features];
    let text = output(cargo(root).args(tree).args(["--package", name]))?;
    Ok(names_in_tree(&text))
}

/// The first word of each line, each once.
fn names_in_tree(text: &str) -> Vec<String> {
    let words = text
        .lines()
        .filter_map(|line| line.split_whitespace().next());
    let mut names: Vec<String> = words.map(String::from).collect();
    names.sort();
    names.dedup();
    names
}

/// A cargo to be run at `root`: the one that runs this program, where there is one.
pub fn cargo(root: &Path) -> Command {
    let program = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(program);
    command.current_dir(root);
    command
}

/// What a command writes to standard output; its messages pass through.
pub fn output(command: &mut Command) -> Result<String> {
    let called = format!("{command:?}");
    let output = command.stderr(std::process::Stdio::inherit()).output();
    let output = output.with_context(|| format!("cannot run {called}"))?;
    ensure!(
        output.status.success(),
        "{called} failed: {}",
        output.status
    );
    Ok(String::from_utf8(output.stdout)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_from_a_tree() {
        let tree = "npr-mesh v0.1.0 (a/b)\nglam v0.33.2\nlibm v0.2.1\nglam v0.33.2 (*)\n\n";
        assert_eq!(names_in_tree(tree), ["glam", "libm", "npr-mesh"]);
    }
}
