//! Examples that are run, not just compiled: what they make must be there.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

use anyhow::{Context, Result, ensure};

use crate::packages::tested_features;
use crate::programs;

/// An example that writes or prints a file.
struct Example {
    name: &'static str,
    /// A file of the project that it reads, where it reads one.
    input: Option<&'static str>,
    /// Ending of the file that it writes; without one it prints.
    ending: Option<&'static str>,
    /// How what it makes begins.
    begins: &'static [u8],
    /// Whether it draws on a graphics device.
    needs_device: bool,
}

const EXAMPLES: [Example; 2] = [
    Example {
        name: "embed_wgpu",
        input: Some("assets/still_life.glb"),
        ending: Some("png"),
        begins: b"\x89PNG",
        needs_device: true,
    },
    Example {
        name: "lines_only",
        input: None,
        ending: None,
        begins: b"<svg",
        needs_device: false,
    },
];

/// Runs every example into a folder below the target; those that need a device only where one is required, as the
/// tests do. They are compiled with the features of the tests, which share everything else with them then.
pub fn run(root: &Path) -> Result<()> {
    let folder = root.join("target/examples");
    fs::create_dir_all(&folder)?;
    let has_device = std::env::var("NPR_REQUIRE_GPU").is_ok_and(|value| value == "1");
    let features = tested_features(root)?;
    let chosen = ["--workspace", "--features", &features];
    let names = EXAMPLES.each_ref().map(|example| example.name);
    let made = programs::examples(root, &chosen, &names)?;
    for (example, program) in EXAMPLES.iter().zip(made) {
        if example.needs_device && !has_device {
            println!(
                "examples: {} needs a device; NPR_REQUIRE_GPU=1 runs it",
                example.name
            );
            continue;
        }
        example.run(root, (&program, &folder))?;
        println!("examples: {} runs", example.name);
    }
    Ok(())
}

impl Example {
    fn run(&self, root: &Path, (program, folder): (&Path, &Path)) -> Result<()> {
        // Run it, with a file that is not there yet.
        let file = self
            .ending
            .map(|ending| folder.join(self.name).with_extension(ending));
        if let Some(file) = &file {
            let _ = fs::remove_file(file);
        }
        let mut command = Command::new(program);
        command
            .current_dir(root)
            .args(self.input)
            .args(&file)
            .stderr(Stdio::inherit());
        let run = command.output()?;
        ensure!(run.status.success(), "example {} failed", self.name);

        // Look at what it made.
        let made = match file {
            Some(file) => fs::read(file),
            None => Ok(run.stdout),
        };
        let made = made.with_context(|| format!("example {} wrote nothing", self.name))?;
        ensure!(
            made.starts_with(self.begins),
            "example {} made something else",
            self.name
        );
        Ok(())
    }
}
