//! Strokes that draw motion, sorted by what they are.

use npr_vector::stroke::StrokePoint;

/// Strokes of one sort, before they have a place in a drawing.
pub(super) struct MotionStrokes {
    /// Name of the object that they are, and of its material.
    pub names: [String; 2],
    /// Their points, each list with a number that stays with it from picture to picture.
    pub strokes: Vec<(u64, Vec<StrokePoint>)>,
}
