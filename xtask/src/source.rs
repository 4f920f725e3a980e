//! Rust source as lines of text.

use std::path::{Path, PathBuf};

use anyhow::Result;

/// A source file of a crate.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SourceFile {
    /// Its path below the crate's folder.
    pub path: PathBuf,
    /// Its text.
    pub text: String,
}

/// Every `.rs` file below `folder`, in order of path; build output is passed over.
pub fn rust_files(folder: &Path) -> Result<Vec<SourceFile>> {
    let mut waiting = vec![folder.to_path_buf()];
    let mut files = Vec::new();
    while let Some(place) = waiting.pop() {
        for entry in std::fs::read_dir(&place)? {
            let path = entry?.path();
            if path.is_dir() {
                waiting.extend((!path.ends_with("target")).then_some(path));
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                let text = std::fs::read_to_string(&path)?;
                files.push(SourceFile {
                    path: path.strip_prefix(folder)?.to_path_buf(),
                    text,
                });
            }
        }
    }
    files.sort_by(|a, b| a.path.cmp(&b.path));
    Ok(files)
}

impl SourceFile {
    /// Whether the file holds a test function `name`, plain or inside `proptest!`.
    pub fn has_test(&self, name: &str) -> bool {
        let lines: Vec<&str> = self.text.lines().map(str::trim).collect();
        let declares = |line: &str| {
            let rest = line
                .strip_prefix("fn ")
                .and_then(|rest| rest.strip_prefix(name));
            rest.is_some_and(|rest| rest.trim_start().starts_with(['(', '<']))
        };
        (0..lines.len()).any(|i| declares(lines[i]) && is_marked_as_test(&lines[..i]))
    }

    /// Whether the file is, or declares, a module `name`.
    pub fn knows_module(&self, name: &str) -> bool {
        let stem = self.path.with_extension("");
        let in_path = stem.components().any(|part| part.as_os_str() == name);
        let declared = [format!("mod {name} {{"), format!("mod {name};")];
        in_path || declared.iter().any(|text| self.text.contains(text))
    }
}

/// Whether the attributes and comments right above a function, the end of `lines`, hold `#[test]`.
fn is_marked_as_test(lines: &[&str]) -> bool {
    let above = lines.iter().rev();
    above
        .take_while(|line| line.starts_with(['#', '/']))
        .any(|line| line.starts_with("#[test]"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(path: &str, text: &str) -> SourceFile {
        SourceFile {
            path: path.into(),
            text: text.into(),
        }
    }

    #[test]
    fn only_marked_functions_are_tests() {
        let text =
            "fn helper() {}\n#[test]\n/// Why.\nfn works() {}\n#[test]\nfn works_too<T>() {}";
        let file = file("src/lib.rs", text);
        assert!(file.has_test("works") && file.has_test("works_too"));
        assert!(!file.has_test("helper") && !file.has_test("work"));
    }

    #[test]
    fn modules_come_from_paths_and_declarations() {
        let file = file("src/passes/vector.rs", "mod tests {\n}");
        assert!(file.knows_module("passes") && file.knows_module("vector"));
        assert!(file.knows_module("tests") && !file.knows_module("rank"));
    }
}
