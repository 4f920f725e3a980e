//! Styles: presets, files, overrides, backgrounds.

use crate::files::tiny_png;
use crate::workplace::Workplace;

#[test]
fn presets_are_listed_and_shown() {
    let place = Workplace::new();
    let list = place.npr(&["styles", "list"]);
    list.assert_silent_success();
    for line in list.text().lines() {
        let name = line.split_whitespace().next().expect("a name");
        let text = place.npr(&["styles", "show", name]);
        text.assert_silent_success();
        place.put("copy.toml", &text.stdout);
        place
            .npr(&["styles", "check", "copy.toml"])
            .assert_silent_success();
    }
    place
        .npr(&["styles", "show", "tonn"])
        .assert_fault(2, "did you mean 'toon'?");
    place
        .npr(&["styles", "show", "ink@99"])
        .assert_fault(2, "no version 99");
}

#[test]
fn a_checked_style_names_line_column_and_nearest_key() {
    let place = Workplace::new();
    let cases = [
        (
            "line.widht.gain = 2",
            "line 1, column 6; did you mean 'line.width'?",
        ),
        (
            "title = \"x\"\n[shade]\nsoftness = 7",
            "shade.softness at line 3, column 1 is 7, but must lie in 0..0.5",
        ),
        ("[line\n", "not TOML at line 1"),
        (
            "extends = \"other.toml\"",
            "cannot read parent style 'other.toml'",
        ),
        ("extends = \"../other.toml\"", "outside"),
    ];
    for (text, message) in cases {
        place.put("my.toml", text.as_bytes());
        let outcome = place.npr(&["styles", "check", "my.toml"]);
        outcome.assert_fault(2, message);
        assert!(
            outcome.stderr.starts_with("npr: style 'my.toml': "),
            "{}",
            outcome.stderr
        );
    }
    place.put("my.toml", b"\xff\xfe");
    place
        .npr(&["styles", "check", "my.toml"])
        .assert_fault(2, "not UTF-8");
    place
        .npr(&["styles", "check", "missing.toml"])
        .assert_fault(1, "cannot read 'missing.toml'");
}

#[test]
fn the_schema_is_json() {
    let outcome = Workplace::new().npr(&["styles", "schema"]);
    outcome.assert_silent_success();
    let schema: serde_json::Value = serde_json::from_str(outcome.text()).expect("JSON");
    assert!(schema["properties"]["line"].is_object());
}

#[test]
fn a_wrong_override_exits_with_2() {
    let place = Workplace::with_scene();
    place
        .render("scene.obj", &["--set", "line.colour=red"])
        .assert_fault(2, "did you mean 'line.color'?");
    place
        .render("scene.obj", &["--set", "line.color"])
        .assert_fault(2, "key.path=value");
    place
        .render("scene.obj", &["--set", "line.opacity=7"])
        .assert_fault(2, "0..1");
    place
        .render("scene.obj", &["--style", "inkk"])
        .assert_fault(2, "did you mean 'ink'?");
    place
        .render("scene.obj", &["--style", "comc"])
        .assert_fault(2, "did you mean 'comic-silver'?");
    place
        .render("scene.obj", &["--set", "rule.0.x="])
        .assert_fault(2, "write rule=[{ match = ");
    place
        .render("scene.obj", &["--style", "missing.toml"])
        .assert_fault(1, "missing.toml");
    assert_eq!(place.names(), ["scene.obj"]);
}

#[test]
fn the_dumped_style_draws_the_same_picture() {
    let place = Workplace::with_scene();
    let look = [
        "--style",
        "ink",
        "--set",
        "line.color=navy",
        "--background",
        "#ffe0c0",
    ];
    let dump = place.npr(&[&["render", "--dump-style"][..], &look].concat());
    dump.assert_silent_success();
    place.put("dumped.toml", &dump.stdout);
    place
        .render("scene.obj", &[&["-o", "direct.png"][..], &look].concat())
        .assert_silent_success();
    let outcome = place.render("scene.obj", &["-o", "dumped.png", "--style", "dumped.toml"]);
    outcome.assert_silent_success();
    assert_eq!(place.get("direct.png"), place.get("dumped.png"));
}

