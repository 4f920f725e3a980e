//! Films: parts and wholes, files of all formats, and what is refused.

use crate::files::tiny_png;
use crate::workplace::{Outcome, Workplace};
use std::collections::BTreeMap;

/// A box with a leaf at its side: no two views of a turn are the same.
const BOX: &[u8] = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n\
    f 5 6 7 8\nf 6 2 3 7\nf 8 7 3 4\nf 1 2 6 5\nf 1 5 8 4\nf 2 1 4 3\n\
    v 1.05 0 0\nv 2 0 0\nv 2 1 0\nv 1.05 1 0\nf 9 10 11 12\n";

/// A film of the box on the processor.
const FILM: [&str; 4] = ["animate", "box.obj", "--backend", "cpu"];

const SMALL: [&str; 2] = ["--size", "48x32"];

fn place() -> Workplace {
    let place = Workplace::new();
    place.put("box.obj", BOX);
    place
}

fn animate(place: &Workplace, more: &[&str]) -> Outcome {
    let small = if more.contains(&SMALL[0]) {
        &[]
    } else {
        &SMALL[..]
    };
    place.npr(&[&FILM[..], small, more].concat())
}

/// Draws a film, which must succeed without a word.
#[track_caller]
fn draw(place: &Workplace, more: &str) {
    let words: Vec<&str> = more.split(' ').collect();
    animate(place, &words).assert_silent_success();
}

/// The files of a folder whose names begin with `start`.
fn files(place: &Workplace, start: &str) -> BTreeMap<String, Vec<u8>> {
    let names = place.names().into_iter();
    names
        .filter(|name| name.starts_with(start))
        .map(|name| (name[start.len()..].to_owned(), place.get(&name)))
        .collect()
}

/// The pixels of a picture.
fn pixels(file: &[u8]) -> Vec<[u8; 4]> {
    let picture = image::load_from_memory(file).expect("a picture");
    picture.into_rgba8().pixels().map(|pixel| pixel.0).collect()
}

/// How many pixels of two pictures differ by more than a little.
fn differing(a: &[u8], b: &[u8]) -> usize {
    let is_far = |(a, b): &([u8; 4], [u8; 4])| a.iter().zip(b).any(|(a, b)| a.abs_diff(*b) > 8);
    pixels(a).into_iter().zip(pixels(b)).filter(is_far).count()
}

#[test]
fn a_film_in_parts_is_the_same_film_in_every_format_and_on_both_engines() {
    let formats = [
        ("png", "cpu"),
        ("png", "gpu"),
        ("exr", "cpu"),
        ("svg", "cpu"),
        ("svg", "gpu"),
        ("json", "cpu"),
        ("pdf", "cpu"),
        ("png --lines", "cpu"),
    ];
    for (format, backend) in formats {
        let place = place();
        if backend == "gpu" && place.npr(&["doctor"]).code != Some(0) {
            continue;
        }
        let part = |name: &str, more: &str| {
            let line = format!(
                "animate box.obj --size 48x32 -q --style comic-silver --turntable --length 5 {more} \
                 -o {name}##.{format} --backend {backend}"
            );
            let words: Vec<&str> = line.split_whitespace().collect();
            place.npr(&words).assert_silent_success();
        };
        part("whole", "");
        part("parts", "--frames 3..4");
        part("parts", "--frames 0..2");
        let whole = files(&place, "whole");
        assert_eq!(whole.len(), 5);
        let distinct: std::collections::BTreeSet<&Vec<u8>> = whole.values().collect();
        assert_eq!(distinct.len(), 5, "{format} {backend}: it moves");
        assert!(whole == files(&place, "parts"), "{format} {backend}");
    }
}

#[test]
fn frame_0_is_the_picture_and_a_turn_ends_where_it_begins() {
    let place = place();
    let view = "--eye 4,2,3 --size 48x32 -q";
    for (command, ending) in [
        ("render", "png"),
        ("render", "exr"),
        ("lines", "svg"),
        ("lines", "json"),
    ] {
        draw(
            &place,
            &format!("{view} --turntable --length 4 --frames 0..4 -o f_#.{ending}"),
        );
        let line = format!("{command} box.obj {view} --backend cpu -o still.{ending}");
        let words: Vec<&str> = line.split(' ').collect();
        place.npr(&words).assert_silent_success();
        let still = place.get(&format!("still.{ending}"));
        let frame = |number: u32| place.get(&format!("f_{number}.{ending}"));
        assert!(still == frame(0), "{ending}: frame 0 is the picture");
        assert!(
            frame(4) == frame(0),
            "{ending}: frame 4 of 4 is the first again"
        );
        assert!(frame(2) != frame(0), "{ending}: it turns");
    }
}

