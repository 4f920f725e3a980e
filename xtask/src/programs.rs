//! Test programs: made by cargo, and run side by side.

use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::{Mutex, mpsc};
use std::time::{Duration, Instant};

use anyhow::{Context, Result};
use serde::Deserialize;

use crate::packages::{Package, cargo, members, output};

/// How many programs run at a time, where there are as many cores. Each has a thread a core, and leaves cores idle
/// while its longest test ends: another one works in that time.
const AT_ONCE: usize = 2;

/// A test program.
#[derive(Debug, Clone)]
pub struct Program {
    /// The file that is run.
    executable: PathBuf,
    /// Its name among the programs of its package.
    target: String,
    package: Package,
}

/// What came of a program that ran.
pub struct Run {
    /// Everything it printed, in order.
    pub text: String,
    /// How long it took.
    pub time: Duration,
    /// Whether all its tests passed.
    pub is_success: bool,
}

/// A line of what cargo says while it compiles, as far as it is read.
#[derive(Deserialize)]
struct Message {
    /// The program, where one was made.
    executable: Option<PathBuf>,
    manifest_path: Option<PathBuf>,
    profile: Option<Profile>,
    target: Option<Target>,
}

#[derive(Deserialize)]
struct Profile {
    /// Whether it is compiled with its tests.
    test: bool,
}

#[derive(Deserialize)]
struct Target {
    name: String,
}

/// The program that cargo, called with `arguments`, makes of every one of the examples, in their order. O(messages).
pub fn examples(root: &Path, arguments: &[&str], names: &[&str]) -> Result<Vec<PathBuf>> {
    let mut command = cargo(root);
    command
        .args(["build", "--message-format", "json-render-diagnostics"])
        .args(arguments)
        .args(names.iter().flat_map(|name| ["--example", name]));
    let messages = output(&mut command)?;
    let messages = messages.lines().map(serde_json::from_str::<Message>);
    let messages = messages.collect::<Result<Vec<_>, _>>()?;
    let made = |name: &&str| {
        let of_name = |message: &&Message| {
            let target = message.target.as_ref();
            message.executable.is_some() && target.is_some_and(|target| target.name == *name)
        };
        let message = messages.iter().find(of_name);
        let executable = message.and_then(|message| message.executable.clone());
        executable.with_context(|| format!("cargo made no example {name}"))
    };
    names.iter().map(made).collect()
}

impl Program {
    /// Compiles the test programs that `arguments` ask `cargo test` for, largest file first: these link the renderer,
    /// and take longest.
    pub fn compile(root: &Path, arguments: &[&str]) -> Result<Vec<Self>> {
        let mut command = cargo(root);
        command
            .args([
                "test",
                "--no-run",
                "--message-format",
                "json-render-diagnostics",
            ])
            .args(arguments);
        let messages = output(&mut command)?;
        let packages = members(root)?;
        let mut programs = Vec::new();
        for line in messages.lines() {
            programs.extend(Self::of(serde_json::from_str(line)?, &packages));
        }
        programs.sort_by_cached_key(|program: &Self| {
            let file = program.executable.metadata();
            std::cmp::Reverse(file.map_or(0, |file| file.len()))
        });
        Ok(programs)
    }

    /// The test program of a message, if it tells of one.
    fn of(message: Message, packages: &[Package]) -> Option<Self> {
        let is_test = message.profile.is_some_and(|profile| profile.test);
        let manifest = message.manifest_path.filter(|_| is_test)?;
        let mut packages = packages.iter();
        Some(Self {
            executable: message.executable?,
            target: message.target?.name,
            package: packages
                .find(|package| package.manifest_path == manifest)?
                .clone(),
        })
    }

    /// The names of its package and of what it tests there.
    pub fn name(&self) -> String {
        format!("{}, {}", self.package.name, self.target)
    }

