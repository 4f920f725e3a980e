//! `npr trace`.

use crate::workplace::Workplace;

/// A ring of ink, as text.
const RING: &[u8] =
    b"P1\n8 8\n00000000\n01111110\n01111110\n01100110\n01100110\n01111110\n01111110\n00000000\n";

fn paths(svg: &[u8]) -> usize {
    String::from_utf8_lossy(svg).matches("<path").count()
}

/// An image in memory as a file of a format.
pub fn encoded(image: &image::DynamicImage, format: image::ImageFormat) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    image.write_to(&mut bytes, format).expect("a small image");
    bytes.into_inner()
}

/// The ring as pixels.
fn ring() -> image::GrayImage {
    image::GrayImage::from_fn(8, 8, |x, y| {
        let inside = |from: u32, to: u32| (from..to).contains(&x) && (from..to).contains(&y);
        image::Luma([if inside(1, 7) && !inside(3, 5) {
            0
        } else {
            255
        }])
    })
}

#[test]
fn a_tracing_is_named_after_its_bitmap() {
    let place = Workplace::new();
    place.put("ring.pbm", RING);
    place.npr(&["trace", "ring.pbm"]).assert_silent_success();
    place
        .npr(&["trace", "ring.pbm", "-o", "-"])
        .assert_silent_success();
    assert_eq!(place.names(), ["ring.pbm", "ring.svg"]);
    assert_eq!(paths(&place.get("ring.svg")), 1);
}

#[test]
fn every_format_is_written() {
    let place = Workplace::new();
    place.put("ring.pbm", RING);
    let starts = [
        ("svg", "<svg"),
        ("pdf", "%PDF-"),
        ("json", "{"),
        ("geojson", "{"),
    ];
    for (format, start) in starts {
        let name = format!("out.{format}");
        place
            .npr(&["trace", "ring.pbm", "-o", &name])
            .assert_silent_success();
        let outcome = place.npr(&["trace", "ring.pbm", "-o", "-", "--format", format]);
        outcome.assert_silent_success();
        assert_eq!(place.get(&name), outcome.stdout, "{format}");
        assert!(outcome.stdout.starts_with(start.as_bytes()), "{format}");
    }
}

#[test]
fn every_image_format_gives_the_same() {
    use image::{DynamicImage, ImageFormat};
    let place = Workplace::new();
    place.put("ring.pbm", RING);
    place.npr(&["trace", "ring.pbm"]).assert_silent_success();
    let grey = DynamicImage::ImageLuma8(ring());
    let mut files = vec![
        ("grey.png", encoded(&grey, ImageFormat::Png)),
        (
            "deep.png",
            encoded(&grey.to_luma16().into(), ImageFormat::Png),
        ),
        (
            "alpha.png",
            encoded(&grey.to_luma_alpha8().into(), ImageFormat::Png),
        ),
        (
            "colour.ppm",
            encoded(&grey.to_rgb8().into(), ImageFormat::Pnm),
        ),
        ("grey.pgm", encoded(&grey, ImageFormat::Pnm)),
        ("grey.bmp", encoded(&grey, ImageFormat::Bmp)),
        ("grey.tif", encoded(&grey, ImageFormat::Tiff)),
        (
            "colour.webp",
            encoded(&grey.to_rgb8().into(), ImageFormat::WebP),
        ),
        (
            "colour.jpg",
            encoded(&grey.to_rgb8().into(), ImageFormat::Jpeg),
        ),
    ];
    let mut packed = b"P4\n8 8\n".to_vec();
    packed.extend([0, 0x7e, 0x7e, 0x66, 0x66, 0x7e, 0x7e, 0]);
    files.push(("packed.pbm", packed));
    for (name, bytes) in files {
        place.put(name, &bytes);
        let outcome = place.npr(&["trace", name, "-o", "-"]);
        outcome.assert_silent_success();
        assert_eq!(outcome.stdout, place.get("ring.svg"), "{name}");
    }
}

#[test]
fn several_bitmaps_go_into_a_folder() {
    let place = Workplace::new();
    place.put("a.pbm", RING);
    place.put("b.pbm", b"P1 1 1 0");
    std::fs::create_dir(place.path("out")).expect("a folder");
    place
        .npr(&["trace", "a.pbm", "b.pbm", "-o", "out"])
        .assert_silent_success();
    assert_eq!(paths(&place.get("out/a.svg")), 1);
    assert_eq!(paths(&place.get("out/b.svg")), 0);
    for arguments in [
        &["trace", "a.pbm", "b.pbm", "-o", "c.svg"][..],
        &["trace", "a.pbm", "out/../a.pbm", "-o", "out"],
        &["trace", "-", "-", "-o", "-"],
        &["trace", "a.pbm", "-o", "a.png"],
        &["trace", "a.pbm", "-o", "a.pbm", "--format", "svg"],
        &["trace", "a.pbm", "--alphamax", "-1"],
        &["trace", "a.pbm", "--turnpolicy", "straight"],
        &["trace"],
    ] {
        assert_eq!(place.npr(arguments).code, Some(2), "{arguments:?}");
    }
    assert_eq!(place.names(), ["a.pbm", "b.pbm", "out"]);
}

