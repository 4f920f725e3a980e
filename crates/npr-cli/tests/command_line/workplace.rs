//! A folder of its own for a test, and runs of the command in it.

use npr_gpu::testing::is_device_required;
use std::io::Write;
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};
use tempfile::TempDir;

/// A folder of its own for a test; gone when the test is over.
pub struct Workplace {
    folder: TempDir,
}

/// What a run left: exit code and streams.
pub struct Outcome {
    pub code: Option<i32>,
    pub stdout: Vec<u8>,
    pub stderr: String,
}

impl Workplace {
    /// An empty folder.
    pub fn new() -> Self {
        Self {
            folder: tempfile::tempdir().expect("a temporary folder"),
        }
    }

    /// A folder with a small scene in `scene.obj`: one triangle.
    pub fn with_scene() -> Self {
        let place = Self::new();
        place.put("scene.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
        place
    }

    /// Puts a file into the folder.
    #[expect(
        clippy::disallowed_methods,
        reason = "a test's own file may be half written"
    )]
    pub fn put(&self, name: &str, bytes: &[u8]) {
        std::fs::write(self.path(name), bytes).expect("a file in the temporary folder");
    }

    /// The path of a file in the folder.
    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// The bytes of a file in the folder.
    pub fn get(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.path(name)).expect("a file in the temporary folder")
    }

    /// Names of all that lies in the folder, sorted.
    pub fn names(&self) -> Vec<String> {
        let entries = std::fs::read_dir(self.folder.path()).expect("the temporary folder");
        let mut names: Vec<String> = entries
            .map(|entry| {
                entry
                    .expect("an entry")
                    .file_name()
                    .to_string_lossy()
                    .into_owned()
            })
            .collect();
        names.sort();
        names
    }

    /// The command, to be run in the folder.
    pub fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_npr"));
        command.args(arguments).current_dir(self.folder.path());
        command
    }

    /// Runs the command in the folder, with nothing on standard input.
    pub fn npr(&self, arguments: &[&str]) -> Outcome {
        let output = self.command(arguments).stdin(Stdio::null()).output();
        Outcome::of(output.expect("the command starts"))
    }

    /// Runs the command in the folder, with `input` on standard input.
    pub fn npr_fed(&self, arguments: &[&str], input: &[u8]) -> Outcome {
        let mut command = self.command(arguments);
        command
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        let mut child = command.spawn().expect("the command starts");
        let mut stdin = child.stdin.take().expect("a pipe");
        // A command that refuses its arguments reads nothing, which closes the pipe.
        let _ = stdin.write_all(input);
        drop(stdin);
        Outcome::of(child.wait_with_output().expect("the command ends"))
    }

    /// Asserts of every command line that it exits with 2 and one line that contains the text beside it, and
    /// that it leaves nothing beside the scene.
    #[track_caller]
    pub fn assert_refused(&self, cases: &[(&[&str], &str)]) {
        for (arguments, text) in cases {
            self.npr(arguments).assert_fault(2, text);
            assert_eq!(self.names(), ["scene.obj"], "{arguments:?}");
        }
    }

    /// Asserts that a command that demands a device succeeds; where there is none and none is required, that it exits
    /// with 4 and leaves nothing beside the scene.
    #[track_caller]
    pub fn assert_done_or_no_device(&self, arguments: &[&str]) {
        let outcome = self.npr(&[arguments, &["--backend", "gpu"]].concat());
        if outcome.code == Some(4) && !is_device_required() {
            outcome.assert_fault(4, "no graphics device");
            assert_eq!(self.names(), ["scene.obj"]);
        } else {
            outcome.assert_silent_success();
        }
    }

    /// Runs a small render of a scene on the processor.
    pub fn render(&self, scene: &str, more: &[&str]) -> Outcome {
        let mut arguments = vec!["render", scene, "--size", "48x32", "--backend", "cpu"];
        arguments.extend(more);
        self.npr(&arguments)
    }
}

impl Outcome {
    pub fn of(output: Output) -> Self {
        Self {
            code: output.status.code(),
            stdout: output.stdout,
            stderr: String::from_utf8(output.stderr).expect("messages are UTF-8"),
        }
    }

    /// Standard output as text.
    pub fn text(&self) -> &str {
        std::str::from_utf8(&self.stdout).expect("text on standard output")
    }

    /// Asserts success without a word on standard error.
    #[track_caller]
    pub fn assert_silent_success(&self) {
        assert_eq!((self.code, self.stderr.as_str()), (Some(0), ""));
    }

    /// Asserts an exit code with one line of fewer than 300 characters that contains `text`, and nothing on
    /// standard output.
    #[track_caller]
    pub fn assert_fault(&self, code: i32, text: &str) {
        let line = self.stderr.trim_end_matches('\n');
        assert_eq!(self.code, Some(code), "{line}");
        assert!(line.starts_with("npr: ") && line.contains(text), "{line}");
        assert!(line.chars().count() < 300 && !line.contains('\n'), "{line}");
        assert!(!line.contains("os error") && !line.contains("::"), "{line}");
        assert_eq!(self.text(), "");
    }
}
