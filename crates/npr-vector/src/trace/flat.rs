//! Traced curves as polygons.

use super::Segment;
use glam::DVec2;
use kurbo::{BezPath, PathEl, Point};

/// How far polygons are from traced curves, in pixels.
pub const FLATNESS_PX: f64 = 0.05;

/// A closed curve as points, the first repeated as the last; none of no segments. O(points).
pub(crate) fn flattened(segments: &[Segment]) -> Vec<DVec2> {
    let mut path = BezPath::new();
    let Some(start) = segments.last().map(Segment::end) else {
        return Vec::new();
    };
    path.move_to(point(start));
    for segment in segments {
        match *segment {
            Segment::Corner { corner, end } => {
                path.line_to(point(corner));
                path.line_to(point(end));
            }
            Segment::Arc { from, to, end } => path.curve_to(point(from), point(to), point(end)),
        }
    }
    let mut ring = Vec::new();
    kurbo::flatten(path, FLATNESS_PX, |element| {
        if let PathEl::MoveTo(p) | PathEl::LineTo(p) = element {
            ring.push(DVec2::new(p.x, p.y));
        }
    });
    ring
}

fn point(p: DVec2) -> Point {
    Point::new(p.x, p.y)
}
