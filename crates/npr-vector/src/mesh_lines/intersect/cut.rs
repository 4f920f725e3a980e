//! How two faces cut each other, decided exactly.

use super::side::{Side, side};
use npr_core::geometry::NONE;
use npr_mesh::half_edge::HalfEdgeMesh;

/// Most faces without area that are crossed to learn where a surface goes on behind an edge.
const SLIVER_STEPS: u32 = 4;

/// An end of a segment, and the key that segments share which go on from there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct End {
    /// An edge and the face that it pierces, or a vertex and [`NONE`].
    pub(super) key: [u32; 2],
    pub(super) edge: u32,
    pub(super) t: f32,
    /// Whether the edge goes through the face; false at a shared vertex, and where the edge lies in the face's plane.
    pub(super) pierces: bool,
}

/// The straight piece that two faces share.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Segment {
    /// The two faces, the lower first.
    pub(super) faces: [u32; 2],
    pub(super) ends: [End; 2],
    /// Whether the surfaces only touch along the piece.
    pub(super) contact: bool,
}

/// The piece that two faces, the lower first, have in common; `None` where they share an edge or miss each other.
pub(super) fn cut(shape: &HalfEdgeMesh, faces: [u32; 2]) -> Option<Segment> {
    let pair = faces.map(|face| Triangle::new(shape, face));
    let mut shared = (0..3).filter(|i| pair[1].corners.contains(&pair[0].corners[*i]));
    let (corner, second) = (shared.next(), shared.next());
    if second.is_some() || !pair.iter().all(Triangle::is_finite) {
        return None;
    }
    let first = pair[0].against(&pair[1]);
    if first.agree() {
        return None;
    }
    let against = [first, pair[1].against(&pair[0])];
    let ends = common_ends(&pair, &against, corner)?;
    let touches = |me: usize| pair[me].touches(&against[me], &pair[1 - me]);
    Some(Segment {
        faces,
        ends,
        contact: against.iter().all(Sides::lie_flat) || touches(0) || touches(1),
    })
}

/// The two ends of the common piece; moved by infinitesimals, two faces share either none or both.
fn common_ends(
    pair: &[Triangle; 2],
    against: &[Sides; 2],
    corner: Option<usize>,
) -> Option<[End; 2]> {
    if against[1].agree() {
        return None;
    }

    // Gather where edges of one pierce the other, and the corner that both share.
    let mut ends = [None; 2];
    let mut count = 0;
    let edges = [(0, 1), (1, 0)]
        .into_iter()
        .flat_map(|(me, other)| pair[me].ends(&against[me], &pair[other]));
    for end in edges.chain(corner.map(|corner| pair[0].end_at(corner))) {
        if let Some(slot) = ends.get_mut(count) {
            *slot = Some(end);
        }
        count += 1;
    }
    debug_assert!(
        count == 2 || count == usize::from(corner.is_some()),
        "ends come in pairs"
    );

    // Keep what has two ends.
    let [Some(first), Some(last)] = ends else {
        return None;
    };
    Some([first, last])
}

struct Triangle<'a> {
    shape: &'a HalfEdgeMesh,
    face: u32,
    corners: [u32; 3],
}

/// Sides of a triangle's corners against another's plane; `None` for a shared corner.
struct Sides([Option<Side>; 3]);

impl Sides {
    /// Whether all corners lie on one side.
    fn agree(&self) -> bool {
        let mut known = self.0.iter().flatten().map(|side| side.is_positive());
        let first = known.next();
        known.all(|side| Some(side) == first)
    }

    fn is_flat(&self, corner: usize) -> bool {
        self.0[corner].is_none_or(Side::is_flat)
    }

    fn lie_flat(&self) -> bool {
        (0..3).all(|corner| self.is_flat(corner))
    }

    /// The one corner that is not in the plane, if the other two are.
    fn apex(&self) -> Option<(usize, Side)> {
        let mut off = (0..3).filter(|corner| !self.is_flat(*corner));
        let corner = off.next()?;
        off.next().is_none().then_some(())?;
        Some((corner, self.0[corner]?))
    }
}

impl<'a> Triangle<'a> {
    fn new(shape: &'a HalfEdgeMesh, face: u32) -> Self {
        Self {
            shape,
            face,
            corners: shape.faces[face as usize],
        }
    }