#[test]
fn options_do_what_they_say() {
    let place = Workplace::new();
    place.put("dots.pbm", b"P1\n6 2\n100110\n000111\n");
    let count = |more: &[&str]| {
        let outcome = place.npr(&[&["trace", "dots.pbm", "-o", "-"], more].concat());
        outcome.assert_silent_success();
        paths(&outcome.stdout)
    };
    assert_eq!(count(&[]), 1);
    assert_eq!(count(&["--turdsize", "0"]), 2);
    assert_eq!(count(&["--turdsize", "5"]), 0);
    assert_eq!(count(&["--invert"]), 1);
    place.put(
        "grey.pgm",
        b"P2 3 3 255 100 100 100 100 100 100 100 100 100",
    );
    for (level, shapes) in [("0.3", 0), ("0.5", 1)] {
        let outcome = place.npr(&["trace", "grey.pgm", "-o", "-", "--blacklevel", level]);
        assert_eq!(paths(&outcome.stdout), shapes);
    }
}

#[test]
fn broken_bitmaps_are_refused_and_leave_nothing() {
    let place = Workplace::new();
    let png = encoded(
        &image::DynamicImage::ImageLuma8(ring()),
        image::ImageFormat::Png,
    );
    let mut claims = png.clone();
    claims[16..24].copy_from_slice(&[0, 0, 0xea, 0x60, 0, 0, 0xea, 0x60]);
    let cases: [(&str, &[u8], i32); 8] = [
        ("empty.png", b"", 3),
        ("text.png", b"not a picture", 3),
        ("half.png", &png[..png.len() / 2], 3),
        ("huge.png", &claims, 3),
        ("huge.pbm", b"P4\n60000 60000\n", 5),
        ("zero.pbm", b"P4\n0 0\n", 3),
        ("short.pbm", b"P4\n64 64\n1234", 3),
        ("letters.pgm", b"P2\n2 2\n255\n1 2 x 4\n", 3),
    ];
    for (name, bytes, code) in cases {
        place.put(name, bytes);
        let outcome = place.npr(&["trace", name, "-o", "out.svg"]);
        assert_eq!(outcome.code, Some(code), "{name}: {}", outcome.stderr);
        assert!(
            outcome.stderr.starts_with("npr: cannot read"),
            "{}",
            outcome.stderr
        );
        assert_eq!(outcome.stderr.lines().count(), 1, "{}", outcome.stderr);
        assert!(!place.path("out.svg").exists(), "{name}");
    }
    place.put("ring.pbm", RING);
    let outcome = place.npr(&[
        "trace",
        "ring.pbm",
        "--memory-limit",
        "100",
        "-o",
        "out.svg",
    ]);
    assert_eq!(outcome.code, Some(5), "{}", outcome.stderr);
    assert_eq!(place.npr(&["trace", "missing.png"]).code, Some(1));
}

#[test]
fn centre_lines_are_strokes() {
    let place = Workplace::new();
    // An L of two lines, one pixel wide.
    let bar =
        b"P1\n9 7\n000000000\n011111110\n010000000\n010000000\n010000000\n010000000\n000000000\n";
    place.put("bar.pbm", bar);
    for (format, wanted) in [
        ("svg", "stroke-width="),
        ("json", "\"strokes\""),
        ("geojson", "LineString"),
        ("pdf", "%PDF-"),
    ] {
        let outcome = place.npr(&[
            "trace",
            "bar.pbm",
            "--centreline",
            "-o",
            "-",
            "--format",
            format,
        ]);
        outcome.assert_silent_success();
        let text = String::from_utf8_lossy(&outcome.stdout).into_owned();
        assert!(text.contains(wanted), "{format}: {text}");
        if format == "svg" {
            assert_eq!(paths(text.as_bytes()), 1, "{text}");
        }
    }
    place
        .npr(&["trace", "bar.pbm", "--spur", "1"])
        .assert_fault(2, "entre");
    place
        .npr(&["trace", "bar.pbm", "--centreline", "-o", "bar.obj"])
        .assert_fault(2, "entre");
}

#[test]
fn filled_shapes_become_meshes_that_are_read_again() {
    let place = Workplace::new();
    place.put("ring.pbm", RING);
    for name in ["ring.obj", "ring.glb"] {
        place
            .npr(&["trace", "ring.pbm", "-o", name])
            .assert_silent_success();
        let outcome = place.npr(&["info", name, "--json"]);
        assert_eq!(outcome.code, Some(0), "{name}");
        let data: serde_json::Value = serde_json::from_slice(&outcome.stdout).expect("JSON");
        assert!(data.to_string().contains("triangle"), "{data}");
    }
}