    /// Runs the program as `cargo test` would.
    fn run(&self, arguments: &[&str], environment: &[(&str, String)]) -> Result<Run> {
        let begun = Instant::now();
        let (mut reader, writer) = std::io::pipe()?;
        let Package { name, version, .. } = &self.package;
        let mut child = Command::new(&self.executable)
            .args(arguments)
            .envs(environment.iter().map(|(name, value)| (name, value)))
            .env("CARGO_MANIFEST_DIR", self.package.folder())
            .env("CARGO_MANIFEST_PATH", &self.package.manifest_path)
            .env("CARGO_PKG_NAME", name)
            .env("CARGO_PKG_VERSION", version)
            .current_dir(self.package.folder())
            .stdin(Stdio::null())
            .stdout(writer.try_clone()?)
            .stderr(writer)
            .spawn()?;
        let mut text = Vec::new();
        reader.read_to_end(&mut text)?;
        Ok(Run {
            text: String::from_utf8_lossy(&text).into_owned(),
            is_success: child.wait()?.success(),
            time: begun.elapsed(),
        })
    }
}

/// Runs programs in their order, two at a time, and tells of each once it has ended.
pub fn run_all<'a>(
    programs: &'a [Program],
    arguments: &[&str],
    environment: &[(&str, String)],
    mut tell: impl FnMut(&'a Program, Result<Run>),
) {
    let waiting = Mutex::new(programs.iter());
    let next = || waiting.lock().ok()?.next();
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let (sender, ended) = mpsc::channel();
    std::thread::scope(|scope| {
        for _ in 0..AT_ONCE.min(cores) {
            let (sender, next) = (sender.clone(), &next);
            scope.spawn(move || {
                while let Some(program) = next() {
                    // Nobody hears of it where the receiver panicked.
                    let _ = sender.send((program, program.run(arguments, environment)));
                }
            });
        }
        drop(sender);
        ended.iter().for_each(|(program, run)| tell(program, run));
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    fn package(folder: &str) -> Package {
        Package {
            name: "npr-mesh".to_owned(),
            manifest_path: Path::new(folder).join("Cargo.toml"),
            ..Package::default()
        }
    }

    #[test]
    fn programs_are_what_was_compiled_with_its_tests() {
        let packages = [package("/a/npr-core"), package("/a/npr-mesh")];
        let told = |line: &str| Program::of(serde_json::from_str(line).expect("JSON"), &packages);
        let made = r#"{"reason":"compiler-artifact","manifest_path":"/a/npr-mesh/Cargo.toml",
            "target":{"kind":["test"],"name":"meshes"},"profile":{"test":true},"executable":"/t/meshes-1"}"#;
        let program = told(made).expect("a program");
        assert_eq!(program.name(), "npr-mesh, meshes");
        assert_eq!(program.executable, Path::new("/t/meshes-1"));
        assert!(told(&made.replace("true", "false")).is_none());
        assert!(told(&made.replace("\"/t/meshes-1\"", "null")).is_none());
        assert!(told(r#"{"reason":"build-finished","success":true}"#).is_none());
    }

    #[test]
    #[cfg(unix)]
    fn every_program_runs_once_and_keeps_what_it_prints_together() {
        let program = |target: &str| Program {
            executable: "/bin/sh".into(),
            target: target.to_owned(),
            package: package(env!("CARGO_MANIFEST_DIR")),
        };
        let programs = ["a", "b", "c"].map(program);
        let here = env!("CARGO_MANIFEST_DIR");
        let script = "echo $WORD; echo $CARGO_PKG_NAME >&2; pwd; test $WORD = no";
        for (word, is_success) in [("no", true), ("yes", false)] {
            let mut names = Vec::new();
            let environment = [("WORD", word.to_owned())];
            run_all(&programs, &["-c", script], &environment, |program, run| {
                let run = run.expect("a shell");
                assert_eq!(run.text, format!("{word}\nnpr-mesh\n{here}\n"));
                assert_eq!(run.is_success, is_success);
                names.push(program.target.as_str());
            });
            names.sort_unstable();
            assert_eq!(names, ["a", "b", "c"]);
        }
    }
}
