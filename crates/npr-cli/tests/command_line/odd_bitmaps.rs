//! `npr trace` on sound pictures of odd kinds and sizes.

use crate::workplace::Workplace;

/// The kinds of pixel of a PNG, and the bytes of its picture: four pixels in a row, the second and third of them ink.
struct Kind {
    name: &'static str,
    color: png::ColorType,
    depth: png::BitDepth,
    palette: &'static [u8],
    transparency: &'static [u8],
    row: &'static [u8],
}

const PLAIN: Kind = Kind {
    name: "",
    color: png::ColorType::Grayscale,
    depth: png::BitDepth::Eight,
    palette: &[],
    transparency: &[],
    row: &[],
};

/// The darkest white and the brightest ink of each kind, where its steps are fine enough.
const KINDS: [Kind; 12] = [
    Kind {
        name: "one bit",
        depth: png::BitDepth::One,
        row: &[0b1001_0000],
        ..PLAIN
    },
    Kind {
        name: "two bits",
        depth: png::BitDepth::Two,
        row: &[0b1000_0110],
        ..PLAIN
    },
    Kind {
        name: "four bits",
        depth: png::BitDepth::Four,
        row: &[0x87, 0x08],
        ..PLAIN
    },
    Kind {
        name: "eight bits",
        row: &[128, 127, 0, 255],
        ..PLAIN
    },
    Kind {
        name: "sixteen bits",
        depth: png::BitDepth::Sixteen,
        row: &[0x80, 0, 0x7f, 0xff, 0, 0, 0xff, 0xff],
        ..PLAIN
    },
    Kind {
        name: "grey of which one value is transparent",
        transparency: &[0, 7],
        row: &[7, 6, 8, 255],
        ..PLAIN
    },
    Kind {
        name: "grey with alpha",
        color: png::ColorType::GrayscaleAlpha,
        row: &[0, 127, 0, 128, 127, 255, 255, 255],
        ..PLAIN
    },
    Kind {
        name: "colour",
        color: png::ColorType::Rgb,
        row: &[255, 128, 0, 255, 127, 0, 0, 0, 255, 128, 128, 128],
        ..PLAIN
    },
    Kind {
        name: "colour with alpha over white",
        color: png::ColorType::Rgba,
        row: &[0, 0, 0, 0, 0, 0, 0, 255, 0, 0, 0, 128, 0, 0, 0, 127],
        ..PLAIN
    },
    Kind {
        name: "deep colour with alpha over white",
        color: png::ColorType::Rgba,
        depth: png::BitDepth::Sixteen,
        row: &[
            0, 0, 0, 0, 0, 0, 0, 0, // clear
            0, 0, 0, 0, 0, 0, 0xff, 0xff, // black
            0, 0, 0, 0, 0, 0, 0x80, 0x80, // black, half there
            0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, // white
        ],
        ..PLAIN
    },
    Kind {
        name: "palette",
        color: png::ColorType::Indexed,
        palette: &[0, 0, 0, 255, 255, 255, 255, 0, 0],
        row: &[1, 0, 2, 1],
        ..PLAIN
    },
    Kind {
        name: "palette of two bits with transparency",
        color: png::ColorType::Indexed,
        depth: png::BitDepth::Two,
        palette: &[0, 0, 0, 10, 10, 10, 20, 20, 20],
        transparency: &[0, 255, 255],
        row: &[0b0001_1000],
    },
];

impl Kind {
    fn file(&self) -> Vec<u8> {
        let mut file = Vec::new();
        let mut encoder = png::Encoder::new(&mut file, 4, 1);
        encoder.set_color(self.color);
        encoder.set_depth(self.depth);
        if !self.palette.is_empty() {
            encoder.set_palette(self.palette);
        }
        if !self.transparency.is_empty() {
            encoder.set_trns(self.transparency);
        }
        let mut writer = encoder.write_header().expect("a header");
        writer.write_image_data(self.row).expect("one row");
        drop(writer);
        file
    }
}

#[test]
fn every_kind_of_pixel_is_read_as_ink_over_white() {
    let place = Workplace::new();
    place.put("plain.pbm", b"P1 4 1 0110");
    let trace = |name| place.npr(&["trace", name, "--turdsize", "0", "-o", "-"]);
    let wanted = trace("plain.pbm");
    assert!(wanted.text().contains("<path d=\"M"), "{}", wanted.text());
    for kind in &KINDS {
        place.put("kind.png", &kind.file());
        let outcome = trace("kind.png");
        outcome.assert_silent_success();
        assert_eq!(outcome.text(), wanted.text(), "{}", kind.name);
    }
}

#[test]
fn the_smallest_pictures_are_drawn_whole() {
    let place = Workplace::new();
    let row = format!("P1 50 1 {}", "1".repeat(50));
    let column = format!("P1 1 50 {}", "1".repeat(50));
    let cases = [
        ("P1 1 1 1", [1, 1], 1),
        ("P1 1 1 0", [1, 1], 0),
        ("P1 2 1 10", [2, 1], 1),
        ("P1 1 2 01", [1, 2], 1),
        (&row, [50, 1], 50),
        (&column, [1, 50], 50),
    ];
    for (bitmap, [width, height], area) in cases {
        place.put("small.pbm", bitmap.as_bytes());
        for more in [&[][..], &["--centreline"]] {
            let arguments = ["trace", "small.pbm", "-t", "0", "-o", "-"];
            let outcome = place.npr(&[&arguments, more].concat());
            outcome.assert_silent_success();
            let text = outcome.text();
            let size = format!("width=\"{width}\" height=\"{height}\"");
            assert!(text.contains(&size), "{bitmap} {more:?}: {text}");
            let paths = text.matches("<path").count();
            assert_eq!(paths, usize::from(area > 0), "{bitmap} {more:?}: {text}");
        }
        let outcome = place.npr(&[
            "trace",
            "small.pbm",
            "-t",
            "0",
            "-o",
            "-",
            "--format",
            "json",
        ]);
        let data: serde_json::Value = serde_json::from_slice(&outcome.stdout).expect("JSON");
        let found = data["paths"][0]["area"].as_u64().unwrap_or(0);
        assert_eq!(found, area, "{bitmap}");
    }
}
