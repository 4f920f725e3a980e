//! The faces of a shape in a bounding volume hierarchy, and how many of them hide a point.

use crate::project::Projector;
use glam::{DVec3, Vec4};
use npr_mesh::half_edge::HalfEdgeMesh;
use obvhs::Boundable;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::node::Bvh2Node;
use obvhs::ploc::{PlocBuilder, PlocSearchDistance, SortPrecision};
use rayon::prelude::*;
use std::ops::Range;

/// How much nearer than a point a face must be to hide it, as a fraction of the way from the eye.
///
/// Positions are `f32`, so faces that touch in the scene lie up to about this far apart; a smaller fraction
/// would break lines on contacts into dashes.
pub const NEARER: f64 = 2.5e-7;

/// Distance from an end of an edge, as a share of it, within which a face that the edge goes through touches the end.
pub(crate) const NEAR_SHARE: f64 = 1e-6;

/// How far single precision may move a box against a way, as a share of the largest coordinate.
const ROUNDING: f32 = 5e-7;

/// Number of nodes up to which it costs less to ask whether boxes meet than whether the way itself passes.
const FEW_NODES: usize = 64;

/// A hierarchy over all faces of a shape, for any number of views.
#[derive(Clone)]
pub struct FaceTree {
    /// A leaf holds `prim_count` faces that follow each other, from the face `first_index` on.
    pub(crate) bvh: Bvh2,
    /// Largest coordinate, for the rounding of box tests.
    extent: f32,
}

impl std::fmt::Debug for FaceTree {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "FaceTree of {} nodes", self.bvh.nodes.len())
    }
}

/// Most faces in a leaf.
const LEAF: usize = 4;

/// How much larger than two boxes together one around both may be for their faces to share a leaf, in surface.
const LOOSE: f32 = 2.0;

/// Faces that follow each other, with a box around them.
#[derive(Clone, Copy)]
struct Clump {
    bounds: Aabb,
    first: u32,
    count: u32,
}

impl Boundable for Clump {
    fn aabb(&self) -> Aabb {
        self.bounds
    }
}

impl Clump {
    /// Both in one, where that leaves the box close.
    fn joined(&self, next: &Self) -> Option<Self> {
        let bounds = self.bounds.union(&next.bounds);
        let apart = self.bounds.half_area() + next.bounds.half_area();
        (bounds.half_area() <= LOOSE * apart).then_some(Self {
            bounds,
            first: self.first,
            count: self.count + next.count,
        })
    }

    /// Up to [`LEAF`] faces in clumps; files mostly list neighbours one after the other.
    fn of(shape: &HalfEdgeMesh, first: u32) -> impl Iterator<Item = Self> {
        let mut clumps = [None; LEAF];
        for (clump, face) in clumps.iter_mut().zip(first..shape.faces.len() as u32) {
            let corners = shape.faces[face as usize].map(|v| shape.positions[v as usize]);
            *clump = Some(Self {
                bounds: box_of(corners),
                first: face,
                count: 1,
            });
        }
        for [one, other] in [[0, 1], [2, 3], [0, 2]] {
            if let (Some(a), Some(b)) = (clumps[one], clumps[other])
                && a.first + a.count == b.first
                && let Some(joined) = a.joined(&b)
            {
                (clumps[one], clumps[other]) = (Some(joined), None);
            }
        }
        clumps.into_iter().flatten()
    }
}

/// The straight way from the eye to a point.
#[derive(Debug, Clone, Copy)]
pub struct Sight {
    /// Where the way starts.
    pub eye: [f64; 3],
    /// The point looked at.
    pub point: [f64; 3],
    /// Faces hide the point only if it lies farther than this behind their plane; 0 for points of faces themselves.
    pub touch: f64,
}

