//! `cargo xtask test`: every test of the workspace, and one line that says how it went.

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::Stdio;

use anyhow::{Context, Result, bail};

use crate::packages::cargo;

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

/// Runs `cargo test` over the workspace with all features and `arguments` added.
pub fn run(root: &Path, arguments: &[&str]) -> Result<()> {
    let mut command = cargo(root);
    command
        .args(["test", "--workspace", "--all-features", "--no-fail-fast"])
        .args(arguments);
    let mut child = command
        .stdout(Stdio::piped())
        .spawn()
        .context("cannot run cargo test")?;
    let stdout = child.stdout.take().context("standard output is piped")?;
    let mut tally = Tally::default();
    for line in BufReader::new(stdout).lines() {
        let line = line?;
        println!("{line}");
        tally.add(&line);
    }
    let status = child.wait()?;
    println!("\n{}", tally.summary());
    if !status.success() {
        bail!("cargo test failed: {status}");
    }
    Ok(())
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