/// Seen from above with x to the right, z comes down the page: a quarter turn counter-clockwise leads from +z to +x.
#[test]
fn the_camera_turns_counter_clockwise_as_seen_from_above() {
    let place = place();
    let target = "--target 1,0.5,0.2 -q";
    let views = [("right", "4,0.5,0.2"), ("left", "-2,0.5,0.2")];
    for (name, eye) in views {
        let line =
            format!("render box.obj --eye {eye} {target} --size 48x32 --backend cpu -o {name}.png");
        let words: Vec<&str> = line.split(' ').collect();
        place.npr(&words).assert_silent_success();
    }
    let [right, left] = views.map(|(name, _)| place.get(&format!("{name}.png")));
    assert!(differing(&right, &left) > 100);
    for (way, wanted) in [
        ("--orbit 90", &right),
        ("--orbit -90", &left),
        ("--turntable --length 4", &right),
    ] {
        draw(
            &place,
            &format!("{way} --frames 1 --eye 1,0.5,3.2 {target} -o turned.png"),
        );
        let off = differing(&place.get("turned.png"), wanted);
        assert!(off < 10, "{way}: {off} pixels");
    }
}

/// A long box must not leave the picture where it comes towards the eye, nor be small for that.
#[test]
fn all_of_a_turn_is_framed() {
    let place = Workplace::new();
    let long = "v -5 0 -0.2\nv 5 0 -0.2\nv 5 1 0.2\nv -5 1 0.2\nf 1 2 3 4\nf 4 3 2 1\n";
    place.put("box.obj", long.as_bytes());
    draw(
        &place,
        "--turntable --length 12 --size 96x64 -q -o f_##.png",
    );
    draw(
        &place,
        "--turntable --length 12 --size 96x64 -q -o l_##.png --lines",
    );
    let mut widest = 0;
    for (name, file) in files(&place, "f_").iter().chain(&files(&place, "l_")) {
        let pixels = pixels(file);
        let paper = pixels[0];
        let columns = (0..96).filter(|x| (0..64).any(|y| pixels[y * 96 + x] != paper));
        let columns: Vec<usize> = columns.collect();
        let rows = (0..64).filter(|y| (0..96).any(|x| pixels[y * 96 + x] != paper));
        let rows: Vec<usize> = rows.collect();
        let is_inside = columns[0] > 0 && columns[columns.len() - 1] < 95;
        assert!(
            is_inside && rows[0] > 0 && rows[rows.len() - 1] < 63,
            "{name}"
        );
        widest = widest.max(columns.len());
    }
    assert!(widest > 64, "{widest} of 96 columns");
}

#[test]
fn resume_leaves_what_is_there_and_draws_the_rest() {
    let place = place();
    let film = "--turntable --length 5 -o f_##.png";
    draw(&place, film);
    let whole = files(&place, "f_");
    for name in ["f_01.png", "f_04.png"] {
        std::fs::remove_file(place.path(name)).expect("a frame");
    }
    place.put("f_02.png", b"mine");
    draw(&place, &format!("{film} --resume"));
    assert_eq!(place.get("f_02.png"), b"mine");
    let mut resumed = files(&place, "f_");
    resumed.insert("02.png".to_owned(), whole["02.png"].clone());
    assert!(whole == resumed);
    // With all frames there, none is drawn.
    for name in place.names().iter().filter(|name| *name != "box.obj") {
        place.put(name, b"mine");
    }
    draw(&place, &format!("{film} --resume"));
    assert!(files(&place, "f_").values().all(|file| file == b"mine"));
}

