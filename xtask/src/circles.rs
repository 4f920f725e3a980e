//! `cargo xtask circles`: modules of a crate import each other in one direction.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use anyhow::{Result, bail};

use crate::packages::members;
use crate::source::{SourceFile, code_of, rust_files, starts};

/// Most modules in circles, over all crates.
const MOST: usize = 30;

/// A module by the names that lead to it from the root of its crate.
type Module = Vec<String>;

/// Fails where more than [`MOST`] modules of published crates import each other in circles; names them all.
pub fn check(root: &Path) -> Result<()> {
    let mut found = Vec::new();
    for package in members(root)?.iter().filter(|p| p.is_published()) {
        let files = rust_files(&package.folder().join("src"))?;
        let circles = Crate::new(&files).circles();
        let named = circles.into_iter().map(|circle| {
            let names: Vec<String> = circle.iter().map(|module| module.join("::")).collect();
            (
                names.len(),
                format!("{}: {}", package.name, names.join(", ")),
            )
        });
        found.extend(named);
    }
    let count: usize = found.iter().map(|(length, _)| length).sum();
    for (_, circle) in &found {
        println!("circle in {circle}");
    }
    if count > MOST {
        bail!("{count} modules import each other in circles, {MOST} may");
    }
    println!("circles: {count} modules import each other, {MOST} may");
    Ok(())
}

/// The modules of a crate and what each imports.
struct Crate {
    /// The code of every module but tests.
    code: BTreeMap<Module, String>,
    /// Where a name that a module hands on comes from.
    handed_on: BTreeMap<Module, Module>,
}

impl Crate {
    fn new(files: &[SourceFile]) -> Self {
        let of_file = |file: &SourceFile| Some((module_of(&file.path)?, own_code(&file.text)));
        let mut all = Self {
            code: files.iter().filter_map(of_file).collect(),
            handed_on: BTreeMap::new(),
        };
        let mut handed_on = BTreeMap::new();
        for (module, code) in &all.code {
            for (path, is_public) in imports(code) {
                let from = all.rooted(module, &path);
                if let (true, Some(from)) = (is_public, from) {
                    let name = path.last().cloned().unwrap_or_default();
                    handed_on.insert([&module[..], &[name]].concat(), from);
                }
            }
        }
        all.handed_on = handed_on;
        all
    }

    /// A path of a module, from the root of the crate; none where it leads out of the crate.
    fn rooted(&self, module: &[String], path: &[String]) -> Option<Module> {
        let ups = path.iter().take_while(|name| *name == "super").count();
        let (base, rest) = match path.first().map(String::as_str) {
            Some("crate") => (&module[..0], &path[1..]),
            Some("self") => (module, &path[1..]),
            Some("super") => (&module[..module.len().checked_sub(ups)?], &path[ups..]),
            Some(child) => {
                let is_child = self
                    .code
                    .contains_key(&[module, &[child.to_owned()]].concat());
                (module, is_child.then_some(path)?)
            }
            None => return None,
        };
        Some([base, rest].concat())
    }

    /// The module that defines what a path names: names that are handed on are followed.
    fn owner(&self, path: &[String], steps: usize) -> Module {
        let known = (0..=path.len()).rev();
        let length = known
            .into_iter()
            .find(|n| self.code.contains_key(&path[..*n]));
        let length = length.unwrap_or(0);
        let named = (path.get(..=length)).and_then(|name| self.handed_on.get(name));
        match named {
            Some(from) if steps > 0 => self.owner(&[from, &path[length + 1..]].concat(), steps - 1),
            _ => path[..length].to_vec(),
        }
    }

    /// The modules that a module imports something of; what it hands on is not its own import.
    fn imported(&self, module: &Module, code: &str) -> BTreeSet<Module> {
        let mut paths: Vec<Module> = imports(code)
            .into_iter()
            .filter(|(_, is_public)| !is_public)
            .map(|(path, _)| path)
            .collect();
        paths.extend(paths_in(code));
        let of_crate = paths.iter().filter_map(|path| self.rooted(module, path));
        let owners = of_crate.map(|path| self.owner(&path, 8));
        owners
            .filter(|owner| owner != module && !owner.is_empty())
            .collect()
    }

    /// Every set of modules that reach each other.
    fn circles(&self) -> Vec<BTreeSet<Module>> {
        let imported: BTreeMap<&Module, BTreeSet<Module>> = self
            .code
            .iter()
            .filter(|(module, _)| !module.is_empty())
            .map(|(module, code)| (module, self.imported(module, code)))
            .collect();
        let reached = |from: &Module| {
            let mut found = BTreeSet::new();
            let mut waiting: Vec<&Module> = imported[from].iter().collect();
            while let Some(module) = waiting.pop() {
                if found.insert(module.clone()) {
                    waiting.extend(&imported[module]);
                }
            }
            found
        };
        let all: BTreeMap<&Module, BTreeSet<Module>> = imported
            .keys()
            .map(|module| (*module, reached(module)))
            .collect();
        let circle_of = |(module, reached): (&&Module, &BTreeSet<Module>)| {
            let both = reached.iter().filter(|other| all[other].contains(*module));
            let circle: BTreeSet<Module> = both.cloned().collect();
            (circle.len() > 1).then_some(circle)
        };
        let circles: BTreeSet<BTreeSet<Module>> = all.iter().filter_map(circle_of).collect();
        circles.into_iter().collect()
    }
}

