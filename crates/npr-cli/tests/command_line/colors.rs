//! `npr trace --colours`.

use crate::trace::encoded;
use crate::workplace::Workplace;
use image::{ImageFormat, Rgba, RgbaImage};

/// A flag of three stripes with a dark disc in it, on nothing.
fn flag(x: u32, y: u32) -> Rgba<u8> {
    let (dx, dy) = (x as i32 - 24, y as i32 - 18);
    match x {
        _ if !(4..44).contains(&x) || !(4..32).contains(&y) => Rgba([9, 9, 9, 100]),
        _ if dx * dx + dy * dy < 64 => Rgba([20, 30, 90, 255]),
        0..12 => Rgba([200, 40, 30, 255]),
        12..36 => Rgba([250, 245, 230, 255]),
        _ => Rgba([10, 120, 60, 255]),
    }
}

fn put_png(place: &Workplace, name: &str, picture: &RgbaImage) {
    place.put(name, &encoded(&picture.clone().into(), ImageFormat::Png));
}

/// What `npr trace FILE` writes to standard output.
fn traced(place: &Workplace, file: &str, more: &[&str]) -> Vec<u8> {
    let outcome = place.npr(&[&["trace", file, "-o", "-"], more].concat());
    outcome.assert_silent_success();
    outcome.stdout
}

/// Values of an attribute or key in a text, in order.
fn values(text: &[u8], before: &str) -> Vec<String> {
    let text = String::from_utf8_lossy(text);
    let parts = text.split(before).skip(1);
    parts.map(|part| part[..7].to_owned()).collect()
}

#[test]
fn a_flat_picture_keeps_its_colors() {
    let place = Workplace::new();
    put_png(&place, "flag.png", &RgbaImage::from_fn(48, 36, flag));
    let own = ["#0a783c", "#141e5a", "#c8281e", "#faf5e6"];
    for (format, key) in [("svg", "<g fill=\""), ("json", "\"fill\":\"")] {
        let mut fills = values(
            &traced(&place, "flag.png", &["--colours", "9", "--format", format]),
            key,
        );
        fills.sort();
        assert_eq!(fills, own, "{format}");
    }
    let svg = traced(&place, "flag.png", &["--colours", "4"]);
    assert_eq!(svg, traced(&place, "flag.png", &["--colors", "4"]));
    // The lowest layer is all that is painted, the uppermost the disc alone.
    let json = traced(&place, "flag.png", &["--colours", "4", "--format", "json"]);
    let data: serde_json::Value = serde_json::from_slice(&json).expect("JSON");
    let layers = data["layers"].as_array().expect("a list");
    let areas: Vec<_> = layers
        .iter()
        .map(|layer| &layer["paths"][0]["area"])
        .collect();
    assert_eq!(areas[0], 40 * 28);
    let disc = (0..48 * 36).filter(|i| flag(i % 48, i / 48).0[2] == 90);
    let under = layers.iter().find(|layer| layer["fill"] == "#141e5a");
    assert_eq!(under.expect("a layer")["paths"][0]["area"], disc.count());
    let geojson = traced(
        &place,
        "flag.png",
        &["--colours", "4", "--format", "geojson"],
    );
    let data: serde_json::Value = serde_json::from_slice(&geojson).expect("JSON");
    assert!(data["features"][0]["properties"]["fill"].is_string());
    assert!(
        traced(&place, "flag.png", &["--colours", "4", "--format", "pdf"]).starts_with(b"%PDF-")
    );
}

#[test]
fn more_colors_are_reduced() {
    let place = Workplace::new();
    let picture = RgbaImage::from_fn(64, 64, |x, y| {
        Rgba([(x * 4) as u8, (y * 4) as u8, ((x ^ y) * 3) as u8, 255])
    });
    put_png(&place, "ramp.png", &picture);
    for (count, threads) in [("2", "1"), ("7", "1"), ("7", "3"), ("256", "2")] {
        let mut command = place.command(&["trace", "ramp.png", "-o", "-", "--colours", count]);
        let output = command.env("RAYON_NUM_THREADS", threads).output();
        let svg = output.expect("the command starts").stdout;
        let mut fills = values(&svg, "<g fill=\"");
        let layers = fills.len();
        assert_eq!(layers.to_string(), count);
        fills.sort();
        fills.dedup();
        assert_eq!(fills.len(), layers);
        assert_eq!(svg, traced(&place, "ramp.png", &["--colours", count]));
    }
}

#[test]
fn nothing_opaque_gives_no_layer() {
    let place = Workplace::new();
    put_png(
        &place,
        "none.png",
        &RgbaImage::from_pixel(5, 5, Rgba([9, 9, 9, 0])),
    );
    let svg = traced(&place, "none.png", &["--colours", "3"]);
    assert!(values(&svg, "<g ").is_empty());
}

#[test]
fn what_does_not_go_with_colors_is_refused() {
    let place = Workplace::new();
    put_png(&place, "flag.png", &RgbaImage::from_fn(48, 36, flag));
    for more in [
        &["--colours", "1"][..],
        &["--colours", "257"],
        &["--colours", "many"],
        &["--colours", "4", "--centreline"],
        &["--colours", "4", "--invert"],
        &["--colours", "4", "--blacklevel", "0.4"],
        &["--colours", "4", "-o", "flag.obj"],
        &["--colours", "4", "-o", "flag.glb"],
    ] {
        let outcome = place.npr(&[&["trace", "flag.png"], more].concat());
        assert_eq!(outcome.code, Some(2), "{more:?}");
    }
    assert_eq!(place.names(), ["flag.png"]);
    // Colours take more memory than ink.
    for (more, code) in [(&[][..], 0), (&["--colours", "4"], 5)] {
        let limited = ["trace", "flag.png", "-o", "-", "--memory-limit", "30000"];
        let outcome = place.npr(&[&limited, more].concat());
        assert_eq!(outcome.code, Some(code), "{more:?}: {}", outcome.stderr);
    }
}
