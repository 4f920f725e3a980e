//! Writes three swelling spirals as an SVG page of A5, in an order that suits a pen plotter.

use npr_drawing::artwork::{Page, Paths};
use npr_drawing::svg::{SvgOptions, write_svg};
use npr_vector::stroke::{Drawing, Kind, Stroke, StrokePoint, StrokeSurface};
use std::io::{self, Write, stdout};

fn main() -> io::Result<()> {
    let drawing = Drawing {
        size: [600, 400],
        surfaces: vec![StrokeSurface {
            object: "spirals".to_owned(),
            line_color: [20, 30, 90, 255],
            ..StrokeSurface::default()
        }],
        strokes: (0..3).map(spiral).collect(),
        ..Drawing::default()
    };
    let options = SvgOptions {
        page: Page::parse("a5"),
        paths: Paths::Centreline,
        ..SvgOptions::default()
    };
    stdout().write_all(&write_svg(&drawing, &options))
}

/// A spiral about its own middle, thin at its ends.
fn spiral(number: u32) -> Stroke {
    let middle = [120.0 + 180.0 * f64::from(number), 200.0];
    let point = |i: u32| {
        let t = f64::from(i) / 400.0;
        let angle = (t * 40.0) as f32;
        let radius = 80.0 * t;
        StrokePoint {
            position: [
                middle[0] + radius * f64::from(npr_core::math::cos(angle)),
                middle[1] + radius * f64::from(npr_core::math::sin(angle)),
            ],
            width: 0.5 + 12.0 * t * (1.0 - t),
            ..StrokePoint::default()
        }
    };
    Stroke {
        id: u64::from(number),
        kind: Kind::Marked,
        occluders: 0,
        surface: 0,
        closed: false,
        part: None,
        points: (0..=400).map(point).collect(),
    }
}
