//! Where closed strokes start: where they did in the frame before.

use crate::mesh_lines::run::distance;
use crate::stroke::Stroke;

/// Turns a closed stroke so that it starts at the point nearest to a place, and returns whether it did not yet.
pub(super) fn start_at(stroke: &mut Stroke, place: [f64; 2]) -> bool {
    let away = |index: &usize| distance(stroke.points[*index].position, place);
    let nearest = (0..stroke.points.len()).min_by(|a, b| away(a).total_cmp(&away(b)));
    let is_place = place.iter().all(|v| v.is_finite());
    match nearest.filter(|first| *first > 0 && is_place) {
        Some(first) => {
            stroke.points.rotate_left(first);
            true
        }
        None => false,
    }
}
