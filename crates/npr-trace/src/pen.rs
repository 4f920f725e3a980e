//! Traced curves as the text of files, segment by segment.

use super::flat::flatten;
use super::{Segment, TraceFormat};
use crate::svg_path::PathData;
use glam::DVec2;
use kurbo::Point;
use npr_core::number::push_fixed;

/// Decimals of coordinates: hundredths of a pixel.
const DECIMALS: u32 = 2;

/// What draws closed curves.
pub(super) trait Pen {
    /// Begins a curve where its last segment will end.
    fn begin(&mut self, start: DVec2);

    fn draw(&mut self, segment: Segment);

    /// Closes the curve.
    fn end(&mut self);
}

impl Pen for Vec<Segment> {
    fn begin(&mut self, _: DVec2) {}

    fn draw(&mut self, segment: Segment) {
        self.push(segment);
    }

    fn end(&mut self) {}
}

/// Curves in the words of a format, one behind the other.
pub(super) struct TextPen {
    format: TraceFormat,
    /// Of the picture.
    height: f64,
    /// The text, and the state of paths in SVG.
    data: PathData,
    /// Where the last segment ended.
    here: DVec2,
    /// Whether the curve has no segment yet.
    is_new: bool,
}

impl TextPen {
    pub fn new(format: TraceFormat, height: f64) -> Self {
        Self {
            format,
            height,
            data: PathData::new(DECIMALS),
            here: DVec2::ZERO,
            is_new: true,
        }
    }

    pub fn text(&self) -> &str {
        &self.data.text
    }

    pub fn reserve(&mut self, bytes: usize) {
        self.data.text.reserve(bytes);
    }

    pub fn shrink(&mut self) {
        self.data.text.shrink_to_fit();
    }

    /// A point of a ring, y up.
    fn push_ring(&mut self, p: DVec2) {
        self.data.text.push('[');
        push_point(&mut self.data.text, DVec2::new(p.x, self.height - p.y), ',');
        self.data.text.push(']');
    }

    /// Points with an operator behind them.
    fn push_operator(&mut self, points: &[DVec2], operator: &str) {
        for p in points {
            push_point(&mut self.data.text, *p, ' ');
            self.data.text.push(' ');
        }
        self.data.text += operator;
    }

    /// A list of numbers.
    fn push_list(&mut self, points: &[DVec2]) {
        self.data.text += if self.is_new { "[" } else { ",[" };
        for (index, p) in points.iter().enumerate() {
            if index > 0 {
                self.data.text.push(',');
            }
            push_point(&mut self.data.text, *p, ',');
        }
        self.data.text.push(']');
    }
}

impl Pen for TextPen {
    fn begin(&mut self, start: DVec2) {
        (self.here, self.is_new) = (start, true);
        match self.format {
            TraceFormat::Svg => self.data.begin(point(start)),
            TraceFormat::Pdf => self.push_operator(&[start], "m\n"),
            TraceFormat::Json => {}
            TraceFormat::GeoJson => {
                self.data.text.push('[');
                self.push_ring(start);
            }
        }
    }

    fn draw(&mut self, segment: Segment) {
        match (self.format, segment) {
            (TraceFormat::Svg, Segment::Corner { corner, end }) => {
                self.data.piece('l', &[point(corner)]);
                self.data.piece('l', &[point(end)]);
            }
            (TraceFormat::Svg, Segment::Arc { from, to, end }) => {
                self.data.piece('c', &[from, to, end].map(point));
            }
            (TraceFormat::Pdf, Segment::Corner { corner, end }) => {
                self.push_operator(&[corner], "l\n");
                self.push_operator(&[end], "l\n");
            }
            (TraceFormat::Pdf, Segment::Arc { from, to, end }) => {
                self.push_operator(&[from, to, end], "c\n");
            }
            (TraceFormat::Json, Segment::Corner { corner, end }) => self.push_list(&[corner, end]),
            (TraceFormat::Json, Segment::Arc { from, to, end }) => self.push_list(&[from, to, end]),
            (TraceFormat::GeoJson, segment) => flatten(self.here, &segment, |p| {
                self.data.text.push(',');
                self.push_ring(p);
            }),
        }
        (self.here, self.is_new) = (segment.end(), false);
    }

    fn end(&mut self) {
        match self.format {
            TraceFormat::Svg => self.data.close(),
            TraceFormat::Pdf => self.push_operator(&[], "h\n"),
            TraceFormat::Json => {}
            TraceFormat::GeoJson => self.data.text.push(']'),
        }
    }
}

fn point(p: DVec2) -> Point {
    Point::new(p.x, p.y)
}

/// Writes the numbers of a point with a mark between.
fn push_point(text: &mut String, p: DVec2, between: char) {
    push_fixed(text, p.x, DECIMALS);
    text.push(between);
    push_fixed(text, p.y, DECIMALS);
}
