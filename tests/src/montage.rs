//! Pictures put together for people to compare.

use npr_render::Frame;

/// White pixels between pictures.
const GAP: u32 = 6;

/// Pictures of one size in rows of `columns`, on white.
///
/// # Panics
///
/// Without pictures, or where a size differs.
pub fn beside(frames: &[Frame], columns: u32) -> Frame {
    let cell = frames.first().expect("at least one picture").size;
    let rows = (frames.len() as u32).div_ceil(columns);
    let side = |count: u32, cell: u32| count * (cell + GAP) - GAP;
    let size = [side(columns, cell[0]), side(rows, cell[1])];
    let mut sheet = Frame {
        size,
        rgba: vec![255; (size[0] * size[1] * 4) as usize],
        ..Frame::default()
    };
    for (frame, i) in frames.iter().zip(0..) {
        assert_eq!(frame.size, cell, "pictures of one size");
        let place = [i % columns * (cell[0] + GAP), i / columns * (cell[1] + GAP)];
        copy(frame, &mut sheet, place);
    }
    sheet
}

/// The part of a picture `size` pixels wide and high whose top left pixel is `origin`.
pub fn cropped(frame: &Frame, origin: [u32; 2], size: [u32; 2]) -> Frame {
    sampled(frame, size, |at| [origin[0] + at[0], origin[1] + at[1]])
}

/// A picture whose pixels are squares of `factor` pixels.
pub fn enlarged(frame: &Frame, factor: u32) -> Frame {
    let size = frame.size.map(|side| side * factor);
    sampled(frame, size, |at| at.map(|v| v / factor))
}

/// A picture whose pixels are means of squares of `factor` pixels, alpha left out; what is over at the edges is
/// dropped.
pub fn reduced(frame: &Frame, factor: u32) -> Frame {
    let size = frame.size.map(|side| side / factor);
    let pixels = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| [x, y]));
    let bytes = pixels.flat_map(|at| mean_of(&cropped(frame, at.map(|v| v * factor), [factor; 2])));
    Frame {
        size,
        rgba: bytes.collect(),
        ..Frame::default()
    }
}

/// The mean colour of a picture, opaque.
fn mean_of(frame: &Frame) -> [u8; 4] {
    let count = frame.rgba.len() as u32 / 4;
    let sum = |channel: usize| {
        let values = frame.rgba.iter().skip(channel).step_by(4);
        values.map(|value| u32::from(*value)).sum::<u32>()
    };
    let mean = |channel| ((sum(channel) + count / 2) / count) as u8;
    [mean(0), mean(1), mean(2), 255]
}

/// A picture of `size` that takes each pixel from where `from` says.
fn sampled(frame: &Frame, size: [u32; 2], from: impl Fn([u32; 2]) -> [u32; 2]) -> Frame {
    let pixels = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| [x, y]));
    let bytes = pixels.flat_map(|at| {
        let [x, y] = from(at);
        let start = ((y * frame.size[0] + x) * 4) as usize;
        [0, 1, 2, 3].map(|channel| frame.rgba[start + channel])
    });
    Frame {
        size,
        rgba: bytes.collect(),
        ..Frame::default()
    }
}

fn copy(frame: &Frame, sheet: &mut Frame, place: [u32; 2]) {
    let row_bytes = frame.size[0] as usize * 4;
    for (row, y) in frame.rgba.chunks_exact(row_bytes).zip(place[1]..) {
        let start = ((y * sheet.size[0] + place[0]) * 4) as usize;
        sheet.rgba[start..start + row_bytes].copy_from_slice(row);
    }
}
