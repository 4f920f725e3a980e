//! The machine and the state of the code that figures were taken on.

use std::process::Command;

/// Cores, processor and compiler, in words.
pub fn description() -> String {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let compiler = first_line_of("rustc", &["--version"]);
    let version = compiler
        .split_whitespace()
        .take(2)
        .collect::<Vec<_>>()
        .join(" ");
    format!("{cores} cores of {}, {version}", processor())
}

/// Name of the processor, where the system tells it.
fn processor() -> String {
    let info = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let name = info
        .lines()
        .find_map(|line| line.strip_prefix("model name")?.split_once(": "));
    let kind = if info.contains(" hypervisor") {
        "a virtual"
    } else {
        "an"
    };
    name.map_or_else(
        || "an unknown processor".to_owned(),
        |(_, name)| format!("{kind} {name}"),
    )
}

/// What is measured and when: [`commit`] and [`today`], in words.
pub fn code() -> String {
    format!("{}, measured {}", commit(), today())
}

/// The commit and whether files differ from it, in words.
pub fn commit() -> String {
    let commit = first_line_of("git", &["rev-parse", "--short", "HEAD"]);
    let changed = first_line_of(
        "git",
        &["status", "--porcelain", "--", ":/crates", ":/shaders"],
    );
    let after = if changed.is_empty() {
        ""
    } else {
        " and changes after it"
    };
    format!("{commit}{after}")
}

/// Today, as YYYY-MM-DD.
pub fn today() -> String {
    first_line_of("date", &["-u", "+%F"])
}

/// Mean number of busy threads over the last minute; empty where the system does not tell.
pub fn load() -> String {
    let load = std::fs::read_to_string("/proc/loadavg").unwrap_or_default();
    load.split(' ').next().unwrap_or_default().to_owned()
}

/// The first line that a program prints; empty where it cannot run.
fn first_line_of(program: &str, arguments: &[&str]) -> String {
    let output = Command::new(program)
        .args(arguments)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output();
    let text = output.map(|output| output.stdout).unwrap_or_default();
    String::from_utf8_lossy(&text)
        .lines()
        .next()
        .unwrap_or_default()
        .to_owned()
}
