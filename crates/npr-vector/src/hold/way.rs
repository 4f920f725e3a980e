//! Which way strokes run, and how far along it their points lie.

use crate::mesh_lines::run::distance;
use crate::stroke::{LinePart, Stroke, StrokePoint};

/// Turns a stroke so that it is travelled the other way; a closed one keeps its first point. `u` is the way from there,
/// until [`phase`](super::phase) shifts it.
pub(super) fn reverse(stroke: &mut Stroke) {
    match stroke.closed {
        true => stroke.points[1..].reverse(),
        false => stroke.points.reverse(),
    }
    stroke.part = stroke.part.map(LinePart::reversed);
    measure(&mut stroke.points);
}

/// Gives every point the way from the first as its `u`.
pub(super) fn measure(points: &mut [StrokePoint]) {
    let mut last: Option<StrokePoint> = None;
    for point in points {
        point.u = last.map_or(0.0, |last| last.u + distance(last.position, point.position));
        last = Some(*point);
    }
}
