//! Interruption.
#![cfg(unix)]

use crate::workplace::Workplace;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// How long a run may work before it is interrupted.
const HEAD_START: Duration = Duration::from_secs(1);

/// How long the first picture of a film may take.
const PATIENCE: Duration = Duration::from_secs(120);

const SIGNALS: [&str; 2] = ["-INT", "-TERM"];

fn started(place: &Workplace, arguments: &[&str]) -> Child {
    let mut command = place.command(arguments);
    command
        .stderr(Stdio::null())
        .spawn()
        .expect("the command starts")
}

/// Sends a signal to a run, and the code that it ends with.
fn interrupted(mut child: Child, signal: &str) -> Option<i32> {
    let process = child.id().to_string();
    let sent = Command::new("kill")
        .args([signal, &process])
        .status()
        .expect("kill starts");
    assert!(sent.success(), "the run should still work");
    child.wait().expect("the command ends").code()
}

#[test]
fn an_interrupted_run_exits_with_130_and_leaves_nothing() {
    let place = Workplace::with_scene();
    let large = ["--size", "12000x12000", "--backend", "cpu"];
    let scene = [&["render", "scene.obj"], &large[..]].concat();
    let smoke = [&["smoke", "cloud", "-o", "cloud.png"], &large[..]].concat();
    // Before there is anything to draw: a simulation of hours.
    let simulation = [
        &["smoke", "plume", "-o", "plume.png", "--grid", "160x160x160"],
        &["--frames", "900..900"][..],
    ]
    .concat();
    for signal in SIGNALS {
        for arguments in [&scene, &smoke, &simulation] {
            let child = started(&place, arguments);
            std::thread::sleep(HEAD_START);
            assert_eq!(interrupted(child, signal), Some(130), "{arguments:?}");
            assert_eq!(place.names(), ["scene.obj"], "{arguments:?}");
        }
    }
}

#[test]
fn an_interrupted_film_leaves_whole_pictures_alone() {
    let film = [
        &[
            "smoke",
            "explosion",
            "-o",
            "film_###.png",
            "--grid",
            "16x24x16",
        ],
        &[
            "--frames",
            "1..200",
            "--size",
            "160x120",
            "--backend",
            "cpu",
        ][..],
    ]
    .concat();
    for signal in SIGNALS {
        let place = Workplace::new();
        assert_whole_pictures(&place, &film, signal);
        for (number, name) in (1..).zip(place.names()) {
            assert_eq!(name, format!("film_{number:03}.png"));
        }
    }
}

/// Interrupts a film of at most 200 pictures after the first, which leaves some pictures, all of them whole.
fn assert_whole_pictures(place: &Workplace, film: &[&str], signal: &str) {
    let is_picture = |name: &String| name.ends_with(".png");
    let child = started(place, film);
    let begun = Instant::now();
    while !place.names().iter().any(is_picture) {
        assert!(begun.elapsed() < PATIENCE, "no picture yet");
        std::thread::sleep(Duration::from_millis(5));
    }
    assert_eq!(interrupted(child, signal), Some(130));
    let names = place.names();
    assert!(names.iter().all(|name| !name.starts_with('.')), "{names:?}");
    let pictures: Vec<&String> = names.iter().filter(|name| is_picture(name)).collect();
    assert!(!pictures.is_empty() && pictures.len() < 200, "{names:?}");
    for name in pictures {
        let picture = image::load_from_memory(&place.get(name)).expect("a whole picture");
        assert_eq!((picture.width(), picture.height()), (160, 120));
    }
}

/// What is left goes on with `--resume`, to the same files as without the interrupt.
#[test]
fn an_interrupted_turntable_leaves_whole_frames_and_goes_on() {
    let film = [
        "animate",
        "scene.obj",
        "--turntable",
        "--length",
        "200",
        "--size",
        "160x120",
        "--backend",
        "cpu",
    ];
    let place = Workplace::with_scene();
    let frames = [&film[..], &["-o", "whole_###.png"]].concat();
    place.npr(&frames).assert_silent_success();
    let whole: Vec<Vec<u8>> = (0..200)
        .map(|number| place.get(&format!("whole_{number:03}.png")))
        .collect();
    for signal in SIGNALS {
        let place = Workplace::with_scene();
        let frames = [&film[..], &["-o", "film_###.png"]].concat();
        assert_whole_pictures(&place, &frames, signal);
        place
            .npr(&[&frames[..], &["--resume"]].concat())
            .assert_silent_success();
        for (number, whole) in whole.iter().enumerate() {
            assert!(
                *whole == place.get(&format!("film_{number:03}.png")),
                "{number}"
            );
        }
    }
}

#[test]
fn an_interrupted_film_in_one_file_leaves_nothing() {
    for name in ["film.gif", "film.apng"] {
        let place = Workplace::with_scene();
        let film = [
            "animate",
            "scene.obj",
            "--turntable",
            "--size",
            "640x480",
            "--backend",
            "cpu",
        ];
        let child = started(
            &place,
            &[&film[..], &["--length", "4000", "-o", name]].concat(),
        );
        std::thread::sleep(HEAD_START);
        assert_eq!(interrupted(child, SIGNALS[0]), Some(130));
        assert_eq!(place.names(), ["scene.obj"], "{name}");
    }
}
