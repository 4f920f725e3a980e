//! Traced bitmaps as files.

use super::flat::flattened;
use super::{Bitmap, Segment, TraceOptions, TracedPath, Tracing, trace_map};
use crate::number::push_fixed;
use crate::svg::PathData;
use glam::DVec2;
use kurbo::Point;
use pdf_writer::{Pdf, Rect, Ref};
use rayon::prelude::*;

/// Decimals of coordinates: hundredths of a pixel.
const DECIMALS: u32 = 2;

/// Points per pixel: 96 pixels are an inch.
const POINTS_PER_PX: f64 = 0.75;

/// A file format for traced bitmaps. Coordinates are pixels, to a hundredth.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum TraceFormat {
    /// Black shapes with their holes, each a path; y down.
    Svg,
    /// One page with the same shapes.
    Pdf,
    /// Every outline with area, parent and segments, y down. A segment of four numbers is a corner and the end of the straight piece
    /// after it, one of six is an arc: two control points and the end. The last end is the start.
    Json,
    /// A polygon for every shape, with its holes, within 0.05 pixels of the curves; y up from the lower edge.
    GeoJson,
}

/// A tracing as the bytes of a file. Same tracing, same bytes.
pub fn write_tracing(tracing: &Tracing, format: TraceFormat) -> Vec<u8> {
    let height = f64::from(tracing.size[1]);
    let pieces = tracing.paths.par_iter().map(|path| TracedPath {
        is_ink: path.is_ink,
        area: path.area,
        parent: path.parent,
        segments: format.piece(&path.segments, height),
    });
    format.assemble(tracing.size, pieces.collect())
}

/// [`write_tracing`] of [`trace`](super::trace()), without keeping the curves: takes less memory, and gives the same bytes.
pub fn trace_to_file(bitmap: &Bitmap, options: &TraceOptions, format: TraceFormat) -> Vec<u8> {
    let pieces = pieces(bitmap, options, format);
    format.assemble([bitmap.width(), bitmap.height()], pieces)
}

/// The paths of a bitmap as text.
pub(super) fn pieces(
    bitmap: &Bitmap,
    options: &TraceOptions,
    format: TraceFormat,
) -> Vec<TracedPath<String>> {
    let height = f64::from(bitmap.height());
    trace_map(bitmap, options, |_, segments| {
        let mut piece = format.piece(&segments, height);
        // Of a million specks the spare room would be the most.
        piece.shrink_to_fit();
        piece
    })
}

impl TraceFormat {
    /// One closed curve; nothing where it has no extent on the grid.
    fn piece(self, segments: &[Segment], height: f64) -> String {
        let Some(start) = segments.last().map(Segment::end) else {
            return String::new();
        };
        match self {
            Self::Svg => svg_piece(start, segments),
            Self::Pdf => pdf_piece(start, segments),
            Self::Json => json_piece(segments),
            Self::GeoJson => ring(segments, height),
        }
    }

    fn assemble(self, size: [u32; 2], paths: Vec<TracedPath<String>>) -> Vec<u8> {
        let length: usize = paths.iter().map(|path| path.segments.len() + 48).sum();
        let mut text = String::with_capacity(length + 400);
        match self {
            Self::Svg => {
                text += &svg_head(size);
                text += "<g fill=\"#000000\">\n";
                push_svg_shapes(&mut text, paths);
                text += "</g>\n</svg>\n";
            }
            Self::Pdf => {
                push_pdf_shapes(&mut text, paths);
                return page(size, &text);
            }
            Self::Json => {
                text += &json_head(size);
                text += "\"paths\":[";
                push_list(&mut text, &paths);
                text += "\n]}\n";
            }
            Self::GeoJson => {
                text += FEATURES_HEAD;
                push_features(&mut text, paths, "", &mut "\n");
                text += "\n]}\n";
            }
        }
        text.into_bytes()
    }
}

/// What opens an SVG file.
pub(super) fn svg_head([width, height]: [u32; 2]) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\">\n"
    )
}

/// What opens a JSON file.
pub(super) fn json_head([width, height]: [u32; 2]) -> String {
    format!("{{\"version\":1,\"size\":[{width},{height}],")
}

/// What opens a GeoJSON file.
pub(super) const FEATURES_HEAD: &str = "{\"type\":\"FeatureCollection\",\"features\":[";

pub(super) fn push_svg_shapes(text: &mut String, paths: Vec<TracedPath<String>>) {
    push_shapes(text, paths, ["<path d=\"", "", "\"/>\n"], |_| String::new());
}

pub(super) fn push_pdf_shapes(text: &mut String, paths: Vec<TracedPath<String>>) {
    push_shapes(text, paths, ["", "", "f\n"], |_| String::new());
}

/// Writes a feature a shape, with `properties` after its area; `comma` comes before the first and is that between them afterwards.
pub(super) fn push_features(
    text: &mut String,
    paths: Vec<TracedPath<String>>,
    properties: &str,
    comma: &mut &str,
) {
    let head = |area: u64| {
        let comma = std::mem::replace(comma, ",\n");
        format!(
            "{comma}{{\"type\":\"Feature\",\"properties\":{{\"area\":{area}{properties}}},\
             \"geometry\":{{\"type\":\"Polygon\",\"coordinates\":["
        )
    };
    push_shapes(text, paths, ["", ",", "]}}"], head);
}