/// The module that a file below `src` is; none for tests, what they share, and programs of their own.
fn module_of(path: &Path) -> Option<Module> {
    let stem = path.with_extension("");
    let names = stem
        .components()
        .map(|part| part.as_os_str().to_string_lossy().into_owned());
    let names: Module = names.collect();
    let is_left_out = |name: &String| ["tests", "testing", "bin"].contains(&name.as_str());
    if names.iter().any(is_left_out) {
        return None;
    }
    match names.as_slice() {
        [root] if root == "lib" || root == "main" => Some(Vec::new()),
        _ => Some(names),
    }
}

/// Source without comments, literals and the tests at its end.
fn own_code(text: &str) -> String {
    let code = code_of(text);
    let end = code.find("#[cfg(test)]\nmod tests {").unwrap_or(code.len());
    code[..end].to_owned()
}

/// Every path that `use` names, and whether it is handed on.
fn imports(code: &str) -> Vec<(Module, bool)> {
    let mut found = Vec::new();
    for start in starts(code, "use ") {
        let line = code[..start].rfind('\n').map_or(0, |end| end + 1);
        let before = code[line..start].trim();
        let is_public = before.starts_with("pub");
        if !(before.is_empty() || is_public) {
            continue;
        }
        let end = code[start..]
            .find(';')
            .map_or(code.len(), |end| start + end);
        expand(&code[start + 4..end], &[], &mut |path| {
            found.push((path, is_public))
        });
    }
    found
}

/// Hands every path of a tree of imports to `take`.
fn expand(tree: &str, prefix: &[String], take: &mut dyn FnMut(Module)) {
    let names = |text: &str| -> Module {
        let parts = text.split("::").map(|part| part.trim().to_owned());
        parts.filter(|part| !part.is_empty()).collect()
    };
    let Some((head, body)) = tree.split_once('{') else {
        let path = tree.split(" as ").next().unwrap_or_default();
        take([prefix, &names(path)].concat());
        return;
    };
    let prefix = [prefix, &names(head)].concat();
    let body = body.rsplit_once('}').map_or(body, |(body, _)| body);
    let (mut depth, mut from) = (0, 0);
    for (at, c) in body.char_indices().chain([(body.len(), ',')]) {
        depth += i32::from(c == '{') - i32::from(c == '}');
        if c == ',' && depth == 0 {
            if !body[from..at].trim().is_empty() {
                expand(&body[from..at], &prefix, take);
            }
            from = at + 1;
        }
    }
}

/// Every path with `::` that stands outside of `use`.
fn paths_in(code: &str) -> Vec<Module> {
    let is_path = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
    let statements = code.split(';').filter(|statement| {
        let last = statement
            .rsplit(['\n', '}'])
            .find(|line| !line.trim().is_empty());
        !last.is_some_and(|line| line.contains("use ")) && !statement.contains("use {")
    });
    let words = statements.flat_map(|statement| statement.split(|c| !is_path(c)));
    let paths = words.filter(|word| word.contains("::") && !word.starts_with(':'));
    paths
        .map(|path| path.split("::").map(str::to_owned).collect())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::file;

    fn circles_of(files: &[(&str, &str)]) -> Vec<Vec<String>> {
        let files: Vec<SourceFile> = files.iter().map(|(path, text)| file(path, text)).collect();
        let circles = Crate::new(&files).circles();
        let names = |circle: &BTreeSet<Module>| circle.iter().map(|m| m.join("::")).collect();
        circles.iter().map(names).collect()
    }

    #[test]
    fn modules_that_import_each_other_are_a_circle() {
        let files = [
            ("lib.rs", "mod a;\nmod b;\nmod c;"),
            ("a.rs", "use crate::b::{B, deep::{D, E}};"),
            ("b.rs", "fn f() -> u8 { crate::c::g() }"),
            ("c.rs", "use super::a;\n"),
            ("d.rs", "use crate::a::A;"),
        ];
        assert_eq!(circles_of(&files), [["a", "b", "c"]]);
    }

    #[test]
    fn names_that_are_handed_on_belong_to_their_module() {
        let files = [
            ("lib.rs", "mod a;\npub use a::inner::Thing;"),
            ("a.rs", "mod inner;\nmod user;\npub use inner::Thing;\n"),
            ("a/inner.rs", "pub struct Thing;"),
            ("a/user.rs", "use super::Thing;\nfn f(_: crate::Thing) {}"),
        ];
        assert_eq!(circles_of(&files), Vec::<Vec<String>>::new());
    }

    #[test]
    fn a_parent_and_its_child_may_be_a_circle_and_tests_are_none() {
        let files = [
            (
                "a.rs",
                "mod child;\nfn f() { child::g() }\n#[cfg(test)]\nmod tests { use crate::b::B; }",
            ),
            ("a/child.rs", "use super::Held;"),
            ("a/tests.rs", "use crate::b::B;"),
            (
                "b.rs",
                "#[cfg(test)]\nmod tests;\n// use crate::b::B;\nuse crate::a::Held;",
            ),
        ];
        assert_eq!(circles_of(&files), [["a", "a::child"]]);
    }
}