#[test]
fn the_background_is_a_color_or_nothing_or_an_image() {
    let place = Workplace::with_scene();
    place.put("sky.png", &tiny_png());
    let corner = |background: &str| {
        place
            .render("scene.obj", &["-o", "out.png", "--background", background])
            .assert_silent_success();
        first_pixel(&place.get("out.png"))
    };
    assert_eq!(corner("#204060"), [0x20, 0x40, 0x60]);
    assert_eq!(corner("transparent"), [0, 0, 0, 0]);
    assert_eq!(corner("sky.png"), [90, 90, 90]);
}

#[test]
fn pictures_that_a_style_file_names_lie_beside_it() {
    let place = Workplace::with_scene();
    std::fs::create_dir(place.path("looks")).expect("a folder");
    place.put("looks/sky.png", &tiny_png());
    place.put("looks/sky.toml", b"background = \"sky.png\"");
    place
        .render("scene.obj", &["--style", "looks/sky.toml"])
        .assert_silent_success();
    assert_eq!(first_pixel(&place.get("scene.png")), [90, 90, 90]);

    place.put("looks/up.toml", b"background = \"../out.png\"");
    place
        .render("scene.obj", &["--style", "looks/up.toml"])
        .assert_fault(2, "outside");
    place.put("looks/gone.toml", b"background = \"gone.png\"");
    place
        .render("scene.obj", &["--style", "looks/gone.toml"])
        .assert_fault(1, "gone.png");
    place.put("looks/text.png", b"not a picture");
    place.put("looks/text.toml", b"background = \"text.png\"");
    place
        .render("scene.obj", &["--style", "looks/text.toml"])
        .assert_fault(3, "text.png");
}

#[test]
fn pictures_for_tones_are_found_and_their_faults_named() {
    let place = Workplace::with_scene();
    place.put("tone.png", &tiny_png());
    for setting in ["shade.ramp_image=tone.png", "ink.hatch.image=tone.png"] {
        let all = ["--set", "ink.tone=hatch", "--set", setting];
        place.render("scene.obj", &all).assert_silent_success();
    }
    place.put("text.png", b"not a picture");
    for (key, file, exit) in [
        ("shade.ramp_image", "gone.png", 1),
        ("ink.hatch.image", "gone.png", 1),
        ("shade.ramp_image", "text.png", 3),
    ] {
        let setting = format!("{key}={file}");
        let outcome = place.render("scene.obj", &["--set", &setting]);
        outcome.assert_fault(exit, &format!("{key}: cannot read '{file}'"));
    }
    let mut upright = Vec::new();
    let mut encoder = png::Encoder::new(&mut upright, 1, 2);
    encoder.set_color(png::ColorType::Rgb);
    let mut writer = encoder.write_header().expect("a header");
    writer.write_image_data(&[90; 6]).expect("two pixels");
    drop(writer);
    place.put("upright.png", &upright);
    place
        .render("scene.obj", &["--set", "shade.ramp_image=upright.png"])
        .assert_fault(3, "shade.ramp_image: a ramp runs from left to right");
}

#[test]
fn thin_lines_over_a_coarse_mask_are_warned_of_once() {
    let place = Workplace::with_scene();
    let coarse = ["--style", "toon@1", "--set", "detect.scale=8"];
    let outcome = place.render("scene.obj", &coarse);
    assert_eq!(outcome.code, Some(0));
    assert!(
        outcome.stderr.starts_with("npr: warning: lines "),
        "{}",
        outcome.stderr
    );
    assert_eq!(outcome.stderr.lines().count(), 1);
    place
        .render("scene.obj", &[&coarse[..], &["--quiet"]].concat())
        .assert_silent_success();
}

/// The first pixel of a PNG file: three or four bytes.
fn first_pixel(file: &[u8]) -> Vec<u8> {
    let mut reader = png::Decoder::new(std::io::Cursor::new(file))
        .read_info()
        .expect("a header");
    let count = reader.info().color_type.samples();
    let row = reader.next_row().expect("pixels").expect("a row");
    row.data()[..count].to_vec()
}
