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

/// How far from an edge a walk looks around, in the width of the widest rounding. Roundings are looked for by three
/// widths, each twice as far as one of these and as far as the next: a narrow one has flat sides only nearby.
const LOOKS: [f64; 4] = [0.125, 0.25, 0.5, 1.0];

/// Fold from which an edge can be the middle of a rounding, as a cosine: 4 degrees.
const LEAST_FOLD_COS: f32 = 0.997_56;

/// Share of the mean bend of the slightest and widest rounding that its middle has at least.
const BEND_SHARE: f64 = 0.5;

/// Share of the least turn that an edge and one of its sides take at least.
const SIDE_SHARE: f64 = 0.25;

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

/// The normals that [`rounded_edges`] asks for; none where [`Creases::round`] is 0 and no rounding is a line.
pub fn rounding_normals(shape: &HalfEdgeMesh, creases: Creases) -> Option<CornerNormals> {
    (creases.round > 0.0).then(|| CornerNormals::new(shape, creases))
}

/// The edges in the middle of narrow roundings, ascending.
///
/// A rounding turns by the angle of creases or more within [`Creases::round`] across, in the unit of positions: about
/// the edge's own direction, never back, and in its shading as well as in its faces. Limbs of coarse figures are no
/// roundings, as their shading turns all the way from one edge to the next. Beside it the surface is flat, compared
/// with that, as far again on both sides. Of the edges along it that one is taken at which half of the turn is reached.
/// Rows of them that are short are left out, and creases are none: they end the walk. `normals` are those of the same
/// creases ([`rounding_normals`]).
///
/// O(edges x faces across a rounding), parallel.
pub fn rounded_edges(shape: &HalfEdgeMesh, normals: &CornerNormals, creases: Creases) -> Vec<u32> {
    let surface = Surface {
        shape,
        normals,
        face_normals: face_normals(shape),
        creases,
        least_turn: f64::from(creases.cos).clamp(-1.0, 1.0).acos(),
        width: f64::from(creases.round),
    };
    let edges = (0..shape.edge_count() as u32)
        .into_par_iter()
        .with_min_len(1024)
        .filter(|edge| surface.is_rounded(*edge))
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
    /// Unit normal of every face; zero where it has no area.
    face_normals: Vec<DVec3>,
    creases: Creases,
    /// Angle by which a rounding turns at least.
    least_turn: f64,
    /// Width of the widest.
    width: f64,
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

/// What a walk from the middle of an edge meets at a distance from it.
#[derive(Clone, Copy, Default)]
struct Met {
    /// Angle that the faces turned by on the way, about the edge.
    turn: f64,
    /// Normal that shading has there.
    normal: DVec3,
}

impl Surface<'_> {
    fn is_rounded(&self, edge: u32) -> bool {
        // Take edges between two faces that fold as much as the middle of a rounding does.
        if self.shape.dihedral_cos[edge as usize] > LEAST_FOLD_COS || !self.is_passable(edge) {
            return false;
        }
        let &[left, right] = self.shape.sides(edge) else {
            return false;
        };
        let [tail, head] = self.ends(left);
        let axis = (head - tail).normalize_or_zero();
        let fold = turn([right, left].map(|side| self.face_normal(side / 3)), axis);
        let across = [left, right].map(|side| {
            let aside = self.shape.point(self.shape.opposite(side)) - tail;
            (aside - axis * aside.dot(axis)).length()
        });
        let bend = fold.abs() / (0.5 * (across[0] + across[1])).min(self.width);
        if bend < BEND_SHARE * self.least_turn / self.width {
            return false;
        }

        // Look at one side of it, and at the other where that has its share of a turn.
        let one = self.walk(left, axis);
        let most = one
            .iter()
            .map(|met| fold.signum() * met.turn)
            .fold(0.0, f64::max);
        if most + fold.abs() < SIDE_SHARE * self.least_turn {
            return false;
        }
        let other = self.walk(right, -axis);
        one.windows(2)
            .zip(other.windows(2))
            .any(|(left, right)| self.turns_round([left, right], fold, axis))
    }

    /// Whether there is a rounding with an edge in its middle that folds by `fold`, by what two walks met at half of
    /// its width and at all of it.
    fn turns_round(&self, [left, right]: [&[Met]; 2], fold: f64, axis: DVec3) -> bool {
        // Measure the turn within the width: of the faces, and of the shading, about the edge.
        let sign = fold.signum();
        let sides = [left, right].map(|met| sign * met[0].turn);
        let fold = fold.abs();
        let faces = sides[0] + fold + sides[1];
        let shading = sign * turn([right[0].normal, left[0].normal], axis);
        let least = self.least_turn;
        if !(faces >= least && shading >= SHADING_SHARE * least)
            || sides.iter().any(|side| *side < -BACK_SHARE * faces)
        {
            return false;
        }

        // See that it turns about the edge, and that its sides are flat.
        let about = right[0].normal.cross(left[0].normal).normalize_or_zero();
        let beside = [left, right].map(|met| met[0].normal.angle_between(met[1].normal));
        if about.dot(axis).abs() < ALONG_COS || !beside.iter().all(|b| *b <= BESIDE_SHARE * shading)
        {
            return false;
        }

        // See that half of the turn is reached here; of two edges beside the middle face one is taken.
        let sides = [left, right].map(|met| sign * met[1].turn);
        let uneven = (sides[0] - sides[1]).abs();
        if (uneven - fold).abs() > 1e-3 * faces {
            return uneven < fold;
        }
        let [outer, inner] = match sides[0] > sides[1] {
            true => [right[1].normal, left[1].normal],
            false => [left[1].normal, right[1].normal],
        };
        outer.dot(FIRST) > inner.dot(FIRST)
    }

    /// Walks from the middle of a half-edge straight over the surface, and looks around at [`LOOKS`]; where the walk
    /// ends before, the rest is as there.
    fn walk(&self, start: u32, axis: DVec3) -> [Met; LOOKS.len()] {
        let [tail, head] = self.ends(start);
        let normal = self.face_normal(start / 3);
        let mut step = Step {
            side: start,
            at: 0.5 * (tail + head),
            ahead: normal.cross((head - tail).normalize_or_zero()),
            normal,
        };
        let mut met = [Met::default(); LOOKS.len()];
        let mut looked = 0;
        let mut turned = 0.0;
        let mut walked = 0.0;
        for _ in 0..WALK_LIMIT {
            // Cross the face, and look around in it.
            let Some((out, leave)) = self.exit(&step) else {
                break;
            };
            let length = leave.distance(step.at);
            while looked < LOOKS.len() && walked + length >= LOOKS[looked] * self.width {
                let point = step.at + step.ahead * (LOOKS[looked] * self.width - walked);
                met[looked] = Met {
                    turn: turned,
                    normal: self.shading(step.side / 3, point),
                };
                looked += 1;
            }
            walked += length;
            step.at = leave;
            if looked == LOOKS.len() {
                break;
            }

            // Turn into the next face, unless the surface ends.
            let next = self.shape.twins[out as usize];
            if next == NONE || !self.is_passable(self.shape.edge_of[out as usize]) {
                break;
            }
            let [a, b] = self.ends(out);
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
        met[looked..].fill(Met {
            turn: turned,
            normal: self.shading(step.side / 3, step.at),
        });
        met
    }

    /// The half-edge by which a walk leaves its face, and where.
    fn exit(&self, step: &Step) -> Option<(u32, DVec3)> {
        let first = HalfEdgeMesh::following(step.side);
        let ways = [first, HalfEdgeMesh::following(first)].map(|half_edge| {
            let [a, b] = self.ends(half_edge);
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
        self.face_normals[face as usize]
    }

    /// Tail and head of a half-edge.
    fn ends(&self, half_edge: u32) -> [DVec3; 2] {
        let ends = self.shape.ends_of_half_edge(half_edge);
        ends.map(|vertex| self.shape.point(vertex))
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

fn face_normals(shape: &HalfEdgeMesh) -> Vec<DVec3> {
    let normal = |face: &[u32; 3]| {
        let [a, b, c] = face.map(|vertex| shape.point(vertex));
        (b - a).cross(c - a).normalize_or_zero()
    };
    shape
        .faces
        .par_iter()
        .with_min_len(4096)
        .map(normal)
        .collect()
}

/// Angle from one normal to another, about an axis, in radians.
fn turn([from, to]: [DVec3; 2], axis: DVec3) -> f64 {
    axis.dot(from.cross(to)).atan2(from.dot(to))
}
