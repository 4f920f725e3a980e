//! Coordinates of a triangle's corners from the angles of its nodes.

use glam::{BVec2, Vec2, Vec3};

use super::phases::Site;
use crate::direction_field::turned;

/// Coordinates of three corners, and how well they do.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Lifted {
    pub(crate) corners: [Vec2; 3],
    /// Whether a stroke ends inside, so that the coordinates do not fit those of neighbours.
    pub(crate) singular: bool,
    /// Whether directions turn round inside.
    pub(crate) turning: bool,
    /// Mean over both coordinates of the length by which the gradient misses the wanted unit vector.
    pub(crate) gradient_error: f32,
    /// Area in square tiles.
    pub(crate) area: f32,
}

/// Coordinates of the triangle at `sites`, of which `phases` says the parts after the whole tiles.
///
/// `anchor` is the corner whose sense of direction holds for all. Coordinates change along each edge by the whole
/// number of tiles more or less that comes nearest to what the directions predict; both triangles beside an edge
/// come to the same result. Where the three changes do not add up to nothing, or directions turn round within the
/// triangle, the coordinates follow the prediction alone.
pub(crate) fn lift(sites: [Site; 3], phases: [Vec2; 3], anchor: usize) -> Lifted {
    let [first, second, third] = [0, 1, 2].map(|k| (anchor + k) % 3);
    let opposed = [first, second, third].map(|k| sites[first].opposes(&sites[k]));
    let turning = sites[second].opposes(&sites[third]) != (opposed[1] != opposed[2]);
    let site = |k: usize| sites[(anchor + k) % 3].reversed_if(opposed[k]);
    let phase = |k: usize| {
        let phase = phases[(anchor + k) % 3];
        if opposed[k] { -phase } else { phase }
    };
    let change = |a: usize, b: usize| {
        let tiles = site(a).tiles_to(&site(b));
        let rest = phase(b) - phase(a) - tiles;
        tiles + rest - rest.round()
    };
    let changes = [change(0, 1), change(0, 2)];
    let gap = changes[0] + change(1, 2) - changes[1];
    let open = gap.abs().cmpge(Vec2::splat(0.5));
    let wanted = Gradient::wanted([0, 1, 2].map(site));
    let steps = [1, 2].map(|k| site(k).position - site(0).position);
    let ways = [0, 1].map(|k| {
        let plain = wanted.of(steps[k]);
        Vec2::select(open | BVec2::splat(turning), plain, changes[k])
    });
    let found = Gradient::fitted(steps, ways);
    let mut corners = [Vec2::ZERO; 3];
    corners[first] = phase(0);
    corners[second] = phase(0) + ways[0];
    corners[third] = phase(0) + ways[1];
    let whole = ((corners[0] + corners[1] + corners[2]) / 3.0).round();
    Lifted {
        corners: corners.map(|corner| finite(corner - whole)),
        singular: turning || open.any(),
        turning,
        gradient_error: found.distance(&wanted),
        area: steps[0].cross(steps[1]).length() / 2.0,
    }
}

/// Numbers as they are; none in place of those that are none.
fn finite(corner: Vec2) -> Vec2 {
    Vec2::select(corner.is_finite_mask(), corner, Vec2::ZERO)
}

/// Gradients of both coordinates in the plane of a triangle.
struct Gradient {
    across: Vec3,
    along: Vec3,
}

impl Gradient {
    /// Unit vectors along the mean direction of the corners and perpendicular to it.
    fn wanted(sites: [Site; 3]) -> Self {
        let [a, b, c] = sites.map(|site| site.position);
        let facing: Vec3 = sites.iter().map(|site| site.normal).sum();
        let normal = (b - a).cross(c - a).try_normalize().unwrap_or(facing);
        // A folded face may lie against the sense of its corners.
        let normal = if normal.dot(facing) < 0.0 {
            -normal
        } else {
            normal
        };
        let directions = sites.map(|site| turned(site.direction, site.normal, normal));
        let along = directions.iter().sum::<Vec3>().try_normalize();
        let along = along.unwrap_or(directions[0]);
        Self {
            across: along.cross(normal),
            along,
        }
    }

    /// The gradients with which coordinates change by `ways` over two edges.
    fn fitted(steps: [Vec3; 2], ways: [Vec2; 2]) -> Self {
        let normal = steps[0].cross(steps[1]);
        let scale = 1.0 / normal.length_squared();
        let [one, other] = [
            steps[1].cross(normal) * scale,
            normal.cross(steps[0]) * scale,
        ];
        Self {
            across: one * ways[0].x + other * ways[1].x,
            along: one * ways[0].y + other * ways[1].y,
        }
    }

    fn of(&self, step: Vec3) -> Vec2 {
        Vec2::new(self.across.dot(step), self.along.dot(step))
    }

    fn distance(&self, wanted: &Self) -> f32 {
        let misses = [self.across - wanted.across, self.along - wanted.along];
        (misses[0].length() + misses[1].length()) / 2.0
    }
}
