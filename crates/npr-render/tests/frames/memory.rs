//! What the lines of a frame take on a device.

use super::tiles::asked_for;
use npr_gpu::graph::Kind;
use npr_stylesheet::{LineVisibility, OutlineMethod, Style};
use npr_vector::sampled::SpineSample;

const SIZE: [u32; 2] = [1920, 1080];

/// What a frame asks for.
#[derive(Debug, Clone, Copy)]
struct Asked {
    /// Bytes of all pictures, and of all lists.
    bytes: [u64; 2],
    /// Number of samples of lines that there is room for.
    samples: u64,
}

/// What a frame of `toon` asks for, with lines whose sights passes find or without lines.
fn asked(size: [u32; 2], side: u32, has_lines: bool) -> Asked {
    let mut style = Style::preset("toon").unwrap();
    style.line.visibility = LineVisibility::Sampled;
    if !has_lines {
        style.line.method = OutlineMethod::Off;
    }
    let mut asked = Asked {
        bytes: [0; 2],
        samples: 0,
    };
    for resource in asked_for(&style, size, side) {
        let bytes = 4 * resource.word_count();
        let is_list = !matches!(resource.kind, Kind::Image { .. });
        asked.bytes[usize::from(is_list)] += bytes as u64;
        if resource.name == "samples of lines" {
            asked.samples = (bytes / size_of::<SpineSample>()) as u64;
        }
    }
    asked
}

/// What the lines of a frame add: bytes of pictures and of lists, and the samples that there is room for.
fn lines_add(size: [u32; 2], side: u32) -> [u64; 3] {
    let (with, without) = (asked(size, side, true), asked(size, side, false));
    let [pictures, lists] = [0, 1].map(|kind| with.bytes[kind] - without.bytes[kind]);
    [pictures, lists, with.samples]
}

/// Lines take at most 16 MB of pictures at 1920x1080, 200 bytes for each sample, of which a pixel of stroke has one at
/// most, and 60 bytes a triangle.
#[test]
fn lines_take_little_memory() {
    let [pictures, lists, samples] = lines_add(SIZE, 3);
    assert!(pictures <= 16 << 20, "{pictures} bytes");
    assert!(samples > 100_000, "{samples} samples");
    let each = lists as f64 / samples as f64;
    assert!((50.0..=200.0).contains(&each), "{each} bytes a sample");

    // More triangles alone take hardly more.
    let [_, of_many, _] = lines_add(SIZE, 300);
    let triangles = 2 * (300 * 300 - 3 * 3);
    let each = (of_many - lists) as f64 / f64::from(triangles);
    assert!(each <= 60.0, "{each} bytes a triangle");
}