#[test]
fn the_number_of_threads_changes_nothing() {
    for ending in ["png", "svg", "gif", "gif --lines"] {
        let place = place();
        let drawn = |threads: &str| {
            let name = if ending.starts_with("gif") {
                "film"
            } else {
                "f_#"
            };
            let line = format!("--turntable --length 5 -q -o {name}.{ending}");
            let words: Vec<&str> = line.split(' ').collect();
            let mut command = place.command(&[&FILM[..], &SMALL, &words].concat());
            command.env("RAYON_NUM_THREADS", threads);
            Outcome::of(command.output().expect("it starts")).assert_silent_success();
            files(&place, "f")
        };
        assert!(drawn("1") == drawn("3"), "{ending}");
    }
}

/// The frames of a .png film, drawn anew with the options of another.
fn frames(place: &Workplace, film: &str) -> Vec<Vec<[u8; 4]>> {
    draw(place, &format!("{film} -o check_##.png"));
    files(place, "check_")
        .values()
        .map(|file| pixels(file))
        .collect()
}

#[test]
fn an_apng_holds_every_frame_exactly() {
    for film in [
        "--turntable --length 6 --fps 12.5",
        "--orbit 60 --frames 2..4 --background transparent --fps 12.5",
    ] {
        let place = place();
        let wanted = frames(&place, &format!("{film} -q"));
        draw(&place, &format!("{film} -o film.apng"));
        let mut reader = png::Decoder::new(std::io::Cursor::new(place.get("film.apng")))
            .read_info()
            .expect("a header");
        let control = reader.info().animation_control.expect("an animation");
        assert_eq!(
            (control.num_frames as usize, control.num_plays),
            (wanted.len(), 0)
        );
        for frame in &wanted {
            let mut held = vec![0; reader.output_buffer_size().expect("a size")];
            reader.next_frame(&mut held).expect("a frame");
            let delay = reader.info().frame_control.expect("a control");
            assert_eq!((delay.delay_num, delay.delay_den), (10, 125));
            assert!(held.as_chunks::<4>().0 == frame, "{film}");
        }
    }
}

/// The frames of a GIF file as a viewer shows them, and their delays in hundredths of a second.
fn played(file: &[u8]) -> (Vec<Vec<[u8; 4]>>, Vec<u16>) {
    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::RGBA);
    let mut reader = options.read_info(file).expect("a header");
    assert_eq!(reader.repeat(), gif::Repeat::Infinite);
    let (width, height) = (usize::from(reader.width()), usize::from(reader.height()));
    let mut canvas = vec![[0; 4]; width * height];
    let (mut shown, mut delays) = (Vec::new(), Vec::new());
    while let Some(frame) = reader.read_next_frame().expect("a frame") {
        let pixels = frame.buffer.as_chunks::<4>().0;
        for (y, row) in pixels.chunks(usize::from(frame.width)).enumerate() {
            for (x, pixel) in row.iter().enumerate().filter(|(_, pixel)| pixel[3] > 0) {
                canvas[(y + usize::from(frame.top)) * width + x + usize::from(frame.left)] = *pixel;
            }
        }
        shown.push(canvas.clone());
        delays.push(frame.delay);
        if frame.dispose == gif::DisposalMethod::Background {
            canvas.fill([0; 4]);
        }
    }
    (shown, delays)
}

#[test]
fn a_gif_plays_the_frames_at_their_times() {
    let films = [
        "--turntable --length 7 --size 160x90 --style toon",
        "--turntable --length 7 --size 160x90 --style comic-silver",
        "--orbit 30 --frames 0..4 --background transparent",
        "--turntable --length 4 --lines",
    ];
    for film in films {
        let place = place();
        let wanted = frames(&place, &format!("{film} -q"));
        draw(&place, &format!("{film} -q -o film.gif"));
        let (shown, delays) = played(&place.get("film.gif"));
        assert_eq!(shown.len(), wanted.len());
        // At 24 frames a second a frame begins at the nearest hundredth.
        let begins = |frame: usize| (frame as f64 * 100.0 / 24.0).round() as u16;
        for (frame, delay) in delays.iter().enumerate() {
            assert_eq!(*delay, begins(frame + 1) - begins(frame));
        }
        let (mut sum, mut most) = (0, 0);
        for (shown, wanted) in shown.iter().flatten().zip(wanted.iter().flatten()) {
            let is_clear = wanted[3] < 128;
            assert_eq!(shown[3], if is_clear { 0 } else { 255 }, "{film}");
            for (shown, wanted) in shown.iter().zip(wanted).take(3).filter(|_| !is_clear) {
                let off = u32::from(shown.abs_diff(*wanted));
                (sum, most) = (sum + off, most.max(off));
            }
        }
        let mean = f64::from(sum) / (3 * shown.len() * wanted[0].len()) as f64;
        println!("{film}: {mean} of 255, {most} at most");
        assert!(
            mean < 0.5 && most <= 24,
            "{film}: {mean} of 255, {most} at most"
        );
        assert!(
            place.names().iter().all(|name| !name.starts_with('.')),
            "nothing stays beside it"
        );
    }
}