impl FaceTree {
    /// Builds the hierarchy; O(n log n), on all threads.
    pub fn new(shape: &HalfEdgeMesh) -> Self {
        // Put neighbours into leaves.
        let starts = (0..shape.faces.len().div_ceil(LEAF) as u32)
            .into_par_iter()
            .with_min_len(1024);
        let clumps: Vec<Clump> = starts
            .flat_map_iter(|start| Clump::of(shape, LEAF as u32 * start))
            .collect();
        let extent = clumps.iter().fold(0.0_f32, |extent, clump| {
            let [low, high] = bounds(&clump.bounds);
            extent.max(low.abs().max(high.abs()).max_element())
        });

        // Sort the leaves.
        let indices = (0..clumps.len() as u32).collect();
        let mut bvh = PlocBuilder::new().build(
            PlocSearchDistance::VeryLow,
            &clumps,
            indices,
            SortPrecision::U64,
            0,
        );

        // Let them name faces.
        for leaf in bvh.nodes.iter_mut().filter(|node| node.is_leaf()) {
            let clump = &clumps[bvh.primitive_indices[leaf.first_index as usize] as usize];
            (leaf.first_index, leaf.prim_count) = (clump.first, clump.count);
        }
        bvh.primitive_indices = Vec::new();
        Self { bvh, extent }
    }

    /// Number of faces between the eye and a point, without those in `skip`; counting stops at `limit`.
    ///
    /// A face counts where the way passes through it before [`NEARER`] of the point; of two faces that share an edge
    /// that it passes, one does. About O(log n) for a point on an open surface.
    pub fn occluders(&self, shape: &HalfEdgeMesh, sight: &Sight, skip: &[u32], limit: u32) -> u32 {
        let (eye, point) = (DVec3::from(sight.eye), DVec3::from(sight.point));
        let direction = point - eye;
        if limit == 0 || !direction.is_finite() {
            return 0;
        }
        let mut count = 0;
        self.along(eye, direction, |face| {
            if !skip.contains(&face) && hides(shape, face, (eye, direction), sight.touch) {
                count += 1;
            }
            count < limit
        });
        count
    }

    /// A face between the eye and a point, other than those in `skip`; of several, any.
    ///
    /// `last` is tried first, since what hides a point mostly hides the next one too.
    pub fn hider(
        &self,
        shape: &HalfEdgeMesh,
        sight: &Sight,
        skip: &[u32],
        last: Option<u32>,
    ) -> Option<u32> {
        let (eye, point) = (DVec3::from(sight.eye), DVec3::from(sight.point));
        let direction = point - eye;
        if !direction.is_finite() {
            return None;
        }

        // Try the face that hid the place before.
        let is_hider =
            |face: &u32| !skip.contains(face) && hides(shape, *face, (eye, direction), sight.touch);
        let mut found = last.filter(is_hider);

        // Look along the sight for another.
        if found.is_none() {
            self.along(eye, direction, |face| {
                found = Some(face).filter(is_hider);
                found.is_none()
            });
        }
        found
    }

    /// The face that shows at a place of the picture, and its depth.
    pub fn face_at(
        &self,
        shape: &HalfEdgeMesh,
        projector: &Projector,
        place: [f64; 2],
    ) -> Option<(u32, f64)> {
        let point = projector.unproject(place, projector.far());
        let start = projector.sight_start(point);
        let sight = Sight {
            eye: start.to_array(),
            point: point.to_array(),
            touch: 0.0,
        };
        let (face, share) = self.first_face(shape, &sight, 1.0)?;
        Some((face, projector.depth(start.lerp(point, share))))
    }

    /// The first face on the way from the eye through a point and beyond, with the place on the way: 1 at the point.
    pub fn first_face(
        &self,
        shape: &HalfEdgeMesh,
        sight: &Sight,
        reach: f64,
    ) -> Option<(u32, f64)> {
        let eye = DVec3::from(sight.eye);
        let direction = (DVec3::from(sight.point) - eye) * reach;
        let mut first: Option<(u32, f64)> = None;
        self.along(eye, direction, |face| {
            if let Some(at) = crossing(shape, face, eye, direction) {
                let nearer = first.is_none_or(|(other, least)| (at, face) < (least, other));
                if (0.0..=1.0).contains(&at) && nearer {
                    first = Some((face, at));
                }
            }
            true
        });
        first.map(|(face, at)| (face, at * reach))
    }

