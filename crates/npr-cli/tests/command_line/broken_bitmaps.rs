//! `npr trace` on broken pictures, made from a small sound one.

use crate::trace::encoded;
use crate::workplace::Workplace;
use image::{DynamicImage, ImageFormat};
use std::time::{Duration, Instant};

/// Longest time that a run may take, on a busy machine too.
const TIME_LIMIT: Duration = Duration::from_secs(10);

/// How many cuts and how many flipped bytes are tried of a file. Short files have each of theirs tried.
const CUTS: usize = 16;
const FLIPS: usize = 48;

#[test]
fn cut_off_pictures_are_read_or_refused() {
    let place = Workplace::new();
    for (name, bytes) in sound_files() {
        for length in spread(bytes.len(), CUTS) {
            place.put(name, &bytes[..length]);
            check(&place, name, &format!("{name} cut to {length} bytes"));
        }
    }
}

#[test]
fn pictures_with_flipped_bits_are_read_or_refused() {
    let place = Workplace::new();
    for (name, bytes) in sound_files() {
        for at in spread(bytes.len(), FLIPS) {
            // Headers have sizes and kinds in single bits: another one at each place.
            let mut broken = bytes.clone();
            broken[at] ^= 1 << (at % 8);
            place.put(name, &broken);
            check(&place, name, &format!("{name} with a flip at byte {at}"));
        }
    }
}

#[test]
fn sound_files_are_sound() {
    let place = Workplace::new();
    for (name, bytes) in sound_files() {
        place.put(name, &bytes);
        let outcome = place.npr(&["trace", name, "-o", "-", "--format", "json"]);
        outcome.assert_silent_success();
        assert!(outcome.text().contains("\"area\":36,"), "{name}");
    }
}

#[test]
fn enormous_claims_are_refused_at_once() {
    let place = Workplace::new();
    for (name, bytes) in enormous_files() {
        place.put(name, &bytes);
        let start = Instant::now();
        let outcome = place.npr(&["trace", name, "-o", "out.svg"]);
        assert!(start.elapsed() < TIME_LIMIT, "{name}");
        outcome.assert_fault(5, &format!("cannot read '{name}': "));
        assert!(
            outcome.stderr.contains("--max-image"),
            "{name}: {}",
            outcome.stderr
        );
        assert!(!place.path("out.svg").exists(), "{name}");
        // With those limits lifted, the memory that would be planned is the next one.
        let lifted = ["--max-image-side", "70000", "--max-image", "100G"];
        let outcome = place.npr(&[&["trace", name, "-o", "out.svg"], &lifted[..]].concat());
        assert!(
            matches!(outcome.code, Some(3 | 5)),
            "{name}: {:?}",
            outcome.code
        );
        outcome.assert_fault(outcome.code.unwrap_or(0), "cannot read");
        assert!(!place.path("out.svg").exists(), "{name}");
    }
}

/// A picture on which its decoder panics.
const SHORT_PALETTE: &[u8] = include_bytes!("../data/palette_of_5_bytes.png");

#[test]
fn a_decoder_that_panics_makes_a_broken_picture() {
    let place = Workplace::with_scene();
    place.put("p.png", SHORT_PALETTE);
    let reported = "npr: cannot read 'p.png': the PNG data are broken\n";
    let refused: [&[&str]; 4] = [
        &["trace", "p.png", "-o", "out.svg"],
        &["trace", "p.png", "-o", "out.svg", "--colours", "3"],
        &[
            "render",
            "scene.obj",
            "-o",
            "out.png",
            "--background",
            "p.png",
        ],
        &[
            "render",
            "scene.obj",
            "-o",
            "out.png",
            "--set",
            "shade.ramp_image=\"p.png\"",
        ],
    ];
    for arguments in refused {
        let outcome = place.npr(arguments);
        outcome.assert_fault(3, "cannot read 'p.png'");
        assert!(
            outcome.stderr.ends_with(&reported["npr: ".len()..]),
            "{}",
            outcome.stderr
        );
    }
    assert_eq!(place.names(), ["p.png", "scene.obj"]);
}