#[test]
fn what_does_not_fit_together_is_refused_before_any_work() {
    let place = Workplace::with_scene();
    let turn = ["animate", "scene.obj", "--turntable"];
    place.assert_refused(&[
        (&["animate"], "<SCENE>"),
        (
            &["animate", "scene.obj"],
            "nothing moves: no clip plays; say --turntable or --orbit DEG",
        ),
        (
            &["animate", "scene.obj", "--orbit", "2"],
            "--frames A..B or --length N",
        ),
        (&["animate", "scene.obj", "--orbit", "0"], "not be 0"),
        (
            &[&turn[..], &["--orbit", "2"]].concat(),
            "cannot be used with",
        ),
        (
            &[&turn[..], &["-o", "film.png"]].concat(),
            "120 frames do not fit into one file",
        ),
        (
            &[&turn[..], &["-o", "-"]].concat(),
            "120 frames do not fit into one file",
        ),
        (
            &[&turn[..], &["-o", "film.avi"]].concat(),
            "films are written as .gif",
        ),
        (
            &[&turn[..], &["-o", "film_##.gif"]].concat(),
            "holds all frames: its name takes no #",
        ),
        (
            &[&turn[..], &["-o", "film.gif", "--resume"]].concat(),
            "--resume goes on with numbered files",
        ),
        (
            &[&turn[..], &["-o", "film.gif", "--fps", "60"]].concat(),
            "more than 50 frames a second",
        ),
        (
            &[&turn[..], &["-o", "film.mp4", "--size", "63x32"]].concat(),
            "say --size 64x32",
        ),
        (
            &[
                &turn[..],
                &["-o", "film.mp4", "--background", "transparent"],
            ]
            .concat(),
            ".mp4 has no transparency",
        ),
        (
            &[&turn[..], &["-o", "f_#.exr", "--lines"]].concat(),
            "--lines: .exr files",
        ),
        (
            &[&turn[..], &["--frames", "9..1"]].concat(),
            "must not end before it begins",
        ),
        (&[&turn[..], &["--camera", "0"]].concat(), "no camera '0'"),
    ]);
    place
        .npr(&[&turn[..], &["--frames", "0..4000000000"]].concat())
        .assert_fault(5, "exceed the limit of 1000000 a run");
    place
        .npr(&[&turn[..], &["-o", "no/where_##.png"]].concat())
        .assert_fault(1, "there is no folder 'no'");
    assert_eq!(place.names(), ["scene.obj"]);
}

#[test]
fn a_frame_never_lies_on_an_input() {
    let place = Workplace::new();
    let scene =
        b"mtllib scene.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl paint\nf 1/1 2/1 3/1\n";
    place.put("box.obj", scene);
    place.put("scene.mtl", b"newmtl paint\nmap_Kd f_3.png\n");
    place.put("f_3.png", &tiny_png());
    animate(&place, &["--turntable", "--length", "5", "-o", "f_#.png"])
        .assert_fault(2, "f_3.png': it is also an input");
    assert_eq!(place.get("f_3.png"), tiny_png());
    animate(&place, &["--turntable", "--length", "3", "-o", "f_#.png"]).assert_silent_success();
}

#[test]
#[cfg(target_os = "linux")]
fn a_folder_that_takes_no_files_ends_the_film() {
    let turn = ["--turntable", "--length", "3", "-o"];
    for name in [
        "/proc/f_#.png",
        "/proc/f_#.svg",
        "/proc/film.gif",
        "/proc/film.apng",
    ] {
        animate(&place(), &[&turn[..], &[name]].concat()).assert_fault(1, "cannot write '/proc/f");
    }
}