    /// Where the line between two vertices goes through faces that it does not touch: shares 0..1 from the first,
    /// ascending, and a hair before and beyond.
    pub fn piercings(&self, shape: &HalfEdgeMesh, [from, to]: [u32; 2]) -> Vec<f64> {
        let touches = |face: u32| {
            let corners = shape.faces[face as usize];
            corners.contains(&from) || corners.contains(&to)
        };
        self.piercings_between(shape, [from, to].map(|v| shape.point(v)), touches)
    }

    /// Where the way between two points goes through faces that are not in `skip`: shares 0..1 from the first,
    /// ascending, and a hair before and beyond.
    pub fn piercings_between(
        &self,
        shape: &HalfEdgeMesh,
        [from, to]: [DVec3; 2],
        skip: impl Fn(u32) -> bool,
    ) -> Vec<f64> {
        let direction = to - from;
        let mut places = Vec::new();
        self.near(from, to, |face| {
            if !skip(face) {
                let place = crossing(shape, face, from, direction);
                places.extend(place.filter(|t| (-NEAR_SHARE..=1.0 + NEAR_SHARE).contains(t)));
            }
        });
        places.sort_by(f64::total_cmp);
        places
    }

    /// The faces of a leaf.
    pub(crate) fn faces_of(leaf: &Bvh2Node) -> Range<u32> {
        leaf.first_index..leaf.first_index + leaf.prim_count
    }

    /// Calls `visit` for every face whose box the short way between two points passes, and perhaps for others near it.
    fn near(&self, from: DVec3, to: DVec3, mut visit: impl FnMut(u32)) {
        let nodes = &self.bvh.nodes;
        if nodes.is_empty() {
            return;
        }
        let around = Around::new([from, to], self.extent);
        let slab = Slab::new(from, to - from, self.extent);
        let mut stack = Vec::with_capacity(64);
        stack.push(0);
        let mut count = 0_usize;
        while let Some(index) = stack.pop() {
            let node = &nodes[index as usize];
            if node.is_leaf() {
                Self::faces_of(node).for_each(&mut visit);
                continue;
            }
            count += 1;
            for child in [node.first_index, node.first_index + 1] {
                let bounds = nodes[child as usize].aabb();
                let passes = || count < FEW_NODES || slab.enter(bounds).is_finite();
                if around.meets(bounds) && passes() {
                    stack.push(child);
                }
            }
        }
    }

    /// Calls `visit` for every face whose box the way passes, until it returns false.
    fn along(&self, eye: DVec3, direction: DVec3, mut visit: impl FnMut(u32) -> bool) {
        let nodes = &self.bvh.nodes;
        if nodes.is_empty() {
            return;
        }
        let slab = Slab::new(eye, direction, self.extent);
        let mut stack = Vec::with_capacity(64);
        if slab.enter(nodes[0].aabb()).is_finite() {
            stack.push(0);
        }
        while let Some(index) = stack.pop() {
            let node = &nodes[index as usize];
            if node.is_leaf() {
                if !Self::faces_of(node).all(&mut visit) {
                    return;
                }
                continue;
            }
            let [one, other] = [node.first_index, node.first_index + 1];
            let enter = |child: u32| slab.enter(nodes[child as usize].aabb());
            let (a, b) = (enter(one), enter(other));
            // The nearer child comes off the stack first: what hides a point is often close to the eye.
            let (far, near) = if a <= b {
                ((b, other), (a, one))
            } else {
                ((a, one), (b, other))
            };
            for (enter, child) in [far, near] {
                if enter.is_finite() {
                    stack.push(child);
                }
            }
        }
    }
}

