//! `cargo xtask coverage`: every line of the requirements is accounted for, by tests that exist.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use anyhow::{Context, Result, bail};
use serde::Deserialize;

use crate::harness::tests_on_shared_assets;
use crate::packages::{Package, members};
use crate::source::{SourceFile, rust_files};

/// The documents: letter, and the number of lines each has.
/// `F` holds what they say in passing.
const DOCUMENTS: [(char, usize); 6] = [
    ('A', 41),
    ('B', 59),
    ('C', 30),
    ('D', 78),
    ('E', 30),
    ('F', 7),
];

/// How far a requirement is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
#[serde(rename_all = "lowercase")]
enum State {
    /// Works, and a test shows it.
    Done,
    /// Works in part.
    Part,
    /// Not yet begun.
    Open,
    /// Left out, for the reason in the note.
    No,
}

/// One table of `docs/coverage.toml`.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    /// How far it is.
    state: State,
    /// Tests as `package::module::function`.
    #[serde(default)]
    tests: Vec<String>,
    /// Where it lives, what is missing, or why not.
    #[serde(default)]
    note: String,
}

/// The tables by requirement.
type Coverage = BTreeMap<String, Entry>;

/// The sources of each package, by package name.
type Sources = BTreeMap<String, Vec<SourceFile>>;

/// The tests of each package that need the assets beside the checkout.
type Beside = BTreeMap<String, BTreeSet<String>>;

/// Fails with every fault of `docs/coverage.toml`; prints the counts.
pub fn check(root: &Path) -> Result<()> {
    let text = std::fs::read_to_string(root.join("docs/coverage.toml"))?;
    let coverage: Coverage = toml::from_str(&text).context("docs/coverage.toml")?;
    let sources = sources(&members(root)?)?;
    println!("{}", counts(&coverage));
    let beside = beside(&sources);
    let count: usize = beside.values().map(BTreeSet::len).sum();
    println!("tests that need the assets beside the checkout: {count}");
    let faults = faults(&coverage, &sources, &beside);
    if !faults.is_empty() {
        bail!(
            "docs/coverage.toml does not hold:\n  {}",
            faults.join("\n  ")
        );
    }
    Ok(())
}

/// Every requirement, in order.
fn ids() -> impl Iterator<Item = String> {
    let document = |(letter, count)| (1..=count).map(move |number| format!("{letter}{number}"));
    DOCUMENTS.into_iter().flat_map(document)
}

/// Reads the sources of all packages.
fn sources(packages: &[Package]) -> Result<Sources> {
    packages
        .iter()
        .map(|p| Ok((p.name.clone(), rust_files(p.folder())?)))
        .collect()
}

/// The tests of each package that do nothing without the assets beside the checkout.
fn beside(sources: &Sources) -> Beside {
    let of =
        |(name, files): (&String, &Vec<SourceFile>)| (name.clone(), tests_on_shared_assets(files));
    sources.iter().map(of).collect()
}

/// Missing and unknown tables, then what is wrong inside the others.
fn faults(coverage: &Coverage, sources: &Sources, beside: &Beside) -> Vec<String> {
    let known: Vec<String> = ids().collect();
    let missing = known.iter().filter(|id| !coverage.contains_key(*id));
    let unknown = coverage.keys().filter(|id| !known.contains(id));
    let tables = missing
        .map(|id| format!("{id} has no table"))
        .chain(unknown.map(|id| format!("{id} is no requirement")));
    let inside = known
        .iter()
        .filter_map(|id| Some((id, coverage.get(id)?)))
        .flat_map(|(id, entry)| entry_faults(id, entry, sources, beside));
    tables.chain(inside).collect()
}

/// Tests that do not exist, and claims without a test or a reason.
fn entry_faults(id: &str, entry: &Entry, sources: &Sources, beside: &Beside) -> Vec<String> {
    // Name tests that do not exist.
    let lost = entry.tests.iter().filter(|test| !exists(test, sources));
    let mut faults: Vec<String> = lost.map(|test| format!("{id}: no test {test}")).collect();

    // Name claims that no test proves.
    if entry.state == State::Done && entry.tests.is_empty() {
        faults.push(format!("{id} is done, but names no test"));
    }
    let needs_assets = |test: &String| {
        let (package, function) = (test.split("::").next(), test.rsplit("::").next());
        let tests = package.and_then(|package| beside.get(package));
        tests.is_some_and(|tests| function.is_some_and(|function| tests.contains(function)))
    };
    if entry.state == State::Done && !entry.tests.is_empty() && entry.tests.iter().all(needs_assets)
    {
        faults.push(format!(
            "{id} is done, but every test named needs the assets beside the checkout"
        ));
    }

    // Name gaps without a reason.
    if entry.state != State::Done && entry.note.is_empty() {
        faults.push(format!("{id} is not done, and its note does not say why"));
    }
    faults
}

