//! Centre lines as files.

use crate::artwork::ArtworkOptions;
use crate::fit::{FitOptions, fit};
use crate::json::write_json;
use crate::pdf::write_pdf;
use crate::svg::write_svg;
use kurbo::PathEl;
use npr_core::number::push_fixed;
use npr_trace::centreline::Centrelines;
use npr_trace::{FLATNESS_PX, TraceFormat};
use npr_vector::mesh_lines::run::distance;
use npr_vector::stroke::{Drawing, Kind, Stroke, StrokePoint, StrokeSurface};
use rayon::prelude::*;

/// Greatest distance between written curves and the smooth lines, in pixels.
const TOLERANCE_PX: f64 = 0.1;

/// Centre lines as the bytes of a file. Same lines, same bytes.
///
/// SVG and PDF hold stroked curves with the measured width, and the outline of the ink where it varies; JSON the
/// points of [`write_json`]; GeoJSON is that of [`write_centreline_geojson`].
pub fn write_centrelines(lines: &Centrelines, format: TraceFormat) -> Vec<u8> {
    let options = ArtworkOptions {
        tolerance_px: TOLERANCE_PX,
        ..ArtworkOptions::default()
    };
    match format {
        TraceFormat::Svg => write_svg(&centreline_drawing(lines), &options),
        TraceFormat::Pdf => write_pdf(&centreline_drawing(lines), &options),
        TraceFormat::Json => write_json(&centreline_drawing(lines)),
        TraceFormat::GeoJson => write_centreline_geojson(lines),
    }
}

/// Centre lines as a drawing for files: black strokes of kind [`Kind::Marked`], numbered in order.
///
/// Places in the world are those in the picture, in pixels; depth is 0.
pub fn centreline_drawing(lines: &Centrelines) -> Drawing {
    // Make a marked stroke of each line, measured along itself.
    let strokes = lines.strokes.iter().zip(0..).map(|(stroke, id)| {
        let mut u = 0.0;
        let mut before = None;
        let points = stroke.points.iter().map(|point| {
            u += before
                .replace(point.place)
                .map_or(0.0, |p| distance(p, point.place));
            let [x, y] = point.place;
            StrokePoint {
                position: point.place,
                width: point.width,
                u,
                world: [x as f32, y as f32, 0.0],
                ..StrokePoint::default()
            }
        });
        Stroke {
            id,
            kind: Kind::Marked,
            occluders: 0,
            surface: 0,
            closed: stroke.closed,
            part: None,
            points: points.collect(),
        }
    });

    // Draw all of them in black.
    Drawing {
        size: lines.size,
        surfaces: vec![StrokeSurface {
            object: "lines".to_owned(),
            line_color: [0, 0, 0, 255],
            fill_color: [255; 4],
            ..StrokeSurface::default()
        }],
        strokes: strokes.collect(),
        ..Drawing::default()
    }
}

/// A `LineString` for every stroke, with its mean width in pixels; y up from the lower edge. A closed one ends where
/// it starts.
pub fn write_centreline_geojson(lines: &Centrelines) -> Vec<u8> {
    let height = f64::from(lines.size[1]);
    let features: Vec<String> = lines
        .strokes
        .par_iter()
        .map(|stroke| {
            // Fit a curve to the line.
            let places: Vec<[f64; 2]> = stroke.points.iter().map(|point| point.place).collect();
            let options = FitOptions {
                tolerance: TOLERANCE_PX,
                ..FitOptions::default()
            };

            // Write its mean width.
            let widths: f64 = stroke.points.iter().map(|point| point.width).sum();
            let mut text = "{\"type\":\"Feature\",\"properties\":{\"width\":".to_owned();
            push_fixed(&mut text, widths / stroke.points.len().max(1) as f64, 3);
            text += "},\"geometry\":{\"type\":\"LineString\",\"coordinates\":[";

            // Flatten the curve, with y up.
            let mut comma = "";
            let mut push = |[x, y]: [f64; 2]| {
                text += std::mem::replace(&mut comma, ",");
                text.push('[');
                push_fixed(&mut text, x, 2);
                text.push(',');
                push_fixed(&mut text, height - y, 2);
                text.push(']');
            };
            let mut start = None;
            kurbo::flatten(
                fit(&places, stroke.closed, &options),
                FLATNESS_PX,
                |element| match element {
                    PathEl::MoveTo(p) | PathEl::LineTo(p) => {
                        start.get_or_insert([p.x, p.y]);
                        push([p.x, p.y]);
                    }
                    PathEl::ClosePath => start.into_iter().for_each(&mut push),
                    _ => {}
                },
            );
            text + "]}}"
        })
        .collect();
    let head = "{\"type\":\"FeatureCollection\",\"features\":[\n";
    format!("{head}{}\n]}}\n", features.join(",\n")).into_bytes()
}
