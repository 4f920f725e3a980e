//! Films that ffmpeg encodes; a script stands in for it.
#![cfg(unix)]

use crate::workplace::{Outcome, Workplace};
use std::os::unix::fs::PermissionsExt;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// How long a run may take to start its helper, or a helper to end.
const PATIENCE: Duration = Duration::from_secs(60);

/// A folder with a scene, and with a program ffmpeg that does as `script` says once it is not asked for its version.
/// `$out` is the file to write.
fn place(script: &str) -> Workplace {
    let place = Workplace::with_scene();
    std::fs::create_dir(place.path("bin")).expect("a folder");
    let script = format!(
        "#!/bin/sh\n[ \"$1\" = -version ] && exit 0\nprintf '%s\\n' \"$@\" > arguments\n\
         for out; do :; done\n{script}\n"
    );
    place.put("bin/ffmpeg", script.as_bytes());
    let mode = std::fs::Permissions::from_mode(0o755);
    std::fs::set_permissions(place.path("bin/ffmpeg"), mode).expect("permissions");
    place
}

/// A small film, with the program on the path before all others.
fn command(place: &Workplace, more: &[&str]) -> Command {
    let film = [
        "animate",
        "scene.obj",
        "--turntable",
        "--size",
        "48x32",
        "--backend",
        "cpu",
        "-q",
    ];
    let mut command = place.command(&[&film[..], more].concat());
    let path = std::env::var("PATH").unwrap_or_default();
    command.env("PATH", format!("{}:{path}", place.path("bin").display()));
    command
}

fn run(place: &Workplace, more: &[&str]) -> Outcome {
    Outcome::of(command(place, more).output().expect("it starts"))
}

#[test]
fn ffmpeg_gets_every_frame_and_is_told_what_they_are() {
    for (film, codec, background, pixels) in [
        ("film.mp4", "libx264", "white", "yuv420p"),
        ("film.webm", "libvpx-vp9", "white", "yuv420p"),
        ("film.webm", "libvpx-vp9", "transparent", "yuva420p"),
    ] {
        let place = place("cat > \"$out\"");
        let more = ["--length", "5", "--background", background];
        run(
            &place,
            &[&more[..], &["--fps", "12.5", "-o", film]].concat(),
        )
        .assert_silent_success();
        run(&place, &[&more[..], &["-o", "f_#.png"]].concat()).assert_silent_success();
        let frames = (0..5).flat_map(|number| {
            let file = place.get(&format!("f_{number}.png"));
            image::load_from_memory(&file)
                .expect("a picture")
                .into_rgba8()
                .into_raw()
        });
        assert!(place.get(film) == frames.collect::<Vec<u8>>(), "{film}");
        let arguments = String::from_utf8(place.get("arguments"))
            .expect("text")
            .replace('\n', " ");
        for wanted in [
            "-f rawvideo -pixel_format rgba -video_size 48x32 -framerate 12.5 -i pipe:0",
            &format!("-pix_fmt {pixels} -c:v {codec}"),
        ] {
            assert!(arguments.contains(wanted), "{wanted} is not in {arguments}");
        }
    }
}

#[test]
fn an_ffmpeg_that_fails_is_told_by_its_last_lines_and_leaves_nothing() {
    let script =
        "head -c 5000 > \"$out\"; echo odd >&2; echo 'the card burns' >&2; echo >&2; exit 3";
    let place = place(script);
    let names = ["bin", "scene.obj"];
    for length in ["2", "300"] {
        let outcome = run(&place, &["--length", length, "-o", "film.mp4"]);
        outcome.assert_fault(1, "film.mp4': ffmpeg failed: odd; the card burns");
        std::fs::remove_file(place.path("arguments")).expect("they were told");
        assert_eq!(place.names(), names);
    }
    place.put("film.mp4", b"the old film");
    run(&place, &["--length", "9", "-o", "film.mp4"]).assert_fault(1, "the card burns");
    assert_eq!(place.get("film.mp4"), b"the old film");
}

#[test]
fn without_ffmpeg_other_formats_are_named() {
    let place = Workplace::with_scene();
    for film in ["film.mp4", "film.webm"] {
        let mut command = command(&place, &["-o", film]);
        let outcome = Outcome::of(
            command
                .env("PATH", place.path(""))
                .output()
                .expect("it starts"),
        );
        outcome.assert_fault(1, "there is no program ffmpeg");
        assert!(
            outcome.stderr.contains(".gif, .apng or frame_####.png"),
            "{}",
            outcome.stderr
        );
    }
    assert_eq!(place.names(), ["scene.obj"]);
}

#[test]
fn an_interrupt_ends_ffmpeg_too() {
    let place = place("echo $$ > process; exec sleep 600");
    let mut child = command(&place, &["--length", "400", "-o", "film.mp4"])
        .stderr(Stdio::null())
        .spawn()
        .expect("it starts");
    let begun = Instant::now();
    let helper = loop {
        let said = std::fs::read_to_string(place.path("process")).unwrap_or_default();
        if said.ends_with('\n') {
            break said.trim().to_owned();
        }
        assert!(begun.elapsed() < PATIENCE, "it does not start");
        std::thread::sleep(Duration::from_millis(5));
    };
    let kill = |signal: &str, process: &str| {
        let mut kill = Command::new("kill");
        kill.args([signal, process]).stderr(Stdio::null());
        kill.status().expect("kill starts").success()
    };
    assert!(kill("-0", &helper));
    assert!(kill("-INT", &child.id().to_string()));
    assert_eq!(child.wait().expect("it ends").code(), Some(130));
    assert!(!kill("-0", &helper), "ffmpeg goes on");
    assert_eq!(place.names(), ["arguments", "bin", "process", "scene.obj"]);
}