/// A shell lets no file grow beyond some blocks, as a full disk would.
#[test]
#[cfg(target_os = "linux")]
fn a_full_disk_is_told_and_finished_frames_stay() {
    let place = place();
    let drawn = |blocks: &str, more: &str| {
        let npr = env!("CARGO_BIN_EXE_npr");
        let line = format!(
            "trap '' XFSZ; ulimit -f {blocks}; exec {npr} {} {more}",
            FILM.join(" ")
        );
        let mut shell = std::process::Command::new("bash");
        shell.args(["-c", &line]).current_dir(place.path(""));
        Outcome::of(shell.output().expect("a shell"))
    };
    // First nothing is seen, which makes small files, then the box.
    let view = "--eye 0.5,0.5,9 --target 0.5,0.5,12 --orbit 60 --frames 0..5 -q";
    drawn("1", &format!("{view} --size 320x200 -o f_#.svg")).assert_fault(1, "f_3.svg': ");
    let left = ["box.obj", "f_0.svg", "f_1.svg", "f_2.svg"];
    assert_eq!(place.names(), left);
    assert!(place.get("f_2.svg").ends_with(b"</svg>\n"), "it is whole");
    for film in ["film.gif", "film.apng"] {
        let turn = "--turntable --length 12 --size 320x200 --style stipple -q";
        drawn("3", &format!("{turn} -o {film}")).assert_fault(1, film);
        assert_eq!(place.names(), left);
    }
}

/// The most memory of a run, in kilobytes.
#[cfg(target_os = "linux")]
fn most_memory(place: &Workplace, more: &str) -> u64 {
    let words: Vec<&str> = more.split(' ').collect();
    let mut child = place
        .command(&[&FILM[..], &words].concat())
        .spawn()
        .expect("it starts");
    let mut most = 0;
    let status = format!("/proc/{}/status", child.id());
    while child.try_wait().expect("a child").is_none() {
        let text = std::fs::read_to_string(&status).unwrap_or_default();
        let line = text.lines().find_map(|line| line.strip_prefix("VmHWM:"));
        let number = line.and_then(|line| line.trim().strip_suffix(" kB")?.trim().parse().ok());
        most = most.max(number.unwrap_or(0));
        std::thread::sleep(std::time::Duration::from_millis(2));
    }
    most
}

#[test]
#[cfg(target_os = "linux")]
fn memory_does_not_grow_with_the_film() {
    // A frame has 230 kB; all frames of the long film 69 MB.
    for film in ["f_####.png", "f_####.svg", "film.gif", "film.apng"] {
        let place = place();
        let size = "--size 320x180 --turntable -q";
        let short = most_memory(&place, &format!("{size} --length 20 -o {film}"));
        let long = most_memory(&place, &format!("{size} --length 300 -o {film}"));
        assert!(long < short + 8_000, "{film}: {short} kB, then {long} kB");
    }
}

/// A folder with a wing that beats for two seconds.
fn wing_place() -> Workplace {
    let place = Workplace::new();
    place.put("wing.glb", &npr_scene::testing::wing());
    place
}

fn words(line: &str) -> Vec<&str> {
    line.split(' ').collect()
}

#[test]
fn a_frame_of_a_clip_is_the_picture_at_its_time() {
    let view = "--size 48x32 --eye 2,3,4 --target 0.5,1,0 -q";
    let cases = [
        ("render", "png", "cpu", "--style comic-silver"),
        ("render", "png", "gpu", "--style toon"),
        ("render", "exr", "cpu", "--style toon"),
        ("lines", "svg", "cpu", "--hidden dashed"),
        ("lines", "svg", "gpu", "--kinds contour,boundary"),
        ("lines", "json", "cpu", "--style ink"),
        ("render", "png", "cpu", "--set motion.follow=9"),
        ("lines", "svg", "cpu", "--set motion.follow=9"),
    ];
    for clip in ["Beat", "Stretch"] {
        for (command, ending, backend, more) in cases {
            let place = wing_place();
            if backend == "gpu" && place.npr(&["doctor"]).code != Some(0) {
                continue;
            }
            let common = format!("{view} --backend {backend} {more} --clip {clip}");
            place
                .npr(&words(&format!(
                    "animate wing.glb {common} --fps 4 --hold off -o f_#.{ending}"
                )))
                .assert_silent_success();
            assert_eq!(place.names().len(), 9, "two seconds are eight frames");
            for number in [0_u8, 3, 7] {
                let time = f32::from(number) / 4.0;
                place
                    .npr(&words(&format!(
                        "{command} wing.glb {common} --time {time} -o still.{ending}"
                    )))
                    .assert_silent_success();
                let frame = place.get(&format!("f_{number}.{ending}"));
                assert!(
                    frame == place.get(&format!("still.{ending}")),
                    "{clip} {ending} {backend} {number}"
                );
            }
            assert!(place.get(&format!("f_1.{ending}")) != place.get(&format!("f_5.{ending}")));
        }
    }
}

