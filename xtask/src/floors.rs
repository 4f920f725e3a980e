//! `cargo xtask floors`: imports go down, never sideways, and the lower floors stay light.

use std::path::Path;

use anyhow::{Context, Result, bail};

use crate::packages::{Dependency, Package, linked, members};
use crate::source::{SourceFile, rust_files};

/// Which floor a crate of the workspace stands on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Floor {
    /// 0: what everything stands on.
    Ground,
    /// 1a: one domain each, without a device.
    Domain,
    /// 1b: passes and their engines.
    Passes,
    /// 2: the facade.
    Facade,
    /// 3: the command.
    Command,
    /// Suites, which may import whatever they test.
    Suites,
}

/// The floor of each crate. A crate without a line is an error.
const FLOORS: [(&str, Floor); 14] = [
    ("npr-core", Floor::Ground),
    ("npr-shaders", Floor::Ground),
    ("npr-mesh", Floor::Domain),
    ("npr-scene", Floor::Domain),
    ("npr-smoke", Floor::Domain),
    ("npr-style", Floor::Domain),
    ("npr-vdb", Floor::Domain),
    ("npr-vector", Floor::Domain),
    // These commands link nothing above the ground, so that they build fast.
    ("xtask", Floor::Domain),
    ("npr-gpu", Floor::Passes),
    ("npr-render", Floor::Facade),
    ("npr-cli", Floor::Command),
    ("npr-tests", Floor::Suites),
    ("npr-benches", Floor::Suites),
];

/// Crates that neither floor 0 nor 1a may link: devices, windows, loggers.
const HEAVY: [&str; 8] = [
    "wgpu",
    "wgpu-core",
    "wgpu-hal",
    "wgpu-types",
    "winit",
    "log",
    "env_logger",
    "tracing",
];

/// What a lower crate links all the same, and why that is harmless.
///
/// npr-vector: obvhs (hierarchies) and tiny-skia (pictures of strokes) call the facade `log`, which does nothing until a
/// program installs a logger.
const EXCUSED: [(&str, &str); 1] = [("npr-vector", "log")];

/// The condition that may stand only on the device module and its re-exports.
const DEVICE_CONDITION: &str = concat!("feature = ", "\"wgpu\"");

/// Fails with every breach of the floors in the workspace at `root`.
pub fn check(root: &Path) -> Result<()> {
    let packages = members(root)?;
    let mut faults = unsafe_faults(root)?;
    for package in &packages {
        faults.extend(import_faults(package));
        faults.extend(lint_faults(package)?);
        for file in rust_files(&package.folder().join("src"))? {
            faults.extend(condition_faults(&package.name, &file));
        }
        if floor_of(&package.name).is_some_and(|floor| floor <= Floor::Domain) {
            faults.extend(weight_faults(&package.name, &linked(root, &package.name)?));
        }
    }
    if !faults.is_empty() {
        bail!("floors are breached:\n  {}", faults.join("\n  "));
    }
    println!("floors: {} crates import downwards", packages.len());
    Ok(())
}

/// The floor of a crate of the project; nothing for a crate from elsewhere.
fn floor_of(name: &str) -> Option<Floor> {
    FLOORS
        .iter()
        .find(|(known, _)| *known == name)
        .map(|&(_, floor)| floor)
}

/// Dependencies that do not point down; tests and benches may look sideways, at generators that crates share.
fn import_faults(package: &Package) -> Vec<String> {
    let name = &package.name;
    let Some(floor) = floor_of(name) else {
        return vec![format!(
            "{name} stands on no floor; give it one in xtask/src/floors.rs"
        )];
    };
    let is_test = |dependency: &Dependency| dependency.kind.as_deref() == Some("dev");
    let points_down = |to: Floor, for_tests: bool| {
        to < floor || floor == Floor::Suites || (for_tests && to == floor)
    };
    package
        .dependencies
        .iter()
        .filter(|dependency| dependency.name != *name)
        .filter(|dependency| {
            let for_tests = is_test(dependency);
            floor_of(&dependency.name).is_some_and(|to| !points_down(to, for_tests))
        })
        .map(|dependency| format!("{name} imports {}, which is not below it", dependency.name))
        .collect()
}

/// Heavy crates among those that a crate links.
fn weight_faults(name: &str, linked: &[String]) -> Vec<String> {
    let heavy = linked
        .iter()
        .filter(|crate_name| HEAVY.contains(&crate_name.as_str()))
        .filter(|crate_name| !EXCUSED.contains(&(name, crate_name.as_str())));
    heavy.map(|heavy| format!("{name} links {heavy}")).collect()
}

/// A crate that does not inherit the workspace's lints.
fn lint_faults(package: &Package) -> Result<Option<String>> {
    let manifest = read_toml(&package.manifest_path)?;
    let inherits = manifest
        .get("lints")
        .and_then(|lints| lints.get("workspace")?.as_bool());
    Ok((inherits != Some(true)).then(|| format!("{} has its own lints", package.name)))
}