/// The box of a face.
pub(crate) fn box_of(corners: [[f32; 3]; 3]) -> Aabb {
    let [a, b, c] = corners.map(|[x, y, z]| Vec4::new(x, y, z, 0.0));
    bytemuck::cast([a.min(b).min(c), a.max(b).max(c)])
}

/// Lowest and highest corner; the fourth components mean nothing.
///
/// They are read as bytes, because the hierarchy's crate may use another version of the vector types.
pub(crate) fn bounds(b: &Aabb) -> [Vec4; 2] {
    let [low, high]: [Vec4; 2] = bytemuck::cast(*b);
    [low.with_w(0.0), high.with_w(0.0)]
}

/// A box around a way, wider by as far as single precision may have moved other boxes against it.
struct Around {
    low: Vec4,
    high: Vec4,
}

impl Around {
    fn new(ends: [DVec3; 2], extent: f32) -> Self {
        let [a, b] = ends.map(|end| end.as_vec3().extend(0.0));
        let reach = a.abs().max(b.abs()).max_element().max(extent);
        let pad = Vec4::splat(reach * ROUNDING);
        Self {
            low: a.min(b) - pad,
            high: a.max(b) + pad,
        }
    }

    fn meets(&self, b: &Aabb) -> bool {
        let [low, high] = bounds(b);
        (self.low.cmple(high) & low.cmple(self.high)).all()
    }
}

/// A box test that rounding never makes miss a box.
struct Slab {
    /// Subtracted from the lowest and the highest corner of boxes: the origin, moved by as far as single precision
    /// may have moved a box against it.
    origins: [Vec4; 2],
    inverse: Vec4,
}

impl Slab {
    fn new(eye: DVec3, direction: DVec3, extent: f32) -> Self {
        let origin = eye.as_vec3().extend(0.0);
        let inverse = direction.to_array().map(|d| {
            let d = d as f32;
            // Infinite inverses turn 0 into NaN at the faces of boxes.
            if d.abs() < 1e-30 {
                1e30_f32.copysign(d)
            } else {
                1.0 / d
            }
        });
        let reach = origin.abs().max_element().max(extent);
        let [x, y, z] = inverse;
        let pad = Vec4::splat(reach * ROUNDING);
        Self {
            origins: [origin + pad, origin - pad],
            inverse: Vec4::new(x, y, z, 0.0),
        }
    }

    /// Where the way enters a box, as a share 0..1; infinite where it misses it.
    fn enter(&self, b: &Aabb) -> f32 {
        // What the fourth components of the box hold is never read.
        let [low, high]: [Vec4; 2] = bytemuck::cast(*b);
        let low = (low - self.origins[0]) * self.inverse;
        let high = (high - self.origins[1]) * self.inverse;
        // The fourth components bound the way itself: it starts at 0 and ends at 1.
        let enter = low.min(high).with_w(0.0).max_element();
        let leave = low.max(high).with_w(1.0).min_element();
        if enter <= leave * 1.000_001 {
            enter
        } else {
            f32::INFINITY
        }
    }
}

/// Whether a face is crossed on the way from the eye, and the point at its end lies farther than `touch` behind its
/// plane.
fn hides(shape: &HalfEdgeMesh, face: u32, (eye, direction): (DVec3, DVec3), touch: f64) -> bool {
    let at = crossing(shape, face, eye, direction);
    at.is_some_and(|at| {
        let is_before = at > NEARER && at < 1.0 - NEARER;
        is_before && (touch == 0.0 || (1.0 - at) * slope(shape, face, direction) > touch)
    })
}

/// Whether a face lies between the eye and a point.
pub(crate) fn hides_alone(shape: &HalfEdgeMesh, face: u32, sight: &Sight) -> bool {
    let (eye, point) = (DVec3::from(sight.eye), DVec3::from(sight.point));
    hides(shape, face, (eye, point - eye), sight.touch)
}

