//! `cargo xtask floors`: crates import what is listed, downwards, and the lower ones stay light.

use std::path::Path;

use anyhow::{Context, Result, bail};

use crate::packages::{Dependency, Features, Package, linked, members};
use crate::source::{SourceFile, rust_files};

/// A crate of the workspace, and what it may stand on.
struct Member {
    name: &'static str,
    /// Crates of the workspace that it may import: an edge that is not listed here is a fault.
    imports: &'static [&'static str],
    /// Whether it may link devices, windows and loggers.
    heavy: bool,
}

impl Member {
    const fn light(name: &'static str, imports: &'static [&'static str]) -> Self {
        Self {
            name,
            imports,
            heavy: false,
        }
    }

    const fn heavy(name: &'static str, imports: &'static [&'static str]) -> Self {
        Self {
            name,
            imports,
            heavy: true,
        }
    }
}

/// Every crate, each below those that import it. Tests and benches may import any crate that is listed before theirs.
const MEMBERS: [Member; 18] = [
    // Floor 0: what everything stands on.
    Member::light("npr-core", &[]),
    Member::light("npr-shaders", &[]),
    Member::light("npr-vdb", &["npr-core"]),
    // This command links nothing else, so that it builds fast.
    Member::light("xtask", &["npr-core"]),
    // Floor 1a: one domain each, without a device.
    Member::light("npr-mesh", &["npr-core"]),
    Member::light("npr-trace", &["npr-core"]),
    // Lines painted in textures are followed along their middle.
    Member::light("npr-vector", &["npr-core", "npr-mesh", "npr-trace"]),
    // Draws strokes of the one and tracings of the other.
    Member::light("npr-drawing", &["npr-core", "npr-trace", "npr-vector"]),
    Member::light("npr-scene", &["npr-core"]),
    // Smoke comes from files too.
    Member::light("npr-smoke", &["npr-core", "npr-vdb"]),
    Member::light("npr-style", &["npr-core"]),
    Member::light("npr-stylesheet", &["npr-core", "npr-style"]),
    // Floor 1b: passes and their engines.
    Member::heavy(
        "npr-gpu",
        &[
            "npr-core",
            "npr-mesh",
            "npr-shaders",
            "npr-style",
            "npr-vector",
        ],
    ),
    // Floor 2: the facade.
    Member::heavy(
        "npr-render",
        &[
            "npr-core",
            "npr-drawing",
            "npr-gpu",
            "npr-mesh",
            "npr-scene",
            "npr-smoke",
            "npr-style",
            "npr-stylesheet",
            "npr-trace",
            "npr-vector",
        ],
    ),
    // Floor 3: the window, and the command, which may open it.
    Member::heavy("npr-view", &["npr-core", "npr-drawing", "npr-stylesheet"]),
    Member::heavy(
        "npr-cli",
        &[
            "npr-core",
            "npr-drawing",
            "npr-gpu",
            "npr-render",
            "npr-scene",
            "npr-smoke",
            "npr-style",
            "npr-stylesheet",
            "npr-trace",
            "npr-vdb",
            "npr-view",
        ],
    ),
    // Suites import whatever they test.
    Member::heavy(
        "npr-benches",
        &[
            "npr-core",
            "npr-drawing",
            "npr-gpu",
            "npr-mesh",
            "npr-render",
            "npr-scene",
            "npr-smoke",
            "npr-style",
            "npr-stylesheet",
            "npr-vdb",
            "npr-vector",
        ],
    ),
    Member::heavy(
        "npr-tests",
        &[
            "npr-core",
            "npr-drawing",
            "npr-gpu",
            "npr-mesh",
            "npr-render",
            "npr-scene",
            "npr-smoke",
            "npr-style",
            "npr-stylesheet",
            "npr-vector",
        ],
    ),
];

/// Crates that someone adds alone, and with how many packages each may come at most, without optional features.
const MOST_PACKAGES: [(&str, usize); 2] = [("npr-trace", 25), ("npr-gpu", 110)];

/// Packages that light crates may not link: devices, windows, loggers.
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
/// obvhs (hierarchies) and tiny-skia (pictures of strokes) call the facade `log`, which does nothing until a program
/// installs a logger.
const EXCUSED: [(&str, &str); 2] = [("npr-vector", "log"), ("npr-drawing", "log")];

/// The condition that may stand only on the device module and its re-exports.
const DEVICE_CONDITION: &str = concat!("feature = ", "\"wgpu\"");

/// Fails with every breach of the floors in the workspace at `root`.
pub fn check(root: &Path) -> Result<()> {
    let packages = members(root)?;

    // Look at the imports, lints and conditions of every crate.
    let mut faults = unsafe_faults(root)?;
    for package in &packages {
        faults.extend(import_faults(package));
        faults.extend(lint_faults(package)?);
        for file in rust_files(&package.folder().join("src"))? {
            faults.extend(condition_faults(&package.name, &file));
        }

        // Look at what the light ones link.
        if MEMBERS
            .iter()
            .any(|member| member.name == package.name && !member.heavy)
        {
            let linked = linked(root, &package.name, Features::All)?;
            faults.extend(weight_faults(&package.name, &linked));
        }
    }

    // Count the packages that come along with crates meant to be taken alone.
    for (name, most) in MOST_PACKAGES {
        let linked = linked(root, name, Features::None)?;
        faults.extend(count_fault(name, linked.len(), most));
    }

    // Tell what was found.
    if !faults.is_empty() {
        bail!("floors are breached:\n  {}", faults.join("\n  "));
    }
    println!("floors: {} crates import downwards", packages.len());
    Ok(())
}

/// Dependencies that are not listed; tests and benches may import every crate that is listed before their own.
fn import_faults(package: &Package) -> Vec<String> {
    let name = &package.name;

    // Find the floor of the crate.
    let Some(number) = MEMBERS.iter().position(|member| member.name == *name) else {
        return vec![format!("{name} is not listed in xtask/src/floors.rs")];
    };
    let (below, member) = (&MEMBERS[..number], &MEMBERS[number]);

    // Say which imports are allowed.
    let is_ours =
        |dependency: &&Dependency| MEMBERS.iter().any(|other| other.name == dependency.name);
    let is_allowed = |dependency: &Dependency| {
        let listed = member.imports.contains(&dependency.name.as_str());
        let for_tests = dependency.kind.as_deref() == Some("dev");
        let lies_below = below.iter().any(|other| other.name == dependency.name);
        lies_below && (listed || for_tests)
    };

    // Name the others.
    package
        .dependencies
        .iter()
        .filter(|dependency| dependency.name != *name)
        .filter(is_ours)
        .filter(|dependency| !is_allowed(dependency))
        .map(|dependency| {
            format!(
                "{name} imports {}, which is not listed for it",
                dependency.name
            )
        })
        .collect()
}

/// A crate that brings too many packages along.
fn count_fault(name: &str, count: usize, most: usize) -> Option<String> {
    (count > most).then(|| format!("{name} comes with {count} packages, of {most} at most"))
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
            ..Package::default()
        }
    }

