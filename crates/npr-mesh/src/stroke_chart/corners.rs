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
pub(crate) fn lift(mut sites: [Site; 3], mut phases: [Vec2; 3], anchor: usize) -> Lifted {
    // Start from the corner that all neighbours agree on.
    sites.rotate_left(anchor);
    phases.rotate_left(anchor);
    let turning = turn_alike(&mut sites, &mut phases);

    // Find the whole tiles between corners.
    let change = |from: usize, to: usize| {
        let tiles = sites[from].tiles_to(&sites[to]);
        let rest = phases[to] - phases[from] - tiles;
        tiles + rest - rest.round()
    };
    let changes = [change(0, 1), change(0, 2)];
    let gap = changes[0] + change(1, 2) - changes[1];
    let torn = gap.abs().cmpge(Vec2::splat(0.5)) | BVec2::splat(turning);

    // Where the changes do not close, follow the prediction.
    let wanted = Gradient::wanted(&sites);
    let steps = [1, 2].map(|k| sites[k].position - sites[0].position);
    let changes = [0, 1].map(|k| Vec2::select(torn, wanted.of(steps[k]), changes[k]));

    // Place the corners near the origin, in the triangle's own order.
    let mut corners = [Vec2::ZERO, changes[0], changes[1]].map(|change| phases[0] + change);
    let whole = ((corners[0] + corners[1] + corners[2]) / 3.0).round();
    corners.rotate_right(anchor);
    Lifted {
        corners: corners.map(|corner| finite(corner - whole)),
        singular: torn.any(),
        turning,
        gradient_error: Gradient::fitted(steps, changes).distance(&wanted),
        area: steps[0].cross(steps[1]).length() / 2.0,
    }
}

/// Brings all corners to the sense of the first; tells whether the other two disagree even so.
fn turn_alike(sites: &mut [Site; 3], phases: &mut [Vec2; 3]) -> bool {
    for k in [1, 2] {
        if sites[0].opposes(&sites[k]) {
            sites[k] = sites[k].reversed_if(true);
            phases[k] = -phases[k];
        }
    }
    sites[1].opposes(&sites[2])
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
    fn wanted(sites: &[Site; 3]) -> Self {
        let [a, b, c] = [0, 1, 2].map(|k| sites[k].position);
        let facing: Vec3 = sites.iter().map(|site| site.normal).sum();
        let normal = (b - a).cross(c - a).try_normalize().unwrap_or(facing);
        // A folded face may lie against the sense of its corners.
        let normal = if normal.dot(facing) < 0.0 {
            -normal
        } else {
            normal
        };
        let directions = [0, 1, 2].map(|k| turned(sites[k].direction, sites[k].normal, normal));
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
