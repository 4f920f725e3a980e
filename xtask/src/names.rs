//! `cargo xtask names`: nothing tells where it was written, crates introduce themselves, nothing is too wide to read.

use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Result, bail};

use crate::packages::{Package, members, output};

/// Top folders of a machine, without the slash that this file must not put before them.
const TOP_FOLDERS: [&str; 5] = ["work", "root", "tmp", "home", "Users"];

/// Halves of the host names of package registries and their mirrors.
const REGISTRY_HOSTS: [(&str, &str); 9] = [
    ("index.crates", ".io"),
    ("static.crates", ".io"),
    ("crates", ".io/api"),
    ("pypi", ".org"),
    ("pythonhosted", ".org"),
    ("registry.npmjs", ".org"),
    ("proxy.golang", ".org"),
    ("arti", "factory"),
    ("nexus", ".sonatype"),
];

/// Widest line of Rust, of a document, and of a comment of a shader, in characters.
const MOST_COLUMNS: usize = 120;

/// Fails with every file that names a machine, every published crate without a README, and every line of
/// Rust, of a document or of a comment that is too wide.
pub fn check(root: &Path) -> Result<()> {
    let files = files(root)?;
    let mut faults = Vec::new();
    for file in &files {
        // Models and pictures are not text, and have no lines to check.
        if let Ok(text) = std::fs::read_to_string(root.join(file)) {
            faults.extend(text_faults(file, &text));
        }
    }
    faults.extend(members(root)?.iter().filter_map(readme_fault));
    if !faults.is_empty() {
        bail!("names that do not belong here:\n  {}", faults.join("\n  "));
    }
    println!("names: {} files name no machine", files.len());
    Ok(())
}

/// The files that git has or would take.
pub fn files(root: &Path) -> Result<Vec<PathBuf>> {
    let mut git = Command::new("git");
    git.current_dir(root)
        .args(["ls-files", "--cached", "--others", "--exclude-standard"]);
    let listed = output(&mut git)?;
    Ok(listed
        .lines()
        .map(PathBuf::from)
        .filter(|path| root.join(path).is_file())
        .collect())
}

/// The lines of a text that name a machine, and those that are too wide.
fn text_faults(file: &Path, text: &str) -> Vec<String> {
    let is_rust = file.extension().is_some_and(|extension| extension == "rs");
    let is_code = is_rust
        || file
            .extension()
            .is_some_and(|extension| extension == "wgsl");
    let fault = |(number, line): (usize, &str)| {
        let wide = || match is_document(file) || is_rust {
            true => too_wide(line),
            false => wide_comment(line).filter(|_| is_code),
        };
        let named = named_machine(line).or_else(wide)?;
        Some(format!("{}:{}: {named}", file.display(), number + 1))
    };
    text.lines().enumerate().filter_map(fault).collect()
}

/// What in a line names a machine: an absolute path or the host of a registry.
fn named_machine(line: &str) -> Option<String> {
    let folders = TOP_FOLDERS.iter().map(|folder| format!("/{folder}"));
    let hosts = REGISTRY_HOSTS
        .iter()
        .map(|(first, second)| format!("{first}{second}"));
    let path = folders.into_iter().find(|path| starts_a_path(line, path));
    path.or_else(|| hosts.into_iter().find(|host| line.contains(host.as_str())))
}

/// Whether a file is a document that somebody wrote; tables of measurements are written by programs.
fn is_document(file: &Path) -> bool {
    let is_markdown = file.extension().is_some_and(|extension| extension == "md");
    is_markdown && !file.starts_with("benches/results")
}

/// What is wrong with a line beyond column 120; addresses cannot be broken.
fn too_wide(line: &str) -> Option<String> {
    let width = line.chars().count();
    (width > MOST_COLUMNS && !line.contains("://")).then(|| format!("a line of {width} columns"))
}

/// What is wrong with a comment of a shader beyond column 120.
fn wide_comment(line: &str) -> Option<String> {
    let is_comment = line.trim_start().starts_with("//");
    let width = line.chars().count();
    (is_comment && width > MOST_COLUMNS).then(|| format!("a comment of {width} columns"))
}

/// Whether `path` stands in a line on its own or as the start of a longer path.
fn starts_a_path(line: &str, path: &str) -> bool {
    let is_word = |c: char| c.is_alphanumeric() || "_-.*>)}]/".contains(c);
    line.match_indices(path).any(|(start, _)| {
        let before = line[..start].chars().next_back();
        let after = line[start + path.len()..].chars().next();
        !before.is_some_and(is_word) && !after.is_some_and(|c| c.is_alphanumeric() || c == '_')
    })
}

/// A published crate without a README.
fn readme_fault(package: &Package) -> Option<String> {
    let missing = package.is_published() && !package.folder().join("README.md").is_file();
    missing.then(|| format!("{} has no README.md", package.name))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::file::write_whole;

    #[test]
    fn absolute_paths_are_found() {
        let line = |folder: &str| format!("read \"/{folder}/main/hero.glb\" first");
        for folder in TOP_FOLDERS {
            assert_eq!(named_machine(&line(folder)), Some(format!("/{folder}")));
        }
    }

    #[test]
    fn relative_paths_and_longer_words_are_not() {
        for line in [
            "out/tmp/a.png",
            "a / tmpfile",
            "../work",
            "km/root",
            "$HOME/work",
            "/worker",
        ] {
            assert_eq!(named_machine(line), None, "{line}");
        }
    }

    #[test]
    fn comments_may_not_be_too_wide() {
        let faults = |path: &str, line: &str| text_faults(Path::new(path), line).len();
        let comment = |width: usize| format!("    /// {}", "x".repeat(width - 8));
        assert_eq!(faults("src/lib.rs", &comment(120)), 0);
        assert_eq!(faults("src/lib.rs", &comment(121)), 1);
        assert_eq!(faults("lib/adapt.wgsl", &comment(121)), 1);
        assert_eq!(faults("docs/notes.txt", &comment(121)), 0);
        assert_eq!(faults("src/lib.rs", &"x".repeat(121)), 1);
        assert_eq!(faults("lib/adapt.wgsl", &"x".repeat(121)), 0);
    }

    #[test]
    fn documents_may_not_be_too_wide() {
        let faults = |path: &str, line: &str| text_faults(Path::new(path), line).len();
        assert_eq!(faults("README.md", &"x".repeat(120)), 0);
        assert_eq!(faults("README.md", &"x".repeat(121)), 1);
        assert_eq!(faults("benches/results/lines.md", &"x".repeat(121)), 0);
        let address = format!("see https://example.org/{}", "x".repeat(120));
        assert_eq!(faults("README.md", &address), 0);
    }

    #[test]
    fn registry_hosts_are_found_and_the_lock_file_passes() {
        let host = format!("https://{}.io/config.json", "index.crates");
        assert!(named_machine(&host).is_some());
        let locked = "source = \"registry+https://github.com/rust-lang/crates.io-index\"";
        assert_eq!(named_machine(locked), None);
    }

    #[test]
    fn a_published_crate_needs_a_readme() {
        let folder = tempfile::tempdir().unwrap();
        let package = Package {
            name: "npr-mesh".into(),
            manifest_path: folder.path().join("Cargo.toml"),
            dependencies: vec![],
            publish: None,
            ..Package::default()
        };
        assert!(readme_fault(&package).is_some());
        assert!(
            readme_fault(&Package {
                publish: Some(vec![]),
                ..package.clone()
            })
            .is_none()
        );
        write_whole(&folder.path().join("README.md"), b"# npr-mesh").unwrap();
        assert!(readme_fault(&package).is_none());
    }
}