/// The space that a face hides from an eye: a plane and the three sides of the cone behind the face.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Barrier {
    corner: DVec3,
    normal: DVec3,
    /// Normals of the planes through the eye and a side.
    sides: [DVec3; 3],
    /// Whether each side leads from the vertex with the lesser number to that with the greater.
    rises: [bool; 3],
}

impl Barrier {
    /// The barrier of a face.
    pub(crate) fn of(shape: &HalfEdgeMesh, face: u32, eye: DVec3) -> Self {
        let [i, j, k] = shape.faces[face as usize];
        let corners = [shape.point(i), shape.point(j), shape.point(k)];
        let from_eye = corners.map(|corner| corner - eye);
        let side = |to: usize, from: usize| from_eye[to].cross(from_eye[from]);
        Self {
            corner: corners[0],
            normal: (corners[1] - corners[0]).cross(corners[2] - corners[0]),
            sides: [side(2, 1), side(0, 2), side(1, 0)],
            rises: [j < k, k < i, i < j],
        }
    }

    /// The part of a line that the face hides, in shares of the line in the world. `sights` lead to the line's ends;
    /// `other` is the barrier for the eye of the second sight.
    ///
    /// What [`FaceTree::occluders`] asks of one point holds where five or six numbers are positive, each of which
    /// changes evenly along the line: they are taken at its ends, so that the range costs as much as two points.
    pub(crate) fn hidden_range(&self, other: &Self, sights: &[Sight; 2]) -> Option<[f64; 2]> {
        let Self { corner, normal, .. } = *self;
        let eyes = [DVec3::from(sights[0].eye), DVec3::from(sights[1].eye)];
        let points = [DVec3::from(sights[0].point), DVec3::from(sights[1].point)];
        let before = [normal.dot(corner - eyes[0]), normal.dot(corner - eyes[1])];
        let behind = [
            normal.dot(points[0] - corner),
            normal.dot(points[1] - corner),
        ];
        // In parallel view all ways have one direction. Its length must not change along the line, or sides would not
        // change evenly.
        let mut ways = [points[0] - eyes[0], points[1] - eyes[1]];
        if sights[0].eye != sights[1].eye {
            ways = [ways[usize::from(ways[1].length_squared() > ways[0].length_squared())]; 2];
        }
        let reach = sights[0].touch * normal.length();
        // Seen from the front and from the back; in parallel view a face across the near plane may be both.
        for sign in [1.0, -1.0] {
            let mut range = [0.0, 1.0];
            let mut keep = |at: [f64; 2], holds_at_zero: bool| {
                let is_zero = at == [0.0; 2];
                is_zero && holds_at_zero || !is_zero && cut_range(&mut range, at)
            };
            let [before, behind] = [
                [before[0] * sign, before[1] * sign],
                [behind[0] * sign, behind[1] * sign],
            ];
            let is_behind = |i: usize| (1.0 - NEARER) * behind[i] - NEARER * before[i];
            let is_before = |i: usize| (1.0 - NEARER) * before[i] - NEARER * behind[i];
            if !keep([is_behind(0), is_behind(1)], false)
                || !keep([is_before(0), is_before(1)], false)
                || reach != 0.0 && !keep([behind[0] - reach, behind[1] - reach], false)
            {
                continue;
            }
            let mut passes = |side: usize| {
                let [first, second] = [self.sides[side], other.sides[side]];
                let at = [-sign * ways[0].dot(first), -sign * ways[1].dot(second)];
                keep(at, self.rises[side] == (sign < 0.0))
            };
            if passes(0) && passes(1) && passes(2) {
                return Some(range);
            }
        }
        None
    }
}