#[test]
fn the_first_clip_plays_and_parts_of_it_are_the_whole() {
    for ending in ["png", "svg"] {
        let place = wing_place();
        let film = |name: &str, more: &str| {
            let line = format!(
                "animate wing.glb --size 48x32 --backend cpu -q --fps 3 -o {name}_#.{ending}{more}"
            );
            place.npr(&words(&line)).assert_silent_success();
            files(&place, &format!("{name}_"))
        };
        let whole = film("whole", "");
        assert_eq!(whole.len(), 6);
        assert!(whole == film("named", " --clip Beat") && whole != film("other", " --clip 1"));
        film("parts", " --frames 4..5");
        assert!(whole == film("parts", " --frames 0..3"));
        let turned = film("turned", " --turntable");
        assert_eq!(turned.len(), 6);
        let frame = |number: u32| &turned[&format!("{number}.{ending}")];
        assert!(frame(0) != frame(3), "it turns");
    }
}

#[test]
fn a_time_holds_the_pose_still() {
    let place = wing_place();
    let film = "animate wing.glb --size 48x32 --backend cpu -q --turntable --length 4";
    place
        .npr(&words(&format!(
            "{film} --time 1 --frames 0..4 -o held_#.png"
        )))
        .assert_silent_success();
    assert!(
        place.get("held_0.png") == place.get("held_4.png"),
        "the camera comes back, and the pose stands"
    );
    place
        .npr(&words(&format!("{film} --frames 0..4 -o played_#.png")))
        .assert_silent_success();
    assert!(place.get("played_0.png") != place.get("played_4.png"));
    place
        .npr(&["animate", "wing.glb", "--time", "1"])
        .assert_fault(2, "nothing moves");
    place
        .npr(&["animate", "wing.glb", "--clip", "Bet"])
        .assert_fault(2, "no clip 'Bet'; it has 'Beat', 'Stretch'");
}

/// The camera frames all that the clip shows, whatever part of it is drawn.
#[test]
fn the_whole_clip_is_framed() {
    let place = wing_place();
    for more in ["", "--turntable", "--lines"] {
        let line = format!(
            "animate wing.glb --clip Stretch --size 96x64 --backend cpu -q --fps 6 {more} -o f_##.png"
        );
        place
            .npr(&line.split_whitespace().collect::<Vec<_>>())
            .assert_silent_success();
        for (name, file) in files(&place, "f_") {
            let pixels = pixels(&file);
            let is_border =
                |at: &usize| at.is_multiple_of(96) || at % 96 == 95 || *at < 96 || *at >= 96 * 63;
            let border = (0..pixels.len()).filter(is_border);
            assert!(
                border.map(|at| pixels[at]).all(|pixel| pixel == pixels[0]),
                "{more} {name}"
            );
        }
    }
}

/// Lines before a background follow it from frame to frame in a sequence; in films each frame decides for itself.
#[test]
fn what_lines_remember_does_not_show_in_parts() {
    let place = place();
    let film = "animate box.obj --size 320x180 --backend cpu -q --style toon --background #777 --orbit 3 \
                --set line.background.method=contrast --set line.color=#777";
    let draw = |more: &str| {
        let line = format!("{film} {more}");
        let words: Vec<&str> = line.split_whitespace().collect();
        place.npr(&words).assert_silent_success();
    };
    draw("--frames 0..9 -o whole_#.png");
    draw("--frames 0..4 -o parts_#.png");
    draw("--frames 5..9 -o parts_#.png");
    assert!(files(&place, "whole_") == files(&place, "parts_"));
}