#[test]
fn a_texture_that_stops_its_decoder_is_left_out_by_name() {
    let place = Workplace::new();
    let positions = [0f32, 0., 0., 1., 0., 0., 0., 1., 0.];
    let mut bin: Vec<u8> = positions.into_iter().flat_map(f32::to_le_bytes).collect();
    bin.extend(SHORT_PALETTE);
    let (all, picture) = (bin.len(), SHORT_PALETTE.len());
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"nodes":[{{"mesh":0}}],"scenes":[{{"nodes":[0]}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"material":0}}]}}],
        "materials":[{{"pbrMetallicRoughness":{{"baseColorTexture":{{"index":0}}}}}}],"textures":[{{"source":0}}],
        "images":[{{"name":"skin","bufferView":1,"mimeType":"image/png"}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}}],
        "bufferViews":[{{"buffer":0,"byteLength":36}},{{"buffer":0,"byteOffset":36,"byteLength":{picture}}}],
        "buffers":[{{"byteLength":{all}}}]}}"#
    );
    place.put("scene.glb", &npr_scene::testing::glb(&json, &bin));
    let outcome = place.render("scene.glb", &["-o", "out.png"]);
    let reported = "npr: warning: image 0 is left out: 'skin' is no sound PNG or JPEG\n";
    assert_eq!((outcome.code, outcome.stderr.as_str()), (Some(0), reported));
}

/// Traces a broken file: a drawing and no word, or no drawing and one line with the right exit code.
#[track_caller]
fn check(place: &Workplace, name: &str, what: &str) {
    let start = Instant::now();
    let outcome = place.npr(&["trace", name, "-o", "out.svg"]);
    assert!(start.elapsed() < TIME_LIMIT, "{what}");
    let out = place.path("out.svg");
    if outcome.code == Some(0) {
        outcome.assert_silent_success();
        assert!(place.get("out.svg").ends_with(b"</svg>\n"), "{what}");
        std::fs::remove_file(out).expect("the test's own drawing");
    } else {
        let code = outcome.code.filter(|code| [3, 5].contains(code));
        let code = code.unwrap_or_else(|| panic!("{what}: {:?} {}", outcome.code, outcome.stderr));
        outcome.assert_fault(code, &format!("cannot read '{name}': "));
        assert!(
            !outcome.stderr.contains(['{', '[']),
            "{what}: {}",
            outcome.stderr
        );
    }
    std::fs::remove_file(place.path(name)).expect("the test's own picture");
    assert!(place.names().is_empty(), "{what}: {:?}", place.names());
}

/// At most `count` of the numbers below `length`, evenly, the first ones all: there the headers are.
fn spread(length: usize, count: usize) -> Vec<usize> {
    let head = length.min(count / 2);
    let rest = count - head;
    let step = (length - head).div_ceil(rest).max(1);
    (0..head).chain((head..length).step_by(step)).collect()
}

