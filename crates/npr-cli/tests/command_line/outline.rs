//! `npr outline`.

use crate::trace::encoded;
use crate::workplace::Workplace;
use image::{DynamicImage, ImageFormat, Rgba, RgbaImage};

const SIDE: u32 = 12;

/// A dark red square on nothing, eight pixels a side.
fn figure() -> RgbaImage {
    RgbaImage::from_fn(SIDE, SIDE, |x, y| match is_inside(x, y) {
        true => Rgba([60, 20, 20, 255]),
        false => Rgba([0; 4]),
    })
}

fn is_inside(x: u32, y: u32) -> bool {
    (2..10).contains(&x) && (2..10).contains(&y)
}

/// Whether a pixel lies outside of the square and touches it.
fn is_rim(x: u32, y: u32) -> bool {
    !is_inside(x, y) && (1..11).contains(&x) && (1..11).contains(&y)
}

/// Black on the left, white on the right.
fn wall() -> RgbaImage {
    RgbaImage::from_fn(SIDE, SIDE, |x, _| Rgba(wall_at(x)))
}

fn wall_at(x: u32) -> [u8; 4] {
    if x < SIDE / 2 {
        [0, 0, 0, 255]
    } else {
        [255; 4]
    }
}

fn png(picture: &RgbaImage) -> Vec<u8> {
    encoded(&DynamicImage::ImageRgba8(picture.clone()), ImageFormat::Png)
}

fn place() -> Workplace {
    let place = Workplace::new();
    place.put("hero.png", &png(&figure()));
    place.put("wall.png", &png(&wall()));
    place
}

fn drawn(place: &Workplace, arguments: &[&str]) -> RgbaImage {
    let outcome = place.npr(&[&["outline", "hero.png"], arguments, &["-o", "-"]].concat());
    outcome.assert_silent_success();
    image::load_from_memory(&outcome.stdout)
        .expect("a picture")
        .into_rgba8()
}

/// Asserts what every pixel is: the figure, its line by what lies behind, or the background.
#[track_caller]
fn assert_drawn(
    picture: &RgbaImage,
    behind: impl Fn(u32) -> [u8; 4],
    line: impl Fn(u32) -> [u8; 4],
) {
    for (x, y, Rgba(pixel)) in picture.enumerate_pixels() {
        let want = match (is_inside(x, y), is_rim(x, y)) {
            (true, _) => [60, 20, 20, 255],
            (_, true) => line(x),
            _ => behind(x),
        };
        assert_eq!(*pixel, want, "at {x}, {y}");
    }
}

const BLACK: [u8; 4] = [0, 0, 0, 255];

#[test]
fn a_line_changes_where_figure_and_background_are_alike() {
    let place = place();
    // 60 of 255 is within 0.25 of black, and far from white.
    let lit = |x: u32| if x < 6 { [120, 40, 40, 255] } else { BLACK };
    assert_drawn(&drawn(&place, &["wall.png"]), wall_at, lit);
    assert_drawn(
        &drawn(&place, &["black"]),
        |_| BLACK,
        |_| [120, 40, 40, 255],
    );
    assert_drawn(&drawn(&place, &["#fff"]), |_| [255; 4], |_| BLACK);
    // As a file, with a name of its own.
    place
        .npr(&["outline", "hero.png", "wall.png", "-o", "out.png"])
        .assert_silent_success();
    let file = image::load_from_memory(&place.get("out.png")).expect("a picture");
    assert_drawn(&file.into_rgba8(), wall_at, lit);
    assert_eq!(place.names(), ["hero.png", "out.png", "wall.png"]);
}

#[test]
fn every_option_does_what_it_says() {
    let place = place();
    let on_black = |more: &[&str]| {
        drawn(&place, &[&["black"], more].concat())
            .get_pixel(1, 5)
            .0
    };
    assert_eq!(on_black(&["--intensity", "3"]), [180, 60, 60, 255]);
    assert_eq!(on_black(&["--intensity", "20"]), [255, 255, 255, 255]);
    assert_eq!(on_black(&["--direction", "darker"]), [30, 10, 10, 255]);
    assert_eq!(on_black(&["--direction", "brighter"]), [120, 40, 40, 255]);
    assert_eq!(on_black(&["--rgb", "0.2"]), BLACK);
    assert_eq!(on_black(&["--value", "0.2"]), BLACK);
    // Saturation is 2/3 here and 0 there; black has no hue to differ by.
    assert_eq!(on_black(&["--saturation", "0.6"]), BLACK);
    assert_eq!(on_black(&["--saturation", "0.7"]), [120, 40, 40, 255]);
    let on_green = |more: &[&str]| {
        drawn(&place, &[&["#143c14"], more].concat())
            .get_pixel(1, 5)
            .0
    };
    assert_eq!(on_green(&["--hue-deg", "119"]), BLACK);
    assert_eq!(on_green(&["--hue-deg", "121"]), [120, 40, 40, 255]);
    let on_white = |more: &[&str]| {
        drawn(&place, &[&["white"], more].concat())
            .get_pixel(1, 5)
            .0
    };
    assert_eq!(on_white(&["--color", "teal"]), [0, 128, 128, 255]);
    assert_eq!(on_white(&["--color", "#0000"]), [255; 4]);
    // Before white, auto goes down.
    assert_eq!(on_white(&["--rgb", "1"]), [30, 10, 10, 255]);
}

