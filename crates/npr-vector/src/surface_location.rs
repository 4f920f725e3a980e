//! What of a shape a piece of line lies on: where colours and widths along it are read.

use glam::DVec3;
use npr_core::geometry::NONE;
use npr_mesh::half_edge::HalfEdgeMesh;

/// The mesh edge that a piece of line runs along, or the face that it crosses.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SurfaceLocation {
    /// The edge.
    pub edge: u32,
    /// The face; [`NONE`] where the piece runs along the edge.
    pub face: u32,
}

impl Default for SurfaceLocation {
    fn default() -> Self {
        Self::NOWHERE
    }
}

impl SurfaceLocation {
    /// That of lines which lie on no shape.
    pub const NOWHERE: Self = Self {
        edge: NONE,
        face: NONE,
    };

    /// Along an edge.
    pub fn along(edge: u32) -> Self {
        Self { edge, face: NONE }
    }

    /// Whether it is that of a line which lies on no shape.
    pub fn is_nowhere(&self) -> bool {
        *self == Self::NOWHERE
    }

    /// The face that the piece crosses, if it does not run along an edge.
    pub fn crossed_face(&self) -> Option<u32> {
        (self.face != NONE).then_some(self.face)
    }

    /// The place on the location that is nearest to a point of its line: vertices, and how much each of them counts
    /// there.
    ///
    /// Shares lie in 0..1 and have the sum 1. Along an edge the third counts nothing.
    pub fn place(&self, shape: &HalfEdgeMesh, world: DVec3) -> ([u32; 3], [f64; 3]) {
        let vertices = self.vertices(shape);
        let corners = vertices.map(|vertex| shape.point(vertex));
        if self.crossed_face().is_some() {
            return (vertices, shares_in_face(corners, world));
        }
        let t = share_along([corners[0], corners[1]], world);
        (vertices, [1.0 - t, t, 0.0])
    }

    /// The vertices that [`Self::place`] measures places by: the corners of the face, or the ends of the edge, of
    /// which the second comes twice.
    pub fn vertices(&self, shape: &HalfEdgeMesh) -> [u32; 3] {
        match self.crossed_face() {
            Some(face) => shape.faces[face as usize],
            None => {
                let [low, high] = shape.ends(self.edge);
                [low, high, high]
            }
        }
    }
}

/// Where between two points a third lies nearest: 0 at the first, 1 at the second.
pub fn share_along([from, to]: [DVec3; 2], world: DVec3) -> f64 {
    let along = to - from;
    let t = (world - from).dot(along) / along.length_squared();
    if t.is_finite() {
        t.clamp(0.0, 1.0)
    } else {
        0.0
    }
}

/// How much each corner of a triangle counts at a point in its plane; of points outside, at a place on its border.
/// Faces without an area are their longest side.
fn shares_in_face(corners: [DVec3; 3], world: DVec3) -> [f64; 3] {
    let [a, b, c] = corners;
    let across = (b - a).cross(c - a);
    let part = |from: DVec3, to: DVec3| (from - world).cross(to - world).dot(across);
    let parts = [part(b, c), part(c, a), part(a, b)].map(|part| part.max(0.0));
    let whole: f64 = parts.iter().sum();
    let shares = parts.map(|part| part / whole);
    if whole.is_finite() && shares.iter().all(|share| share.is_finite()) {
        return shares;
    }
    let length = |i: usize| (corners[(i + 1) % 3] - corners[i]).length_squared();
    let side = (0..3).fold(0, |best, i| if length(i) > length(best) { i } else { best });
    let t = share_along([corners[side], corners[(side + 1) % 3]], world);
    let mut shares = [0.0; 3];
    (shares[side], shares[(side + 1) % 3]) = (1.0 - t, t);
    shares
}
