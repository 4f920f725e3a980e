//! `cargo xtask test`: every test of the workspace, or with `--quick` those near a change, and one line that says how
//! it went.

use std::collections::BTreeSet;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Command, Stdio};

use anyhow::{Context, Result, bail, ensure};

use crate::packages::{cargo, members, output, tested_features};
use crate::programs::{Program, run_all};
use crate::source::rust_files;

/// How many tests went which way.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
struct Tally {
    /// Test programs that ran to their end.
    programs: usize,
    /// Tests that passed.
    passed: usize,
    /// Tests that failed.
    failed: usize,
    /// Tests that were left out.
    ignored: usize,
}

/// Programs whose tests are run: unit tests and folders `tests`, but no examples and no programs without tests, which
/// lints compile.
const PROGRAMS: [&str; 2] = ["--workspace", "--tests"];

/// Runs every test of the workspace, or what `arguments` ask `cargo test` for, with all features but those of windows.
pub fn run(root: &Path, arguments: &[&str]) -> Result<()> {
    if !arguments.is_empty() {
        return run_with(root, arguments);
    }
    let programs = run_workspace(root, &[], &[]);
    let documents = run_with(root, &["--doc"]);
    programs.and(documents)
}

/// Runs the unit tests of the crates that differ from the last commit, and the test programs that do; the unit tests of
/// every crate where nothing differs.
pub fn quick(root: &Path) -> Result<()> {
    let mut git = Command::new("git");
    let changed =
        output(
            git.current_dir(root)
                .args(["status", "--porcelain", "--untracked-files=all"]),
        )?;
    let changed: Vec<&str> = changed.lines().filter_map(|line| line.get(3..)).collect();
    let arguments = near(&changed, &folders(root)?);
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let programs = [&["--all-features"], &arguments[..]].concat();
    run_programs(root, &programs, &[], &[])
}

/// The packages of the workspace by their folders below its root.
fn folders(root: &Path) -> Result<Vec<(String, String)>> {
    let members = members(root)?.into_iter().map(|member| {
        let folder = member.folder().strip_prefix(root)?;
        Ok((folder.display().to_string(), member.name))
    });
    members.collect()
}

/// What `cargo test` is asked for after a change of files.
fn near(changed: &[&str], folders: &[(String, String)]) -> Vec<String> {
    // Find the crates of the files, and the test programs among them.
    let mut packages = BTreeSet::new();
    let mut programs = BTreeSet::new();
    for (folder, name) in folders {
        for path in changed
            .iter()
            .filter_map(|path| path.strip_prefix(&format!("{folder}/")))
        {
            packages.insert(name.as_str());
            let program = path
                .strip_prefix("tests/")
                .filter(|path| path.ends_with(".rs"))
                .and_then(|path| path.split(['/', '.']).next());
            programs.extend(program);
        }
    }

    // Ask for all crates where none changed. This one has no library, and is the only program with unit tests.
    let (is_all, is_own) = (packages.is_empty(), packages.contains("xtask"));
    let asked = [
        ("--workspace", is_all),
        ("--lib", packages.len() > usize::from(is_own) || is_all),
        ("--bin=xtask", is_own || is_all),
    ];
    let asked = asked.into_iter().filter(|(_, is_asked)| *is_asked);
    let mut arguments: Vec<String> = asked.map(|(argument, _)| argument.to_owned()).collect();
    arguments.extend(
        packages
            .into_iter()
            .flat_map(|name| ["--package".to_owned(), name.to_owned()]),
    );
    arguments.extend(
        programs
            .into_iter()
            .flat_map(|name| ["--test".to_owned(), name.to_owned()]),
    );
    arguments
}

/// Runs the test programs that `chosen` asks cargo for, two at a time, and prints what each says when it has ended.
fn run_programs(
    root: &Path,
    chosen: &[&str],
    arguments: &[&str],
    environment: &[(&str, String)],
) -> Result<()> {
    let programs = Program::compile(root, chosen)?;
    let (mut tally, mut failed) = (Tally::default(), Vec::new());
    run_all(&programs, arguments, environment, |program, run| {
        let (text, is_success, seconds) = match run {
            Ok(run) => (run.text, run.is_success, run.time.as_secs_f64()),
            Err(error) => (format!("{error:#}"), false, 0.0),
        };
        println!("\n== {} ({seconds:.1} s)\n{text}", program.name());
        text.lines().for_each(|line| tally.add(line));
        failed.extend((!is_success).then(|| program.name()));
    });
    println!("\n{}", tally.summary());
    ensure!(failed.is_empty(), "failed: {}", failed.join("; "));
    Ok(())
}

/// The same for all programs of the workspace.
fn run_workspace(root: &Path, arguments: &[&str], environment: &[(&str, String)]) -> Result<()> {
    let features = tested_features(root)?;
    let chosen = [&PROGRAMS[..], &["--features", &features]].concat();
    run_programs(root, &chosen, arguments, environment)
}

