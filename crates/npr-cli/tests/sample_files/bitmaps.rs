//! Every sample bitmap is traced, to the pixel.

use crate::files::{samples, written};
use std::path::Path;
use std::time::{Duration, Instant};

/// Longest time that a run may take, on a busy machine too.
const TIME_LIMIT: Duration = Duration::from_secs(30);

/// An edge case: name and size of its picture, shapes in its drawing, shapes with specks, and its centre lines.
type EdgeCase = (&'static str, [u32; 2], usize, usize, usize);

// The large one is a ring with a cross through it: one shape, drawn by a ring and two lines.
const EDGE_CASES: [EdgeCase; 9] = [
    ("all_black_64", [64, 64], 1, 1, 1),
    ("all_white_64", [64, 64], 0, 0, 0),
    ("dashes_1x1000", [1, 1000], 0, 500, 0),
    ("frame_touching_border_65", [65, 65], 1, 1, 1),
    ("large_sparse_4096", [4096, 4096], 1, 1, 3),
    ("line_1000x1", [1000, 1], 1, 1, 1),
    ("single_pixel_black_1x1", [1, 1], 0, 1, 0),
    ("single_pixel_white_1x1", [1, 1], 0, 0, 0),
    ("stripes_odd_size_31x33", [31, 33], 11, 11, 11),
];

/// All ink: the square itself. Paths start in the middle of a side.
const SQUARE: &str = "M0 32l0 32 32 0 32 0 0-32 0-32-32 0-32 0 0 32z";

/// The same one pixel wide, with the square of its hole.
const FRAME: &str = "M0 32.5l0 32.5 32.5 0 32.5 0 0-32.5 0-32.5-32.5 0-32.5 0 0 32.5z\
    M64 32.5l0 31.5-31.5 0-31.5 0 0-31.5 0-31.5 31.5 0 31.5 0 0 31.5z";

#[test]
fn outlines_hold_as_many_pixels_as_there_is_ink() {
    for file in samples("bitmaps", &["png", "pbm"]) {
        let name = file.display();
        let text = traced(&file, &["--turdsize", "0", "--format", "json"]);
        let data: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        let mut inside = 0;
        for path in data["paths"].as_array().expect("a list") {
            let area = path["area"].as_i64().expect("a number");
            inside += if path["ink"] == true { area } else { -area };
            for segment in path["segments"].as_array().expect("a list") {
                assert!(
                    [4, 6].contains(&segment.as_array().map_or(0, Vec::len)),
                    "{name}"
                );
            }
        }
        let grey = image::open(&file).expect("a sound image").into_luma8();
        let ink = grey.pixels().filter(|pixel| pixel.0[0] <= 127).count();
        assert_eq!(inside, ink as i64, "{name}");
    }
}

#[test]
fn edge_cases_give_their_shapes() {
    let files = samples("bitmaps/edge_cases", &["png"]);
    for file in &files {
        let stem = file.file_stem().expect("a name").to_string_lossy();
        let case = EDGE_CASES.iter().find(|(name, ..)| *name == stem);
        let (name, size, shapes, specks, lines) = *case.expect("a known file");
        let runs: [(&[&str], usize); 3] = [
            (&[], shapes),
            (&["--turdsize", "0"], specks),
            (&["--centreline"], lines),
        ];
        for (options, wanted) in runs {
            let text = traced(file, options);
            assert_eq!(drawing(&text), (size, wanted), "{name} {options:?}");
        }
        let outlines = traced(file, &[]);
        match name {
            "all_black_64" => assert!(outlines.contains(SQUARE), "{outlines}"),
            "frame_touching_border_65" => assert!(outlines.contains(FRAME), "{outlines}"),
            _ => {}
        }
    }
    assert!(files.is_empty() || files.len() == EDGE_CASES.len());
}

/// What the command writes for a bitmap; a word on standard error is a fault.
fn traced(file: &Path, options: &[&str]) -> String {
    let start = Instant::now();
    let text = written(&[&["trace"], options].concat(), file);
    let name = file.display();
    assert!(start.elapsed() < TIME_LIMIT, "{name} {options:?}");
    String::from_utf8(text).expect("text")
}

/// Size and number of paths of an SVG file, which has to be well-formed.
fn drawing(text: &str) -> ([u32; 2], usize) {
    use quick_xml::events::Event;
    let mut reader = quick_xml::Reader::from_str(text);
    let (mut size, mut paths) = ([0; 2], 0);
    loop {
        match reader.read_event().expect("well-formed XML") {
            Event::Eof => return (size, paths),
            Event::Start(tag) if tag.name().as_ref() == "svg" => {
                size = ["width", "height"].map(|side| {
                    let value = tag.try_get_attribute(side).expect("sound attributes");
                    let value = value.expect("a size").value;
                    value.parse().expect("a whole number")
                });
            }
            Event::Start(tag) | Event::Empty(tag) => {
                paths += usize::from(tag.name().as_ref() == "path");
            }
            _ => {}
        }
    }
}
