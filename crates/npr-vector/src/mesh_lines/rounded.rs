//! Rounded edges: where a narrow rounding leads from one flat side to the next, one line stands for the corner.
//!
//! Models for games and machines have their edges rounded or chamfered, so that no edge folds by much and shading
//! runs on over all of them. A draughtsman draws the corner all the same, as one line, where the rounding is narrow.

use crate::mesh_lines::feature::folds;
use crate::mesh_lines::zero_set::CornerNormals;
use glam::DVec3;
use npr_core::crease::Creases;
use npr_core::edge_flags::EdgeFlags;
use npr_core::geometry::NONE;
use npr_mesh::half_edge::HalfEdgeMesh;
use npr_mesh::union_find::UnionFind;
use rayon::prelude::*;

/// Widths of roundings that are looked for, in the widest: a narrow one has flat sides of its own only nearby.
const WIDTHS: [f64; 3] = [1.0, 0.5, 0.25];

/// Fold from which an edge can be the middle of a rounding, in radians: 4 degrees.
const LEAST_FOLD: f64 = 4.0 / 180.0 * std::f64::consts::PI;

/// How much of the least turn shading has to show: the rest spreads over flat sides as far as their next vertices.
const SHADING_SHARE: f64 = 0.75;

/// How much the surface may turn beside a rounding, as a share of its own turn, on each side.
const BESIDE_SHARE: f64 = 0.2;

/// How much a rounding may turn back on the way, as a share of its turn.
const BACK_SHARE: f64 = 0.1;

/// Cosine of the angle between an edge and the axis that its rounding turns about, at least: 26 degrees.
const ALONG_COS: f64 = 0.9;

/// Most faces that a walk across a rounding passes on one side.
const WALK_LIMIT: usize = 64;

/// Least length of a row of edges along a rounding, in widths of the widest: shorter ones are grain.
const LENGTH_SHARE: f64 = 4.0;

/// Decides between two edges that share the middle of a rounding: any direction that models are not built along.
const FIRST: DVec3 = DVec3::new(0.372, 0.839, 0.397);

/// The edges in the middle of narrow roundings, ascending; none where [`Creases::round`] is 0.
///
/// A rounding turns by the angle of creases or more within [`Creases::round`] across, in the unit of positions: about
/// the edge's own direction, never back, and in its shading as well as in its faces. Limbs of coarse figures are no
/// roundings, as their shading turns all the way from one edge to the next. Beside it the surface is flat, compared
/// with that, as far again on both sides. Of the edges along it that one is taken at which half of the turn is reached.
/// Rows of them that are short are left out, and creases are none: they end the walk. `normals` are those of the same
/// creases.
///
/// O(edges x faces across a rounding), parallel.
pub fn rounded_edges(shape: &HalfEdgeMesh, normals: &CornerNormals, creases: Creases) -> Vec<u32> {
    let surface = Surface {
        shape,
        normals,
        creases,
        least_turn: f64::from(creases.cos).clamp(-1.0, 1.0).acos(),
    };
    let widths = WIDTHS.map(|share| share * f64::from(creases.round));
    let edges = (0..shape.edge_count() as u32)
        .into_par_iter()
        .with_min_len(1024)
        .filter(|edge| creases.round > 0.0 && surface.is_rounded(*edge, widths))
        .collect();
    in_long_rows(shape, edges, LENGTH_SHARE * f64::from(creases.round))
}

/// Those of the edges that make rows with others which they meet, together at least of a length.
fn in_long_rows(shape: &HalfEdgeMesh, edges: Vec<u32>, least: f64) -> Vec<u32> {
    // Give every edge the number of its row.
    let mut meetings: Vec<(u32, u32)> = (0u32..)
        .zip(&edges)
        .flat_map(|(k, edge)| shape.ends(*edge).map(|vertex| (vertex, k)))
        .collect();
    meetings.sort_unstable();
    let mut rows = UnionFind::new(edges.len());
    for pair in meetings.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
        rows.unite(pair[0].1, pair[1].1);
    }

    // Measure the rows.
    let row_of: Vec<u32> = (0..edges.len() as u32).map(|k| rows.find(k)).collect();
    let mut lengths = vec![0.0; edges.len()];
    for (edge, row) in edges.iter().zip(&row_of) {
        let [a, b] = shape.ends(*edge).map(|vertex| shape.point(vertex));
        lengths[*row as usize] += a.distance(b);
    }
    let kept = edges.into_iter().zip(row_of);
    kept.filter(|(_, row)| lengths[*row as usize] >= least)
        .map(|(edge, _)| edge)
        .collect()
}

