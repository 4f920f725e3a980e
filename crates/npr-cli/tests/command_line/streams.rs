//! Standard input and output.

use crate::workplace::{Outcome, Workplace};
use std::process::Stdio;

const SMALL: [&str; 4] = ["--size", "48x32", "--backend", "cpu"];

#[test]
fn a_scene_comes_from_standard_input_and_the_picture_goes_to_standard_output() {
    let place = Workplace::with_scene();
    let scene = place.get("scene.obj");
    let arguments = [&["render", "-", "-o", "-"][..], &SMALL].concat();
    let outcome = place.npr_fed(&arguments, &scene);
    outcome.assert_silent_success();
    place.render("scene.obj", &[]).assert_silent_success();
    assert_eq!(
        outcome.stdout,
        place.get("scene.png"),
        "the same bytes as into a file"
    );
}

#[test]
fn broken_standard_input_is_named_in_the_message() {
    let place = Workplace::new();
    for input in [
        &b""[..],
        b"neither fish nor fowl",
        b"glTF\x02\0\0\0\xff\xff\xff\xff",
    ] {
        let arguments = [&["render", "-", "-o", "out.png"][..], &SMALL].concat();
        place
            .npr_fed(&arguments, input)
            .assert_fault(3, "cannot read standard input: ");
        assert!(place.names().is_empty());
    }
}

#[test]
fn a_closed_pipe_is_a_quiet_success() {
    let place = Workplace::with_scene();
    let commands: [&[&str]; 6] = [
        &["render", "scene.obj", "-o", "-", "--backend", "cpu"],
        &["lines", "scene.obj", "-o", "-"],
        &["lines", "scene.obj", "-o", "-", "--format", "png"],
        &["styles", "schema"],
        &["info", "scene.obj"],
        &["--help"],
    ];
    for arguments in commands {
        let mut command = place.command(arguments);
        command
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        let mut child = command.spawn().expect("the command starts");
        drop(child.stdout.take());
        let outcome = Outcome::of(child.wait_with_output().expect("the command ends"));
        outcome.assert_silent_success();
    }
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_disk_exits_with_1() {
    let place = Workplace::with_scene();
    let full = std::fs::File::options()
        .write(true)
        .open("/dev/full")
        .expect("a full device");
    let mut command = place.command(&["render", "scene.obj", "-o", "-", "--backend", "cpu"]);
    let output = command
        .stdout(full)
        .stderr(Stdio::piped())
        .output()
        .expect("the command starts");
    Outcome::of(output).assert_fault(1, "cannot write to standard output: No space left");
}

#[test]
fn standard_error_may_be_closed() {
    let place = Workplace::new();
    let mut command = place.command(&["render", "nowhere.glb"]);
    let mut child = command
        .stderr(Stdio::piped())
        .spawn()
        .expect("the command starts");
    drop(child.stderr.take());
    assert_eq!(child.wait().expect("the command ends").code(), Some(1));
}