fn run_with(root: &Path, arguments: &[&str]) -> Result<()> {
    // Start the tests of the crates.
    let mut command = cargo(root);
    command
        .args(["test", "--no-fail-fast", "--workspace", "--features"])
        .arg(tested_features(root)?)
        .args(arguments);
    let mut child = command
        .stdout(Stdio::piped())
        .spawn()
        .context("cannot run cargo test")?;

    // Pass on what they print, and count.
    let stdout = child.stdout.take().context("standard output is piped")?;
    let mut tally = Tally::default();
    for line in BufReader::new(stdout).lines() {
        let line = line?;
        println!("{line}");
        tally.add(&line);
    }

    // Tell the sum, and fail where they do.
    let status = child.wait()?;
    println!("\n{}", tally.summary());
    if !status.success() {
        bail!("cargo test failed: {status}");
    }
    Ok(())
}

/// Runs half of the property tests again, drawn by a seed, as are their cases.
///
/// The seed is that of the commit, so that the same commit gets the same answer. An even seed draws one half of the
/// tests and an odd one the other, which keeps the time of a run in bounds: all of them have run with the first seed
/// before.
pub fn again(root: &Path) -> Result<()> {
    // Take the seed from the commit.
    let seed = seed_of_commit(root)?;
    let first = std::env::var(SEED).unwrap_or_else(|_| "chance".to_owned());

    // Draw a half of the property tests.
    let mut names = BTreeSet::new();
    for package in members(root)? {
        for file in rust_files(package.folder())? {
            let functions = file.functions().into_iter();
            names.extend(functions.filter(|f| f.is_property).map(|f| f.name));
        }
    }
    let chosen: Vec<&str> = names
        .iter()
        .map(String::as_str)
        .filter(|name| is_drawn(name, seed))
        .collect();
    println!(
        "property tests: seed {first} for all of them, then {SEED}={seed} of this commit for {} of {}",
        chosen.len(),
        names.len()
    );

    // Run them with that seed.
    run_workspace(root, &chosen, &[(SEED, seed.to_string())])
}

/// Where property tests look for their seed.
const SEED: &str = "PROPTEST_RNG_SEED";

/// A number of the commit that stands in the folder: the first digits of its hash.
fn seed_of_commit(root: &Path) -> Result<u64> {
    let mut git = Command::new("git");
    let hash = output(git.current_dir(root).args(["rev-parse", "HEAD"]))?;
    let digits = hash.get(..8).context("a commit has a hash")?;
    u64::from_str_radix(digits, 16).context("a hash is a number")
}

/// Whether a test belongs to the half that a seed draws: the other half for the next one.
///
/// One whose name a macro puts together has none in its source. It belongs to neither: no name fits every test.
fn is_drawn(name: &str, seed: u64) -> bool {
    let sum: u64 = name.bytes().map(u64::from).sum();
    !name.is_empty() && (sum + seed).is_multiple_of(2)
}

impl Tally {
    /// Takes in a line of output, of which only the last line of each program counts.
    fn add(&mut self, line: &str) {
        let Some(result) = line.strip_prefix("test result: ") else {
            return;
        };
        let count = |word: &str| {
            let before = result.split(word).next().unwrap_or_default().trim_end();
            before
                .rsplit([' ', '.'])
                .next()
                .and_then(|digits| digits.parse().ok())
                .unwrap_or(0)
        };
        self.programs += 1;
        self.passed += count("passed");
        self.failed += count("failed;");
        self.ignored += count("ignored");
    }

    /// The line at the end.
    fn summary(&self) -> String {
        let Self {
            programs,
            passed,
            failed,
            ignored,
        } = self;
        format!("{passed} passed, {failed} failed, {ignored} ignored in {programs} test programs")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_seeds_in_a_row_draw_every_test_once() {
        for name in ["a", "b", "lines_are_lines"] {
            assert_ne!(is_drawn(name, 20_031), is_drawn(name, 20_032), "{name}");
        }
    }

    #[test]
    fn tests_without_a_name_are_not_drawn() {
        assert!(!is_drawn("", 20_031) && !is_drawn("", 20_032));
    }

    #[test]
    fn a_change_asks_for_its_crates_and_its_test_programs() {
        let folders = [
            ("crates/npr-mesh", "npr-mesh"),
            ("tests", "npr-tests"),
            ("xtask", "xtask"),
        ];
        let folders = folders.map(|(folder, name)| (folder.to_owned(), name.to_owned()));
        let asked = |changed: &[&str]| near(changed, &folders).join(" ");
        assert_eq!(asked(&["README.md"]), "--workspace --lib --bin=xtask");
        assert_eq!(
            asked(&["crates/npr-mesh/src/bvh.rs"]),
            "--lib --package npr-mesh"
        );
        assert_eq!(
            asked(&[
                "tests/tests/frames/ages.rs",
                "tests/tests/every_key/main.rs"
            ]),
            "--lib --package npr-tests --test every_key --test frames"
        );
        assert_eq!(asked(&["xtask/src/main.rs"]), "--bin=xtask --package xtask");
    }

    #[test]
    fn results_add_up() {
        let mut tally = Tally::default();
        tally.add("running 3 tests");
        tally.add("test result: ok. 12 passed; 0 failed; 1 ignored; 0 measured; 0 filtered out");
        tally.add("test result: FAILED. 3 passed; 2 failed; 0 ignored; 0 measured");
        assert_eq!(
            tally,
            Tally {
                programs: 2,
                passed: 15,
                failed: 2,
                ignored: 1
            }
        );
        assert_eq!(
            tally.summary(),
            "15 passed, 2 failed, 1 ignored in 2 test programs"
        );
    }
}