    #[test]
    fn only_listed_edges_are_imports() {
        let count = |name: &str, imports: &[&str]| import_faults(&package(name, imports)).len();
        assert_eq!(count("npr-mesh", &["npr-core", "glam"]), 0);
        assert_eq!(count("npr-vector", &["npr-trace"]), 0, "listed");
        assert_eq!(count("npr-smoke", &["npr-vdb"]), 0, "listed");
        assert_eq!(
            count("npr-vector", &["npr-vdb"]),
            1,
            "below, but not listed"
        );
        assert_eq!(count("npr-mesh", &["npr-vector"]), 1, "sideways");
        assert_eq!(count("npr-core", &["npr-render"]), 1, "upwards");
        assert_eq!(count("npr-attic", &[]), 1, "not listed");
    }

    #[test]
    fn tests_import_what_lies_below() {
        let faults = |name: &str, import: &str| {
            let mut package = package(name, &[import]);
            package.dependencies[0].kind = Some("dev".to_owned());
            import_faults(&package).len()
        };
        assert_eq!(faults("npr-vector", "npr-mesh"), 0);
        assert_eq!(faults("npr-mesh", "npr-vector"), 1);
    }

    #[test]
    fn members_list_what_lies_below_them() {
        for (number, member) in MEMBERS.iter().enumerate() {
            let lies_below =
                |name: &&str| MEMBERS[..number].iter().any(|other| other.name == *name);
            assert!(member.imports.iter().all(lies_below), "{}", member.name);
        }
    }

    #[test]
    fn a_crate_with_too_many_packages_is_named() {
        assert_eq!(count_fault("npr-trace", 25, 25), None);
        let fault = count_fault("npr-trace", 26, 25);
        assert_eq!(
            fault.as_deref(),
            Some("npr-trace comes with 26 packages, of 25 at most")
        );
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