/// The part of a line that a face hides, in shares of the line in the world; `sights` lead to its ends.
pub(crate) fn hidden_range(
    shape: &HalfEdgeMesh,
    face: u32,
    sights: &[Sight; 2],
) -> Option<[f64; 2]> {
    let barriers = sights.map(|sight| Barrier::of(shape, face, DVec3::from(sight.eye)));
    barriers[0].hidden_range(&barriers[1], sights)
}

/// Cuts a range down to where a number is not negative. The number changes linearly and is given at shares 0 and 1;
/// returns false where nothing is left.
#[inline]
pub(crate) fn cut_range(range: &mut [f64; 2], [at_start, at_end]: [f64; 2]) -> bool {
    match (at_start >= 0.0, at_end >= 0.0) {
        (true, true) => {}
        (false, false) => return false,
        (true, false) => range[1] = range[1].min(at_start / (at_start - at_end)),
        (false, true) => range[0] = range[0].max(at_start / (at_start - at_end)),
    }
    range[0] < range[1]
}

/// How far a way leads away from the plane of a face; 0 for faces without area.
fn slope(shape: &HalfEdgeMesh, face: u32, direction: DVec3) -> f64 {
    let [a, b, c] = shape.faces[face as usize].map(|v| shape.point(v));
    (b - a)
        .cross(c - a)
        .normalize_or_zero()
        .dot(direction)
        .abs()
}

/// Where on the way from the eye, in units of `direction`, a face is crossed.
///
/// The side of each edge is the same number, but for its sign, seen from either of its faces: no way slips
/// through between two of them.
fn crossing(shape: &HalfEdgeMesh, face: u32, eye: DVec3, direction: DVec3) -> Option<f64> {
    let [a, b, c] = shape.faces[face as usize].map(|v| shape.point(v) - eye);
    let [i, j, k] = shape.faces[face as usize];
    // A way through an edge itself is on the side that the order of its vertices says, so of two faces it passes one.
    let left = |side: f64, from: u32, to: u32| side > 0.0 || (side == 0.0 && from < to);
    let u = direction.dot(c.cross(b));
    let v = direction.dot(a.cross(c));
    let is_left = left(u, j, k);
    if left(v, k, i) != is_left {
        return None;
    }
    let w = direction.dot(b.cross(a));
    let sum = u + v + w;
    if left(w, i, j) != is_left || sum == 0.0 {
        return None;
    }
    let place = (a * u + b * v + c * w) / sum;
    Some(place.dot(direction) / direction.length_squared())
}

#[cfg(test)]
mod tests {
    use super::*;
    use npr_mesh::testing::{crossing_soup, mapped, shape_of};
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(500))]

        /// The tree leaves out no face that a way goes through, be the way short or long and the faces few or many.
        #[test]
        fn piercings_are_those_of_all_faces(
            faces in 0_usize..1500, seed: u64, from in prop::array::uniform3(-1.0_f64..1.0),
            way in prop::array::uniform3(-1.0_f64..1.0), length in prop::sample::select(&[1e-3, 0.1, 2.0]),
            size in prop::sample::select(&[1e-3_f32, 1.0, 1e4]), skipped in 0_u32..7,
        ) {
            let shape = shape_of(&mapped(&crossing_soup(faces, seed), |p| p.map(|v| v * size)));
            let from = DVec3::from(from) * f64::from(size);
            let to = from + DVec3::from(way) * f64::from(size) * length;
            let skip = |face: u32| skipped > 0 && face % 7 == skipped;
            let found = FaceTree::new(&shape).piercings_between(&shape, [from, to], skip);

            let all = (0..shape.faces.len() as u32).filter(|face| !skip(*face));
            let places = all.filter_map(|face| crossing(&shape, face, from, to - from));
            let mut expected: Vec<f64> = places.filter(|at| (-NEAR_SHARE..=1.0 + NEAR_SHARE).contains(at)).collect();
            expected.sort_by(f64::total_cmp);
            prop_assert_eq!(found, expected);
        }
    }
}