/// A shape with what its roundings are measured by.
struct Surface<'a> {
    shape: &'a HalfEdgeMesh,
    normals: &'a CornerNormals,
    creases: Creases,
    /// Angle by which a rounding turns at least.
    least_turn: f64,
}

/// A place on a face, with the direction in which a walk goes on.
#[derive(Clone, Copy)]
struct Step {
    /// The half-edge over which the face was entered.
    side: u32,
    at: DVec3,
    ahead: DVec3,
    /// The face's own normal.
    normal: DVec3,
}

/// What a walk from the middle of an edge meets on one side.
struct Walk {
    /// Angles that the faces turn by about the edge: within half of the width, and within all of it.
    turns: [f64; 2],
    /// Shading normals at half of the width, and at all of it.
    normals: [DVec3; 2],
}

impl Surface<'_> {
    fn is_rounded(&self, edge: u32, widths: [f64; 3]) -> bool {
        // Take edges that fold a little between two faces.
        let &[left, right] = self.shape.sides(edge) else {
            return false;
        };
        if !self.is_passable(edge) {
            return false;
        }
        let [tail, head] = self
            .shape
            .ends_of_half_edge(left)
            .map(|v| self.shape.point(v));
        let axis = (head - tail).normalize_or_zero();
        let fold = turn([right, left].map(|side| self.face_normal(side / 3)), axis);
        if fold.abs() < LEAST_FOLD {
            return false;
        }

        // Look at both sides of it, by each width.
        widths.into_iter().any(|width| {
            let [left, right] =
                [(left, axis), (right, -axis)].map(|(side, axis)| self.walk(side, axis, width));
            self.turns_round([&left, &right], fold, axis)
        })
    }

    /// Whether two walks found a rounding with an edge in its middle that folds by `fold`.
    fn turns_round(&self, walks: [&Walk; 2], fold: f64, axis: DVec3) -> bool {
        // Measure the turn within the width: of the faces, and of the shading, about the edge.
        let sign = fold.signum();
        let sides = walks.map(|walk| sign * walk.turns[0]);
        let fold = fold.abs();
        let faces = sides[0] + fold + sides[1];
        let [left, right] = walks.map(|walk| walk.normals);
        let shading = sign * turn([right[0], left[0]], axis);
        let least = self.least_turn;
        if !(faces >= least && shading >= SHADING_SHARE * least)
            || sides.iter().any(|side| *side < -BACK_SHARE * faces)
        {
            return false;
        }

        // See that it turns about the edge, and that its sides are flat.
        let about = right[0].cross(left[0]).normalize_or_zero();
        let beside = [left, right].map(|[near, far]| near.angle_between(far));
        if about.dot(axis).abs() < ALONG_COS || !beside.iter().all(|b| *b <= BESIDE_SHARE * shading)
        {
            return false;
        }

        // See that half of the turn is reached here; of two edges beside the middle face one is taken.
        let sides = walks.map(|walk| sign * walk.turns[1]);
        let uneven = (sides[0] - sides[1]).abs();
        if (uneven - fold).abs() > 1e-3 * faces {
            return uneven < fold;
        }
        let [outer, inner] = match sides[0] > sides[1] {
            true => [right[1], left[1]],
            false => [left[1], right[1]],
        };
        outer.dot(FIRST) > inner.dot(FIRST)
    }

    /// Walks from the middle of a half-edge straight over the surface, as far as `width`.
    fn walk(&self, start: u32, axis: DVec3, width: f64) -> Walk {
        let [tail, head] = self
            .shape
            .ends_of_half_edge(start)
            .map(|v| self.shape.point(v));
        let normal = self.face_normal(start / 3);
        let mut step = Step {
            side: start,
            at: 0.5 * (tail + head),
            ahead: normal.cross((head - tail).normalize_or_zero()),
            normal,
        };
        let mut turned = 0.0;
        let mut walked = 0.0;
        let mut near = None;
        for _ in 0..WALK_LIMIT {
            // Cross the face, or stop in it.
            let Some((out, leave)) = self.exit(&step) else {
                break;
            };
            let length = leave.distance(step.at);
            let point_at = |distance: f64| step.at + step.ahead * (distance - walked);
            if near.is_none() && walked + length >= 0.5 * width {
                near = Some((self.shading(step.side / 3, point_at(0.5 * width)), turned));
            }
            if walked + length >= width {
                let far = self.shading(step.side / 3, point_at(width));
                return ended(near, (far, turned));
            }

            // Turn into the next face, unless the surface ends.
            walked += length;
            step.at = leave;
            let next = self.shape.twins[out as usize];
            if next == NONE || !self.is_passable(self.shape.edge_of[out as usize]) {
                break;
            }
            let [a, b] = self
                .shape
                .ends_of_half_edge(out)
                .map(|v| self.shape.point(v));
            let hinge = (b - a).normalize_or_zero();
            let after = self.face_normal(next / 3);
            turned += turn([step.normal, after], hinge) * hinge.dot(axis);
            let along = step.ahead.dot(hinge);
            let inward = after.cross(-hinge) * (step.ahead - hinge * along).length();
            step = Step {
                side: next,
                at: leave,
                ahead: (hinge * along + inward).normalize_or_zero(),
                normal: after,
            };
        }
        let far = self.shading(step.side / 3, step.at);
        ended(near, (far, turned))
    }

    /// The half-edge by which a walk leaves its face, and where.
    fn exit(&self, step: &Step) -> Option<(u32, DVec3)> {
        let first = HalfEdgeMesh::following(step.side);
        let ways = [first, HalfEdgeMesh::following(first)].map(|half_edge| {
            let [a, b] = self
                .shape
                .ends_of_half_edge(half_edge)
                .map(|v| self.shape.point(v));
            let outward = (b - a).cross(step.normal);
            let speed = step.ahead.dot(outward);
            let way = ((a - step.at).dot(outward) / speed).max(0.0);
            (if speed > 0.0 { way } else { f64::INFINITY }, half_edge)
        });
        let (way, half_edge) = if ways[0].0 <= ways[1].0 {
            ways[0]
        } else {
            ways[1]
        };
        way.is_finite()
            .then(|| (half_edge, step.at + step.ahead * way))
    }

    /// Whether a walk goes on over an edge: between two faces wound alike, of one object, without a line.
    fn is_passable(&self, edge: u32) -> bool {
        let traits = self.shape.edge_traits[edge as usize];
        let ends = EdgeFlags::BOUNDARY | EdgeFlags::NON_MANIFOLD | EdgeFlags::FLIPPED;
        !traits.intersects(ends)
            && self.shape.sides(edge).len() == 2
            && !folds(self.shape, edge, self.creases)
    }

    fn face_normal(&self, face: u32) -> DVec3 {
        let [a, b, c] = self.shape.faces[face as usize].map(|v| self.shape.point(v));
        (b - a).cross(c - a).normalize_or_zero()
    }

    /// The normal that shading has at a point of a face: blended between its corners.
    fn shading(&self, face: u32, at: DVec3) -> DVec3 {
        let corners = self.shape.faces[face as usize].map(|v| self.shape.point(v));
        let across = self.face_normal(face);
        (0..3)
            .map(|i| {
                let [b, c] = [1, 2].map(|k| corners[(i + k) % 3]);
                let weight = (b - at).cross(c - at).dot(across).max(0.0);
                let normal = self.normals.normal(3 * face + i as u32);
                DVec3::from_array(normal.map(f64::from)) * weight
            })
            .sum::<DVec3>()
            .normalize_or_zero()
    }
}

/// A walk that ended with a normal and a turn, and had others at half of the width, if it came so far.
fn ended(near: Option<(DVec3, f64)>, far: (DVec3, f64)) -> Walk {
    let (normal, turn) = near.unwrap_or(far);
    Walk {
        turns: [turn, far.1],
        normals: [normal, far.0],
    }
}

/// Angle from one normal to another, about an axis, in radians.
fn turn([from, to]: [DVec3; 2], axis: DVec3) -> f64 {
    axis.dot(from.cross(to)).atan2(from.dot(to))
}