/// Whether a test `package::module::function` stands in a file of that package and those modules.
fn exists(test: &str, sources: &Sources) -> bool {
    let parts: Vec<&str> = test.split("::").collect();
    let [package, modules @ .., function] = parts.as_slice() else {
        return false;
    };
    let files = sources.get(*package).map(Vec::as_slice).unwrap_or_default();
    let holds = |file: &SourceFile| {
        file.has_test(function) && modules.iter().all(|module| file.knows_module(module))
    };
    files.iter().any(holds)
}

/// A line for each document: how many of its requirements are in each state.
fn counts(coverage: &Coverage) -> String {
    let line = |(letter, count): (char, usize)| {
        let of = |state| {
            let in_document = coverage.iter().filter(|(id, _)| id.starts_with(letter));
            in_document
                .filter(|(_, entry)| entry.state == state)
                .count()
        };
        let [done, part, open, no] = [State::Done, State::Part, State::Open, State::No].map(of);
        format!("{letter}: {done:2} done {part:2} part {open:2} open {no:2} no, of {count}")
    };
    DOCUMENTS.map(line).join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A table for every requirement, all open.
    fn all_open() -> Coverage {
        let entry = Entry {
            state: State::Open,
            tests: vec![],
            note: "later".into(),
        };
        ids().map(|id| (id, entry.clone())).collect()
    }

    /// A package with one test in `src/rank.rs`.
    fn one_test() -> Sources {
        let text = "mod tests {\n    #[test]\n    fn ranks_a_list() {}\n}".into();
        let file = SourceFile {
            path: "src/rank.rs".into(),
            text,
        };
        [("npr-vector".to_owned(), vec![file])].into()
    }

    #[test]
    fn every_requirement_counts_once() {
        assert_eq!(ids().count(), 245);
        assert!(faults(&all_open(), &Sources::new(), &Beside::new()).is_empty());
        assert!(counts(&all_open()).contains("D:  0 done  0 part 78 open  0 no, of 78"));
    }

    #[test]
    fn missing_and_unknown_tables_are_named() {
        let mut coverage = all_open();
        let entry = coverage.remove("C7").unwrap();
        coverage.insert("C31".into(), entry);
        assert_eq!(
            faults(&coverage, &Sources::new(), &Beside::new()),
            ["C7 has no table", "C31 is no requirement"]
        );
    }

    #[test]
    fn done_needs_a_test_that_exists() {
        let mut entry = Entry {
            state: State::Done,
            tests: vec![],
            note: String::new(),
        };
        assert_eq!(
            entry_faults("D28", &entry, &one_test(), &Beside::new()).len(),
            1
        );
        entry.tests = vec!["npr-vector::rank::ranks_a_list".into()];
        assert!(entry_faults("D28", &entry, &one_test(), &Beside::new()).is_empty());
        entry.tests.push("npr-vector::rank::ranks_a_tree".into());
        entry.tests.push("npr-vector::scan::ranks_a_list".into());
        assert_eq!(
            entry_faults("D28", &entry, &one_test(), &Beside::new()).len(),
            2
        );
    }

    #[test]
    fn done_needs_a_test_that_runs_without_the_assets_beside_the_checkout() {
        let text = "#[test]\nfn ranks_bunnies() { open(\"../shared/assets/models/bunny.glb\") }";
        let bunny = SourceFile {
            path: "tests/bunny.rs".into(),
            text: text.into(),
        };
        let mut sources = one_test();
        sources.entry("npr-vector".into()).or_default().push(bunny);
        let mut entry = Entry {
            state: State::Done,
            tests: vec!["npr-vector::bunny::ranks_bunnies".into()],
            note: String::new(),
        };
        let beside = beside(&sources);
        let faults = entry_faults("D28", &entry, &sources, &beside);
        assert_eq!(faults.len(), 1, "{faults:?}");
        entry.tests.push("npr-vector::rank::ranks_a_list".into());
        assert!(entry_faults("D28", &entry, &sources, &beside).is_empty());
    }

    #[test]
    fn states_and_keys_are_checked_on_reading() {
        assert!(toml::from_str::<Coverage>("[A1]\nstate = \"done\"\ntests = [\"a::b\"]").is_ok());
        assert!(toml::from_str::<Coverage>("[A1]\nstate = \"almost\"").is_err());
        assert!(toml::from_str::<Coverage>("[A1]\nstate = \"open\"\nnotes = \"\"").is_err());
    }
}
