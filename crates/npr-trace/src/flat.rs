//! Traced curves as polygons.

use super::Segment;
use glam::DVec2;
use kurbo::{PathEl, Point};

/// How far polygons are from traced curves, in pixels.
pub const FLATNESS_PX: f64 = 0.05;

/// A closed curve as points, the first repeated as the last; none of no segments. O(points).
pub fn flattened(segments: &[Segment]) -> Vec<DVec2> {
    let Some(start) = segments.last().map(Segment::end) else {
        return Vec::new();
    };
    let mut ring = vec![start];
    let mut here = start;
    for segment in segments {
        flatten(here, segment, |p| ring.push(p));
        here = segment.end();
    }
    ring
}

/// Gives the points of a segment after its start.
pub(super) fn flatten(start: DVec2, segment: &Segment, mut each: impl FnMut(DVec2)) {
    match *segment {
        Segment::Corner { corner, end } => {
            each(corner);
            each(end);
        }
        Segment::Arc { from, to, end } => {
            let arc = [
                PathEl::MoveTo(point(start)),
                PathEl::CurveTo(point(from), point(to), point(end)),
            ];
            kurbo::flatten(arc, FLATNESS_PX, |element| {
                if let PathEl::LineTo(p) = element {
                    each(DVec2::new(p.x, p.y));
                }
            });
        }
    }
}

fn point(p: DVec2) -> Point {
    Point::new(p.x, p.y)
}
