//! Clips: their names, their times, and what is said of them.

use crate::workplace::{Outcome, Workplace};
use npr_scene::testing::{glb, wing};

/// A workplace with a wing that beats.
fn place() -> Workplace {
    let place = Workplace::with_scene();
    place.put("wing.glb", &wing());
    place
}

/// The drawing of `wing.glb` with options, and what was said.
fn drawn(place: &Workplace, command: &str, more: &[&str]) -> (Vec<u8>, Outcome) {
    let file = if command == "lines" { "w.svg" } else { "w.png" };
    let line = [
        command,
        "wing.glb",
        "-o",
        file,
        "--size",
        "48x32",
        "--backend",
        "cpu",
    ];
    let outcome = place.npr(&[&line, more].concat());
    assert_eq!(outcome.code, Some(0), "{more:?}: {}", outcome.stderr);
    (place.get(file), outcome)
}

#[test]
fn a_clip_is_named_or_numbered_and_its_time_is_clamped() {
    let place = place();
    for command in ["render", "lines"] {
        let picture = |more: &[&str]| {
            let (picture, outcome) = drawn(&place, command, more);
            outcome.assert_silent_success();
            picture
        };
        let beat = picture(&["--clip", "Beat"]);
        assert_eq!(picture(&["--clip", "0"]), beat);
        assert_eq!(picture(&["--clip", "0", "--time", "-7"]), beat);
        assert_eq!(picture(&["--time", "0"]), beat);
        assert_ne!(picture(&["--clip", "Beat", "--time", "1"]), beat);

        // After its last key the wing rests, as without any clip.
        let (rest, outcome) = drawn(&place, command, &[]);
        assert!(
            outcome.stderr.contains("it has 2 clips"),
            "{}",
            outcome.stderr
        );
        assert_eq!(picture(&["--time", "99"]), rest);
        assert_eq!(picture(&["--quiet"]), rest);
        assert_ne!(picture(&["--clip", "Stretch", "--time", "99"]), rest);
    }
}

#[test]
fn speed_lines_follow_what_a_clip_moves() {
    let place = place();
    for command in ["render", "lines"] {
        let picture = |time: &str, more: &[&str]| {
            let (picture, outcome) = drawn(&place, command, &[&["--time", time], more].concat());
            outcome.assert_silent_success();
            picture
        };
        let follow = ["--set", "motion.follow=8"];
        let slow = ["--set", "motion.follow=8", "--set", "motion.shutter=0.1"];
        let plain = picture("1.5", &[]);
        assert_ne!(picture("1.5", &follow), plain);
        assert_ne!(picture("1.5", &follow), picture("1.5", &slow));
        // Before its first key a clip stands still, and long after its last one.
        for time in ["-7", "0", "99"] {
            assert_eq!(picture(time, &follow), picture(time, &[]), "{time}");
        }
        let told = drawn(
            &place,
            command,
            &["--set", "motion.least=4px", "--time", "1"],
        );
        assert!(
            told.1.stderr.contains("motion.follow is 0"),
            "{}",
            told.1.stderr
        );
    }
    let line = "lines wing.glb --time 1.5 --set motion.follow=8 --backend cpu -o w.json";
    place
        .npr(&line.split(' ').collect::<Vec<_>>())
        .assert_silent_success();
    let json = String::from_utf8(place.get("w.json")).expect("text");
    assert!(json.contains("\"speed lines\"") && json.contains("\"wing\""));
}

#[test]
fn clips_and_times_that_there_are_none_of_are_refused() {
    let place = place();
    let refused = |arguments: &[&str], text: &str| place.npr(arguments).assert_fault(2, text);
    for command in ["render", "lines"] {
        let told = "the scene has no clip 'beet'; it has 'Beat', 'Stretch'";
        refused(&[command, "wing.glb", "--clip", "beet"], told);
        refused(&[command, "wing.glb", "--clip", "2"], "no clip '2'");
        let none = "the scene has no clip 'Beat'; it has none";
        refused(&[command, "scene.obj", "--clip", "Beat"], none);
        for time in ["nan", "inf", "-inf", "1e50", "now"] {
            refused(
                &[command, "wing.glb", "--time", time],
                "must be a number of seconds",
            );
        }
    }
    refused(&["smoke", "puff", "--clip", "Beat"], "it has none");
    let mut names = place.names();
    names.retain(|name| name != "wing.glb");
    assert_eq!(names, ["scene.obj"]);
}

#[test]
fn clips_are_listed() {
    let place = place();
    let outcome = place.npr(&["info", "wing.glb", "--json"]);
    outcome.assert_silent_success();
    let info: serde_json::Value = serde_json::from_str(outcome.text()).expect("JSON");
    let beat = serde_json::json!({"name": "Beat", "duration_s": 2.0, "channel_count": 1});
    assert_eq!(
        (&info["clips"][0], info["clips"].as_array().map(Vec::len)),
        (&beat, Some(2))
    );
    assert_eq!(info["ignored"], serde_json::json!([]));
    let text = place.npr(&["info", "wing.glb"]);
    assert!(
        text.text()
            .contains("  clip 1 'Stretch' 2.00 s, 1 channels\n"),
        "{}",
        text.text()
    );
}

#[test]
fn a_broken_clip_is_told_of_and_the_rest_pose_drawn() {
    let place = place();
    let (rest, _) = drawn(&place, "render", &[]);
    let file = wing();
    let text = String::from_utf8_lossy(&file[20..]).into_owned();
    let end = text.rfind('}').expect("JSON");
    let broken = text[..=end].replace("\"path\":\"rotation\"", "\"path\":\"colour\"");
    place.put("wing.glb", &glb(&broken, &file[file.len() - 148..]));
    let (picture, outcome) = drawn(&place, "render", &["--clip", "Beat", "--time", "1"]);
    let told =
        "npr: warning: animation 0 is broken: channel 0 moves something that glTF does not know";
    assert_eq!(outcome.stderr.trim_end(), told);
    assert_eq!(picture, rest);
}
