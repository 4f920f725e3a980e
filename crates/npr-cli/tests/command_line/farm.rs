//! The script that draws a film on a Slurm cluster; another script stands in for `sbatch`.
#![cfg(unix)]

use crate::workplace::{Outcome, Workplace};
use std::os::unix::fs::PermissionsExt;
use std::process::Command;

/// Runs the tasks of an array one after the other, as Slurm does all at once: each with its number, from a copy of the
/// script. What it was told goes into a file.
const SBATCH: &str = "#!/bin/sh
printf '%s ' \"$@\" >> told
while [ \"${1#--}\" != \"$1\" ]; do
    case $1 in --array=0-*) last=${1#--array=0-} ;; esac
    shift
done
cp \"$1\" spooled.sh
shift
task=0
while [ $task -le $last ]; do
    SLURM_ARRAY_TASK_ID=$task sh spooled.sh \"$@\" || exit 1
    task=$((task + 1))
done
";

fn place() -> Workplace {
    let place = Workplace::with_scene();
    std::fs::create_dir(place.path("bin")).expect("a folder");
    place.put("bin/sbatch", SBATCH.as_bytes());
    let mode = std::fs::Permissions::from_mode(0o755);
    std::fs::set_permissions(place.path("bin/sbatch"), mode).expect("permissions");
    place
}

/// Runs the script of the docs in the folder.
fn farm(place: &Workplace, arguments: &str) -> Outcome {
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/farm/slurm.sh");
    let path = std::env::var("PATH").unwrap_or_default();
    let mut command = Command::new("sh");
    command
        .arg(script)
        .args(arguments.split(' '))
        .current_dir(place.path(""))
        .env_remove("SLURM_ARRAY_TASK_ID")
        .env("NPR", env!("CARGO_BIN_EXE_npr"))
        .env("PATH", format!("{}:{path}", place.path("bin").display()));
    Outcome::of(command.output().expect("a shell"))
}

#[test]
fn a_farm_draws_the_film_that_one_run_draws() {
    for (length, parts) in [(7, 3), (2, 4)] {
        let place = place();
        let film = "--turntable --size 48x32 --backend cpu";
        let line = format!("animate scene.obj {film} --length {length} -o whole_##.png");
        let words: Vec<&str> = line.split(' ').collect();
        place.npr(&words).assert_silent_success();
        let drawn = format!("{length} {parts} scene.obj {film} -o part_##.png");
        farm(&place, &drawn).assert_silent_success();
        let is_same = |number: u32| {
            let whole = place.get(&format!("whole_{number:02}.png"));
            whole == place.get(&format!("part_{number:02}.png"))
        };
        assert!((0..length).all(is_same), "{length} frames in {parts} parts");
        let names = place.names();
        let count = names
            .iter()
            .filter(|name| name.starts_with("part_"))
            .count();
        assert_eq!(count as u32, length);
        let told = String::from_utf8(place.get("told")).expect("text");
        assert!(told.contains(&format!("--array=0-{}", parts - 1)), "{told}");

        // A task that was lost is drawn by the same line again, and no other frame is drawn anew.
        std::fs::remove_file(place.path("part_01.png")).expect("a frame");
        place.put("part_00.png", b"mine");
        farm(&place, &drawn).assert_silent_success();
        assert!(is_same(1) && place.get("part_00.png") == b"mine");
    }
}

#[test]
fn a_farm_needs_a_length_and_a_scene() {
    let outcome = farm(&place(), "7 3");
    assert_eq!(outcome.code, Some(2));
    assert!(outcome.stderr.starts_with("usage: "), "{}", outcome.stderr);
}
