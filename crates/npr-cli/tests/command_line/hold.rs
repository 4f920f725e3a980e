//! Films whose strokes hold from frame to frame, and parts of them.

use crate::workplace::{Outcome, Workplace};
use npr_core::math::sin_f64;
use std::collections::BTreeMap;

/// A sheet with waves, whose outlines run into each other and end in the open.
fn waves() -> String {
    let side = 24;
    let mut text = String::new();
    for row in 0..side {
        for column in 0..side {
            let [x, z] = [column, row].map(|v| f64::from(v) * 0.5);
            let height = 0.8 * sin_f64(1.3 * x) * sin_f64(1.1 * z + 1.0);
            text += &format!("v {x} {height:.4} {z}\n");
        }
    }
    for row in 0..side - 1 {
        for column in 0..side - 1 {
            let at = row * side + column + 1;
            text += &format!("f {} {} {} {}\n", at, at + side, at + side + 1, at + 1);
        }
    }
    text
}

fn place() -> Workplace {
    let place = Workplace::new();
    place.put("waves.obj", waves().as_bytes());
    place
}

/// Draws a film of the sheet on as many threads, and gives its files by what follows `name`.
#[track_caller]
fn film(place: &Workplace, name: &str, more: &str, threads: u32) -> BTreeMap<String, Vec<u8>> {
    let (ending, more) = more.split_once(' ').unwrap_or((more, ""));
    let line = format!(
        "animate waves.obj --size 160x120 -q --eye 6,4,22 --target 6,0,6 --orbit 2 --length 9 \
         -o {name}_#.{ending} {more}"
    );
    let words: Vec<&str> = line.split_whitespace().collect();
    let mut command = place.command(&words);
    command.env("RAYON_NUM_THREADS", threads.to_string());
    Outcome::of(command.output().expect("it starts")).assert_silent_success();
    let start = format!("{name}_");
    let names = place.names().into_iter();
    names
        .filter_map(|name| Some((name.strip_prefix(&start)?.to_owned(), place.get(&name))))
        .collect()
}

#[test]
fn strokes_hold_in_every_part_of_a_film() {
    let formats = [
        ("json", "--backend cpu"),
        ("json", "--backend gpu"),
        (
            "png",
            "--backend cpu --style toon --set line.brush.tip=chalk",
        ),
        (
            "png",
            "--backend gpu --style toon --set line.brush.tip=chalk",
        ),
        (
            "svg",
            "--backend cpu --svg stamps --set line.brush.tip=chalk",
        ),
    ];
    for (ending, more) in formats {
        let place = place();
        if more.contains("gpu") && place.npr(&["doctor"]).code != Some(0) {
            continue;
        }
        let drawn = |name: &str, rest: &str, threads| {
            film(&place, name, &format!("{ending} {more} {rest}"), threads)
        };
        let whole = drawn("whole", "", 3);
        assert_eq!(whole.len(), 9);
        let alone = drawn("alone", "--hold off", 1);
        let same = whole.iter().filter(|(name, file)| alone[*name] == **file);
        assert!(same.count() < 5, "{ending} {more}: it holds");

        // In parts, in any order, and once more where files are missing.
        drawn("parts", "--frames 6..8", 1);
        assert!(
            whole == drawn("parts", "--frames 0..5", 1),
            "{ending} {more}"
        );
        for name in ["parts_3", "parts_7"] {
            std::fs::remove_file(place.path(&format!("{name}.{ending}"))).expect("a frame");
        }
        assert!(
            whole == drawn("parts", "--resume", 2),
            "{ending} {more}: resumed"
        );
    }
}

#[test]
fn ids_and_textures_in_files_are_those_of_the_frame_before() {
    let place = place();
    let all = |more: &str| -> Vec<serde_json::Value> {
        let name = if more.contains("off") { "off" } else { "on" };
        let files = film(&place, name, &format!("json --backend cpu {more}"), 2);
        let read = |file: Vec<u8>| serde_json::from_slice(&file).expect("JSON");
        files.into_values().map(read).collect()
    };
    // How many of the ids of each frame are there in the next.
    let kept = |frames: &[serde_json::Value]| {
        let ids = |frame: &serde_json::Value| -> Vec<u64> {
            let strokes = frame["strokes"].as_array().expect("strokes");
            strokes
                .iter()
                .filter_map(|stroke| stroke["id"].as_u64())
                .collect()
        };
        let of_pair = |pair: &[serde_json::Value]| {
            let [before, after] = [0, 1].map(|i| ids(&pair[i]));
            assert!(!after.is_empty());
            after.iter().filter(|id| before.contains(id)).count()
        };
        frames.windows(2).map(of_pair).sum::<usize>()
    };
    let [held, alone] = ["", "--hold off"].map(all);
    assert_eq!(held[0], alone[0], "the first frame is a still");
    assert!(
        kept(&held) > kept(&alone),
        "{} {}",
        kept(&held),
        kept(&alone)
    );
    let starts = |frame: &serde_json::Value| -> Vec<f64> {
        let strokes = frame["strokes"].as_array().expect("strokes");
        strokes
            .iter()
            .filter_map(|stroke| stroke["points"][0][4].as_f64())
            .collect()
    };
    assert!(starts(&alone[8]).iter().all(|u| *u == 0.0));
    assert!(starts(&held[8]).iter().any(|u| *u != 0.0));
}