/// A square of six pixels a side, in the middle of eight, in every format that is read.
fn sound_files() -> Vec<(&'static str, Vec<u8>)> {
    let square = DynamicImage::ImageLuma8(image::GrayImage::from_fn(8, 8, |x, y| {
        let is_ink = (1..7).contains(&x) && (1..7).contains(&y);
        image::Luma([if is_ink { 0 } else { 255 }])
    }));
    let color = DynamicImage::ImageRgb8(square.to_rgb8());
    let text = |head: &str, values: [&str; 2]| {
        let rows = square.to_luma8();
        let pixels = rows
            .pixels()
            .map(|pixel| values[usize::from(pixel.0[0] == 0)]);
        format!("{head}{}\n", pixels.collect::<Vec<_>>().join(" ")).into_bytes()
    };
    vec![
        ("grey.png", encoded(&square, ImageFormat::Png)),
        ("colour.png", encoded(&color, ImageFormat::Png)),
        ("grey.jpg", encoded(&square, ImageFormat::Jpeg)),
        ("colour.jpg", encoded(&color, ImageFormat::Jpeg)),
        ("colour.webp", encoded(&color, ImageFormat::WebP)),
        ("grey.tif", encoded(&square, ImageFormat::Tiff)),
        ("colour.tif", encoded(&color, ImageFormat::Tiff)),
        ("colour.bmp", encoded(&color, ImageFormat::Bmp)),
        (
            "packed.pbm",
            [b"P4\n8 8\n", &[0, 126, 126, 126, 126, 126, 126, 0][..]].concat(),
        ),
        ("grey.pgm", encoded(&square, ImageFormat::Pnm)),
        ("colour.ppm", encoded(&color, ImageFormat::Pnm)),
        ("text.pbm", text("P1\n8 8\n", ["0", "1"])),
        ("text.pgm", text("P2\n8 8\n9\n", ["9", "0"])),
        ("text.ppm", text("P3\n8 8\n9\n", ["9 9 9", "0 0 0"])),
    ]
}

/// Files of a few bytes whose headers are sound and claim sides of 60000 pixels.
fn enormous_files() -> Vec<(&'static str, Vec<u8>)> {
    let mut png = Vec::new();
    let mut writer = png::Encoder::new(&mut png, 60_000, 60_000)
        .write_header()
        .expect("a header");
    // Pixels begin, and that is all.
    writer
        .write_chunk(png::chunk::IDAT, &[0x78, 0x9c])
        .expect("a chunk");
    drop(writer);
    let sound = |name: &str| {
        let mut files = sound_files().into_iter();
        files
            .find(|(other, _)| *other == name)
            .expect("a file of that name")
            .1
    };
    let mut bmp = sound("colour.bmp");
    for side in [18, 22] {
        bmp[side..side + 4].copy_from_slice(&60_000u32.to_le_bytes());
    }
    // The sides of a JPEG follow the marker of its frame.
    let mut jpeg = sound("grey.jpg");
    let frame = jpeg
        .windows(2)
        .position(|pair| pair == [0xff, 0xc0])
        .expect("a frame");
    for side in [frame + 5, frame + 7] {
        jpeg[side..side + 2].copy_from_slice(&60_000u16.to_be_bytes());
    }
    vec![
        ("huge.png", png),
        ("huge.bmp", bmp),
        ("huge.jpg", jpeg),
        ("huge.tif", enormous_tiff()),
        ("huge.pbm", b"P4\n60000 60000\n1234".to_vec()),
        ("huge.pgm", b"P5\n60000 60000\n255\n1234".to_vec()),
        ("huge.ppm", b"P6\n60000 60000\n255\n1234".to_vec()),
        ("text.pgm", b"P2\n60000 60000\n255\n1 2 3 4".to_vec()),
    ]
}

/// A TIFF of grey pixels in one strip: a header, and a table of tags that are single numbers.
fn enormous_tiff() -> Vec<u8> {
    const SIDE: u32 = 60_000;
    // Width, height, bits, no compression, black is 0, start and rows of the strip, its length.
    let tags: [(u16, u32); 8] = [
        (256, SIDE),
        (257, SIDE),
        (258, 8),
        (259, 1),
        (262, 1),
        (273, 8),
        (278, SIDE),
        (279, SIDE * SIDE),
    ];
    let mut file = b"II*\0\x08\0\0\0".to_vec();
    file.extend((tags.len() as u16).to_le_bytes());
    for (tag, value) in tags {
        file.extend(tag.to_le_bytes());
        // One whole number of four bytes.
        file.extend([4, 0, 1, 0, 0, 0]);
        file.extend(value.to_le_bytes());
    }
    file.extend([0; 4]);
    file
}