/// A workspace that does not forbid unsafe code.
fn unsafe_faults(root: &Path) -> Result<Vec<String>> {
    let manifest = read_toml(&root.join("Cargo.toml"))?;
    let level = || {
        manifest
            .get("workspace")?
            .get("lints")?
            .get("rust")?
            .get("unsafe_code")?
            .as_str()
    };
    let forbidden = level() == Some("forbid");
    Ok((!forbidden)
        .then(|| "unsafe code is not forbidden".to_owned())
        .into_iter()
        .collect())
}

/// Places where the device's feature is asked for outside `lib.rs`, or on something else there.
fn condition_faults(name: &str, file: &SourceFile) -> Vec<String> {
    let lines: Vec<&str> = file.text.lines().map(str::trim).collect();
    let is_root = file.path == Path::new("lib.rs");
    let misplaced = |i: &usize| {
        lines[*i].contains(DEVICE_CONDITION) && !(is_root && stands_on_device(&lines[*i + 1..]))
    };
    let place = |i: usize| {
        format!(
            "{name}: src/{}:{} asks for the device's feature",
            file.path.display(),
            i + 1
        )
    };
    (0..lines.len()).filter(misplaced).map(place).collect()
}

/// Whether the item that `lines` start with is the device module or a re-export from it.
fn stands_on_device(lines: &[&str]) -> bool {
    let item = lines.iter().find(|line| !line.starts_with(['#', '/']));
    let allowed = [
        "mod device;",
        "pub mod device;",
        "pub use device::",
        "pub use crate::device::",
    ];
    item.is_some_and(|item| allowed.iter().any(|start| item.starts_with(start)))
}

/// A TOML file as a tree.
fn read_toml(path: &Path) -> Result<toml::Table> {
    let text = std::fs::read_to_string(path)?;
    text.parse()
        .with_context(|| format!("cannot read '{}'", path.display()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::file::write_whole;

    fn package(name: &str, imports: &[&str]) -> Package {
        let import = |name: &&str| Dependency {
            name: (*name).to_owned(),
            kind: None,
        };
        Package {
            name: name.to_owned(),
            manifest_path: "Cargo.toml".into(),
            dependencies: imports.iter().map(import).collect(),
            publish: None,
        }
    }

    #[test]
    fn imports_may_only_go_down() {
        assert!(import_faults(&package("npr-mesh", &["npr-core", "glam"])).is_empty());
        assert_eq!(
            import_faults(&package("npr-mesh", &["npr-vector"])).len(),
            1,
            "sideways"
        );
        assert_eq!(
            import_faults(&package("npr-core", &["npr-render"])).len(),
            1,
            "upwards"
        );
        assert_eq!(
            import_faults(&package("npr-attic", &[])).len(),
            1,
            "on no floor"
        );
    }

    #[test]
    fn suites_may_import_each_other() {
        assert!(import_faults(&package("npr-tests", &["npr-cli", "npr-benches"])).is_empty());
    }

    #[test]
    fn a_logger_on_a_lower_floor_is_named() {
        let linked = ["glam", "log", "npr-mesh"].map(String::from);
        assert_eq!(weight_faults("npr-mesh", &linked), ["npr-mesh links log"]);
    }

    #[test]
    fn the_device_condition_belongs_on_the_device() {
        let condition = format!("#[cfg({DEVICE_CONDITION})]\n");
        let faults = |path: &str, item: &str| {
            let text = format!("{condition}/// Doc.\n{item}\n");
            condition_faults(
                "npr-gpu",
                &SourceFile {
                    path: path.into(),
                    text,
                },
            )
            .len()
        };
        assert_eq!(faults("lib.rs", "mod device;"), 0);
        assert_eq!(faults("lib.rs", "pub use device::Device;"), 0);
        assert_eq!(faults("lib.rs", "fn draw() {}"), 1);
        assert_eq!(faults("graph.rs", "mod device;"), 1);
    }

    #[test]
    fn lints_are_inherited_or_named() {
        let folder = tempfile::tempdir().unwrap();
        let mut member = package("npr-mesh", &[]);
        member.manifest_path = folder.path().join("Cargo.toml");
        write_whole(&member.manifest_path, b"[lints]\nworkspace = true\n").unwrap();
        assert_eq!(lint_faults(&member).unwrap(), None);
        write_whole(&member.manifest_path, b"[package]\nname = \"x\"\n").unwrap();
        assert!(lint_faults(&member).unwrap().is_some());
    }

    #[test]
    fn unsafe_code_must_be_forbidden() {
        let folder = tempfile::tempdir().unwrap();
        let manifest = folder.path().join("Cargo.toml");
        write_whole(
            &manifest,
            b"[workspace.lints.rust]\nunsafe_code = \"forbid\"\n",
        )
        .unwrap();
        assert!(unsafe_faults(folder.path()).unwrap().is_empty());
        write_whole(
            &manifest,
            b"[workspace.lints.rust]\nunsafe_code = \"warn\"\n",
        )
        .unwrap();
        assert_eq!(unsafe_faults(folder.path()).unwrap().len(), 1);
    }
}
