//! Draws a face pixel by pixel, and prints its outlines as an SVG file and its lines as strokes.

use npr_trace::centreline::{CentrelineOptions, centrelines};
use npr_trace::{Bitmap, TraceFormat, TraceOptions, trace_to_file};
use std::io::{self, stdout};

const SIDE: u32 = 200;

fn main() -> io::Result<()> {
    let mut bitmap = Bitmap::new(SIDE, SIDE).map_err(io::Error::other)?;
    for (x, y) in (0..SIDE * SIDE).map(|i| (i % SIDE, i / SIDE)) {
        bitmap.set(x, y, is_ink(f64::from(x) - 99.5, f64::from(y) - 99.5));
    }

    // Outlines go around the ink: the rim is a shape with a hole.
    let options = TraceOptions::default();
    trace_to_file(&bitmap, &options, TraceFormat::Svg, &mut stdout())?;

    // Strokes go along it: the rim is one closed line.
    for stroke in centrelines(&bitmap, &CentrelineOptions::default()).strokes {
        let width = stroke.points.iter().map(|point| point.width).sum::<f64>();
        eprintln!(
            "{} points, {:.1} pixels wide, closed: {}",
            stroke.points.len(),
            width / stroke.points.len() as f64,
            stroke.closed
        );
    }
    Ok(())
}

/// A rim, two eyes and a mouth, around the middle.
fn is_ink(x: f64, y: f64) -> bool {
    let from = |cx: f64, cy: f64| ((x - cx).powi(2) + (y - cy).powi(2)).sqrt();
    let rim = (80.0..86.0).contains(&from(0.0, 0.0));
    let eyes = from(-30.0, -25.0) < 9.0 || from(30.0, -25.0) < 9.0;
    let mouth = (44.0..50.0).contains(&from(0.0, 5.0)) && y > 20.0;
    rim || eyes || mouth
}