    fn is_finite(&self) -> bool {
        let points = self.corners.map(|v| self.shape.positions[v as usize]);
        points.iter().flatten().all(|v| v.is_finite())
    }

    /// Side of a vertex against this triangle's plane.
    fn side(&self, vertex: u32) -> Side {
        let [a, b, c] = self.corners;
        side(&self.shape.positions, [a, b, c, vertex])
    }

    fn against(&self, plane: &Triangle) -> Sides {
        let side = |v: u32| (!plane.corners.contains(&v)).then(|| plane.side(v));
        Sides(self.corners.map(side))
    }

    /// Where edges of this triangle, without a shared corner, go through another.
    fn ends(&self, sides: &Sides, through: &Triangle) -> impl Iterator<Item = End> {
        (0..3).filter_map(|i| {
            // Keep sides whose ends lie on both sides of the other plane, and that go through the triangle.
            let j = (i + 1) % 3;
            let (tail, head) = (sides.0[i]?, sides.0[j]?);
            let ends = [self.corners[i], self.corners[j]];
            if tail.is_positive() == head.is_positive() || !through.is_pierced_by(ends) {
                return None;
            }

            // Name the place by its edge, measured from the lower vertex, so that neighbours agree.
            let edge = self.shape.edge_of[3 * self.face as usize + i];
            let (low, high) = if ends[0] < ends[1] {
                (tail, head)
            } else {
                (head, tail)
            };
            Some(End {
                key: [edge, through.face],
                edge,
                t: Side::crossing(low, high),
                pierces: !(tail.is_flat() && head.is_flat()),
            })
        })
    }

    /// Whether the line through two vertices on different sides of the plane passes all edges the same way around.
    fn is_pierced_by(&self, [a, b]: [u32; 2]) -> bool {
        let [c, d, e] = self.corners;
        let [first, second, third] = [[c, d], [d, e], [e, c]]
            .map(|[from, to]| side(&self.shape.positions, [a, b, from, to]).is_positive());
        first == second && second == third
    }

    /// The end of a piece that starts in a corner.
    fn end_at(&self, corner: usize) -> End {
        let half_edge = 3 * self.face as usize + corner;
        let [tail, head] = self.shape.ends_of_half_edge(half_edge as u32);
        End {
            key: [tail, NONE],
            edge: self.shape.edge_of[half_edge],
            t: if tail < head { 0.0 } else { 1.0 },
            pierces: false,
        }
    }

    /// Whether an edge lies in the other's plane, and the surface does not continue behind the plane.
    fn touches(&self, sides: &Sides, plane: &Triangle) -> bool {
        let Some((apex, side)) = sides.apex() else {
            return false;
        };
        let half_edge = 3 * self.face + (apex as u32 + 1) % 3;
        !self.goes_behind(half_edge, side.is_positive(), plane, SLIVER_STEPS)
    }

    /// Whether a face across a half-edge, or behind faces without area there, reaches the other side of the plane.
    fn goes_behind(&self, half_edge: u32, front: bool, plane: &Triangle, steps: u32) -> bool {
        let shape = self.shape;
        let across = shape.sides(shape.edge_of[half_edge as usize]).iter();
        across.filter(|other| **other != half_edge).any(|other| {
            let apex = shape.opposite(*other);
            let side = (!plane.corners.contains(&apex)).then(|| plane.side(apex));
            match side.filter(|side| !side.is_flat()) {
                Some(side) => side.is_positive() != front,
                None if steps > 0 && is_degenerate(shape, *other / 3) => {
                    let next = HalfEdgeMesh::following(*other);
                    [next, HalfEdgeMesh::following(next)]
                        .into_iter()
                        .any(|edge| self.goes_behind(edge, front, plane, steps - 1))
                }
                None => false,
            }
        })
    }
}

/// Whether all corners lie on one line.
fn is_degenerate(shape: &HalfEdgeMesh, face: u32) -> bool {
    let points = shape.faces[face as usize].map(|v| shape.positions[v as usize]);
    [[0, 1], [1, 2], [2, 0]].into_iter().all(|[i, j]| {
        let [a, b, c] = points.map(|p| robust::Coord { x: p[i], y: p[j] });
        robust::orient2d(a, b, c) == 0.0
    })
}