/// Writes every shape, then its holes: `head` of the area, what opens, the pieces with what parts them, what closes.
fn push_shapes(
    text: &mut String,
    mut paths: Vec<TracedPath<String>>,
    [open, between, close]: [&str; 3],
    mut head: impl FnMut(u64) -> String,
) {
    // Holes of a shape in a chain, from the first on.
    let count = paths.len();
    let mut first = vec![usize::MAX; count];
    let mut next = vec![usize::MAX; count];
    for (index, path) in paths.iter().enumerate().rev() {
        let around = path.parent.filter(|_| !path.is_ink);
        if let Some(shape) = around.and_then(|parent| first.get_mut(parent as usize)) {
            next[index] = std::mem::replace(shape, index);
        }
    }
    for shape in 0..count {
        let path = &mut paths[shape];
        if !path.is_ink || path.segments.is_empty() {
            continue;
        }
        *text += &head(path.area);
        *text += open;
        // What is written is given back, so that the text takes its place.
        *text += &std::mem::take(&mut path.segments);
        let mut hole = first[shape];
        while let Some(path) = paths.get_mut(hole) {
            if !path.segments.is_empty() {
                *text += between;
                *text += &std::mem::take(&mut path.segments);
            }
            hole = next[hole];
        }
        *text += close;
    }
}

pub(super) fn push_list(text: &mut String, paths: &[TracedPath<String>]) {
    for (index, path) in paths.iter().enumerate() {
        let comma = if index == 0 { "" } else { "," };
        let (is_ink, area) = (path.is_ink, path.area);
        let parent = path.parent.map_or("null".to_owned(), |p| p.to_string());
        *text += &format!(
            "{comma}\n{{\"ink\":{is_ink},\"area\":{area},\"parent\":{parent},\"segments\":["
        );
        *text += &path.segments;
        *text += "]}";
    }
}

fn point(p: DVec2) -> Point {
    Point::new(p.x, p.y)
}

fn svg_piece(start: DVec2, segments: &[Segment]) -> String {
    let mut data = PathData::new(DECIMALS);
    data.begin(point(start));
    for segment in segments {
        match *segment {
            Segment::Corner { corner, end } => {
                data.piece('l', &[point(corner)]);
                data.piece('l', &[point(end)]);
            }
            Segment::Arc { from, to, end } => data.piece('c', &[from, to, end].map(point)),
        }
    }
    data.close();
    data.text
}

/// Writes numbers with blanks between.
fn push_point(text: &mut String, p: DVec2, between: char) {
    push_fixed(text, p.x, DECIMALS);
    text.push(between);
    push_fixed(text, p.y, DECIMALS);
}

fn pdf_piece(start: DVec2, segments: &[Segment]) -> String {
    let mut text = String::new();
    let mut push = |points: &[DVec2], operator: &str| {
        for p in points {
            push_point(&mut text, *p, ' ');
            text.push(' ');
        }
        text += operator;
    };
    push(&[start], "m\n");
    for segment in segments {
        match *segment {
            Segment::Corner { corner, end } => {
                push(&[corner], "l\n");
                push(&[end], "l\n");
            }
            Segment::Arc { from, to, end } => push(&[from, to, end], "c\n"),
        }
    }
    push(&[], "h\n");
    text
}

fn json_piece(segments: &[Segment]) -> String {
    let mut text = String::new();
    for (index, segment) in segments.iter().enumerate() {
        text += if index == 0 { "[" } else { ",[" };
        let push = |text: &mut String, points: &[DVec2]| {
            for (index, p) in points.iter().enumerate() {
                if index > 0 {
                    text.push(',');
                }
                push_point(text, *p, ',');
            }
        };
        match *segment {
            Segment::Corner { corner, end } => push(&mut text, &[corner, end]),
            Segment::Arc { from, to, end } => push(&mut text, &[from, to, end]),
        }
        text.push(']');
    }
    text
}

/// The curve as a closed ring of points, y up.
fn ring(segments: &[Segment], height: f64) -> String {
    let mut text = String::new();
    for p in flattened(segments) {
        text += if text.is_empty() { "[[" } else { ",[" };
        push_point(&mut text, DVec2::new(p.x, height - p.y), ',');
        text.push(']');
    }
    text.push(']');
    text
}

/// A PDF file of one page with the shapes of a text of operators.
pub(super) fn page(size: [u32; 2], shapes: &str) -> Vec<u8> {
    let [catalog, pages, page, content] = [1, 2, 3, 4].map(Ref::new);
    let [width, height] = size.map(|side| f64::from(side) * POINTS_PER_PX);
    let mut pdf = Pdf::new();
    pdf.catalog(catalog).pages(pages);
    pdf.pages(pages).kids([page]).count(1);
    pdf.page(page)
        .parent(pages)
        .media_box(Rect::new(0.0, 0.0, width as f32, height as f32))
        .contents(content)
        .resources();
    let mut stream = format!("{POINTS_PER_PX} 0 0 -{POINTS_PER_PX} 0 {height} cm\n");
    stream += shapes;
    pdf.stream(content, stream.as_bytes());
    pdf.finish()
}