#[test]
fn standard_input_is_read_for_one_of_both() {
    let place = place();
    let want = drawn(&place, &["wall.png"]);
    for (arguments, name) in [
        (["-", "wall.png"], "hero.png"),
        (["hero.png", "-"], "wall.png"),
    ] {
        let arguments = [&["outline"], &arguments[..], &["-o", "-"]].concat();
        let outcome = place.npr_fed(&arguments, &place.get(name));
        outcome.assert_silent_success();
        let picture = image::load_from_memory(&outcome.stdout).expect("a picture");
        assert_eq!(picture.into_rgba8(), want);
    }
}

#[test]
fn a_picture_without_anything_around_it_has_no_outline_and_says_so() {
    let place = place();
    let arguments = ["outline", "wall.png", "black", "-o", "out.png"];
    let outcome = place.npr(&arguments);
    assert_eq!(outcome.code, Some(0));
    assert!(
        outcome
            .stderr
            .starts_with("npr: warning: there is no outline"),
        "{}",
        outcome.stderr
    );
    place
        .npr(&[&arguments[..], &["--quiet"]].concat())
        .assert_silent_success();
}

#[test]
fn what_is_wrong_is_said_and_leaves_nothing() {
    let place = place();
    let small = RgbaImage::from_pixel(3, 4, Rgba([1, 2, 3, 255]));
    place.put("small.png", &png(&small));
    place.put("broken.png", &png(&figure())[..60]);
    place.put("text.png", b"no picture");
    let before = place.names();
    let cases: &[(&[&str], i32, &str)] = &[
        (
            &["hero.png", "small.png", "-o", "out.png"],
            3,
            "12x12 pixels and its background 3x4",
        ),
        (
            &["broken.png", "black", "-o", "out.png"],
            3,
            "cannot read 'broken.png'",
        ),
        (
            &["hero.png", "text.png", "-o", "out.png"],
            3,
            "cannot read 'text.png'",
        ),
        (
            &["none.png", "black", "-o", "out.png"],
            1,
            "cannot read 'none.png'",
        ),
        (
            &["hero.png", "blakc", "-o", "out.png"],
            1,
            "cannot read 'blakc'",
        ),
        (
            &["hero.png", "wall.png", "-o", "hero.png"],
            2,
            "also an input",
        ),
        (
            &["hero.png", "wall.png", "-o", "wall.png"],
            2,
            "also an input",
        ),
        (&["hero.png", "wall.png", "-o", "out.jpg"], 2, ".png only"),
        (&["hero.png", "wall.png"], 2, "--output"),
        (&["hero.png"], 2, "<BACKGROUND>"),
        (&["-", "-", "-o", "out.png"], 2, "only once"),
        (
            &["hero.png", "black", "-o", "out.png", "--rgb", "2"],
            2,
            "0 to 1",
        ),
        (
            &["hero.png", "black", "-o", "out.png", "--hue-deg", "-1"],
            2,
            "0 to 180",
        ),
        (
            &["hero.png", "black", "-o", "out.png", "--intensity", "0"],
            2,
            "1 to 20",
        ),
        (
            &["hero.png", "black", "-o", "out.png", "--color", "blakc"],
            2,
            "--color",
        ),
        (
            &["hero.png", "black", "-o", "no/out.png"],
            1,
            "no folder 'no'",
        ),
        (
            &[
                "hero.png",
                "black",
                "-o",
                "out.png",
                "--max-image-side",
                "11",
            ],
            5,
            "--max-image-side",
        ),
        (
            &["hero.png", "black", "-o", "out.png", "--memory-limit", "9k"],
            5,
            "--memory-limit",
        ),
    ];
    for (arguments, code, text) in cases {
        place
            .npr(&[&["outline"], *arguments].concat())
            .assert_fault(*code, text);
        assert_eq!(place.names(), before, "{arguments:?}");
    }
}

#[test]
fn scripts_and_pages_know_the_command() {
    let place = Workplace::new();
    let script = place.npr(&["completions", "bash"]);
    let page = place.npr(&["man", "outline"]);
    assert!(
        script.text().contains("npr__subcmd__outline") || script.text().contains("npr__outline")
    );
    assert!(page.text().contains("BACKGROUND") && page.text().contains("hue\\-deg"));
}
