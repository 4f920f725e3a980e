//! Command lines that are wrong, and what is said of them.

use crate::workplace::Workplace;

#[test]
fn wrong_command_lines_exit_with_2_and_leave_nothing() {
    let cases: &[(&[&str], &str)] = &[
        (&[], "no command is given"),
        (&["rendr"], "'rendr'"),
        (&["man", "rendr"], "no command 'rendr'"),
        (&["render"], "not provided: <SCENE>"),
        (&["render", "scene.obj", "--stile", "ink"], "'--style'"),
        (&["render", "scene.obj", "--size", "0x5"], "leaves no pixel"),
        (
            &["render", "scene.obj", "--size", "big"],
            "such as 1280x720",
        ),
        (&["render", "scene.obj", "--eye", "1,2"], "three numbers"),
        (&["render", "scene.obj", "--eye", "nan,0,0"], "finite"),
        (&["render", "scene.obj", "--up", "0,0,0"], "point somewhere"),
        (&["render", "scene.obj", "--fov", "180"], "between"),
        (&["render", "scene.obj", "--fov", "NaN"], "between"),
        (
            &["render", "scene.obj", "--eye", "1,2,3", "--target", "1,2,3"],
            "same point",
        ),
        (
            &["render", "scene.obj", "--camera", "Top"],
            "no camera 'Top'; it has none",
        ),
        (
            &["render", "scene.obj", "--camera", "0", "--fov", "50"],
            "--fov",
        ),
        (&["render", "scene.obj", "--view", "above"], "front, back"),
        (
            &["render", "scene.obj", "--view", "top", "--eye", "1,2,3"],
            "--eye",
        ),
        (
            &["render", "scene.obj", "--camera", "0", "--ortho"],
            "--ortho",
        ),
        (
            &["render", "scene.obj", "--backend", "abacus"],
            "auto, cpu, gpu",
        ),
        (
            &["render", "scene.obj", "--background", "bleu"],
            "CSS colour",
        ),
        (
            &["render", "scene.obj", "--memory-limit", "much"],
            "number of bytes",
        ),
        (
            &["render", "scene.obj", "-o", "out.bmp"],
            "or as .exr with layers",
        ),
        (
            &["render", "scene.obj", "-o", "out"],
            "or as .exr with layers",
        ),
        (&["render", "-"], "-o"),
    ];
    Workplace::with_scene().assert_refused(cases);
}

#[cfg(not(feature = "view"))]
#[test]
fn a_build_without_a_window_says_how_to_get_one() {
    let place = Workplace::with_scene();
    let outcome = place.npr(&["view", "scene.obj", "--style", "ink"]);
    outcome.assert_fault(2, "--features view");
}

#[test]
fn a_side_beyond_the_limit_exits_with_5() {
    let place = Workplace::with_scene();
    let outcome = place.npr(&["render", "scene.obj", "--size", "32769x4"]);
    outcome.assert_fault(5, "32769 exceeds the limit of 32768");
}

#[test]
fn a_picture_beyond_the_memory_limit_exits_with_5_and_names_the_option() {
    let place = Workplace::with_scene();
    let outcome = place.render("scene.obj", &["--memory-limit", "5k"]);
    outcome.assert_fault(5, "--memory-limit");
    assert_eq!(place.names(), ["scene.obj"]);
}

#[test]
fn limits_that_messages_name_can_be_lifted() {
    let place = Workplace::with_scene();
    let outcome = place.render("scene.obj", &["--max-file", "10"]);
    outcome.assert_fault(
        5,
        "size of a file in bytes 11 exceeds the limit of 10, which --max-file lifts",
    );
    place
        .render("scene.obj", &["--max-file", "1k"])
        .assert_silent_success();
    let outcome = place.render("scene.obj", &["--max-triangles", "0"]);
    outcome.assert_fault(5, "--max-triangles");
}

#[test]
fn help_and_version_go_to_standard_output() {
    let place = Workplace::new();
    for arguments in [
        &["--help"][..],
        &["render", "--help"],
        &["lines", "--help"],
        &["--version"],
        &["completions", "bash"],
        &["man"],
        &["man", "lines"],
    ] {
        let outcome = place.npr(arguments);
        outcome.assert_silent_success();
        assert!(outcome.text().contains("npr"), "{arguments:?}");
    }
}

#[test]
fn a_demanded_device_draws_or_exits_with_4() {
    let place = Workplace::with_scene();
    place.assert_done_or_no_device(&["render", "scene.obj", "--size", "48x32"]);
}

#[test]
fn the_doctor_never_fails() {
    let place = Workplace::new();
    let outcome = place.npr(&["doctor", "--json"]);
    outcome.assert_silent_success();
    let report: serde_json::Value = serde_json::from_str(outcome.text()).expect("JSON");
    assert_eq!(report["version"], env!("CARGO_PKG_VERSION"));
    assert!(report["adapters"].is_array() && report["threads"].as_u64() > Some(0));
    let text = place.npr(&["doctor"]);
    assert!(text.text().contains("--backend auto draws on "));
}
