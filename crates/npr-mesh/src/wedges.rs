//! Which of many faces around one edge belong together.

use crate::half_edge::HalfEdgeMesh;
use glam::DVec3;

use crate::triangle::point;

/// Steps per quarter turn in which angles around an edge are compared.
///
/// Coplanar faces of touching solids should count as one direction, though their corners were rounded to `f32`.
const STEPS: f64 = (1 << 20) as f64;

/// Pairs of half-edges around `edge` that run opposite ways, as many as there can be.
///
/// A face that runs down the edge and the next one that runs up it, turning counter-clockwise as seen
/// from the edge's head, show each other their backs: they bound one wedge of solid matter. Those are
/// paired like brackets, so two boxes that touch along an edge stay two boxes. Of faces in one direction a
/// closing bracket comes first, then the lower number. O(k log k).
pub(crate) fn pair(shape: &HalfEdgeMesh, edge: u32) -> Vec<[u32; 2]> {
    let around = Frame::new(shape, edge);
    let mut ring: Vec<(i64, bool, u32)> = shape
        .sides(edge)
        .iter()
        .map(|&side| {
            let angle = around.angle(point(&shape.positions, shape.opposite(side)));
            (angle, !shape.runs_up(side), side)
        })
        .collect();
    ring.sort_unstable();

    // Match brackets round the ring: what the first turn leaves open, the second may close.
    let mut pairs = Vec::new();
    let mut open = Vec::new();
    let mut unmatched = Vec::new();
    for &(_, opens, side) in &ring {
        if opens {
            open.push(side);
        } else if let Some(opened) = open.pop() {
            pairs.push([opened, side]);
        } else {
            unmatched.push(side);
        }
    }
    pairs.extend(
        open.into_iter()
            .rev()
            .zip(unmatched)
            .map(|(opened, side)| [opened, side]),
    );
    pairs
}

/// Two directions across an edge, the second a quarter turn on.
struct Frame {
    origin: DVec3,
    across: [DVec3; 2],
}

impl Frame {
    fn new(shape: &HalfEdgeMesh, edge: u32) -> Self {
        let [origin, head] = shape.ends(edge).map(|v| point(&shape.positions, v));
        let along = (head - origin).normalize_or_zero();
        let steepest = along.abs().min_position();
        let across = along.cross(DVec3::AXES[steepest]).normalize_or_zero();
        Self {
            origin,
            across: [across, along.cross(across)],
        }
    }

    /// Grows with the angle of `tip` around the edge; 0 on the edge itself, where there is no angle.
    fn angle(&self, tip: DVec3) -> i64 {
        let [x, y] = self.across.map(|axis| axis.dot(tip - self.origin));
        let reach = x.abs() + y.abs();
        if reach == 0.0 {
            return 0;
        }
        let turn = match (x >= 0.0, y >= 0.0) {
            (true, true) => y / reach,
            (false, true) => 2.0 - y / reach,
            (false, false) => 2.0 - y / reach,
            (true, false) => 4.0 + y / reach,
        };
        (turn * STEPS).round() as i64 % (4 * STEPS as i64)
    }
}
