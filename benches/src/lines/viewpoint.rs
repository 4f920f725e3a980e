//! A camera in double precision, written apart from the one that draws.

use glam::DVec3;
use npr_core::camera::{Camera, Projection};

/// Share of the distance from eye to target under which a point counts as behind the eye.
const NEAREST: f64 = 1e-6;

/// A camera and a frame: where a point of the world falls, and from where it is seen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Viewpoint {
    eye: DVec3,
    right: DVec3,
    up: DVec3,
    forward: DVec3,
    /// Pixels for a unit at depth 1, or at any depth in parallel view.
    px_per_unit: f64,
    size: [f64; 2],
    parallel: bool,
    nearest: f64,
}

impl Viewpoint {
    /// The view of `camera` in a frame of `size` pixels.
    pub fn new(camera: &Camera, size: [u32; 2]) -> Self {
        // Build the axes of the picture in double precision.
        let [eye, target, up] = [camera.eye, camera.target, camera.up].map(wide);
        let forward = (target - eye).try_normalize().unwrap_or(DVec3::NEG_Z);
        let right = forward
            .cross(up)
            .try_normalize()
            .unwrap_or_else(|| forward.any_orthonormal_vector());

        // Scale lengths at distance 1, or at any distance in a parallel view.
        let size = size.map(f64::from);
        let (height, parallel) = match camera.projection {
            Projection::Perspective { fov_y } => {
                let half = f64::from(fov_y) / 2.0;
                (2.0 * libm::tan(half), false)
            }
            Projection::Parallel { height } => (f64::from(height), true),
        };
        Self {
            eye,
            right,
            up: right.cross(forward),
            forward,
            px_per_unit: size[1] / height,
            size,
            parallel,
            nearest: NEAREST * eye.distance(target),
        }
    }

    /// Width and height of the frame in pixels.
    pub fn size(&self) -> [f64; 2] {
        self.size
    }

    /// Distance along the view axis.
    pub fn depth(&self, point: DVec3) -> f64 {
        (point - self.eye).dot(self.forward)
    }

    /// Where a point falls, in pixels from the top left corner, y down.
    pub fn project(&self, point: DVec3) -> [f64; 2] {
        let from_eye = point - self.eye;
        let depth = if self.parallel {
            1.0
        } else {
            from_eye.dot(self.forward)
        };
        let px = self.px_per_unit / depth;
        [
            self.size[0] / 2.0 + px * from_eye.dot(self.right),
            self.size[1] / 2.0 - px * from_eye.dot(self.up),
        ]
    }

    /// The point at a depth that falls on a place: what [`Self::project`] undoes.
    pub fn point_at(&self, place: [f64; 2], depth: f64) -> DVec3 {
        let reach = if self.parallel { 1.0 } else { depth };
        let unit = reach / self.px_per_unit;
        let right = (place[0] - self.size[0] / 2.0) * unit;
        let up = (self.size[1] / 2.0 - place[1]) * unit;
        self.eye + self.forward * depth + self.right * right + self.up * up
    }

    /// Where the line of sight to a point starts, `reach` being larger than the scene.
    pub fn origin(&self, point: DVec3, reach: f64) -> DVec3 {
        if self.parallel {
            point - self.forward * reach
        } else {
            self.eye
        }
    }

    /// From a point towards the eye; any length.
    pub fn toward_eye(&self, point: DVec3) -> DVec3 {
        if self.parallel {
            -self.forward
        } else {
            self.eye - point
        }
    }

    /// The part of the segment from `a` to `b` that lies in the frame and before the eye, as two parameters.
    pub fn clip(&self, a: DVec3, b: DVec3) -> Option<[f64; 2]> {
        let [from, to] = [a, b].map(|point| self.inside(point));
        let mut kept = [0.0f64, 1.0f64];
        for (start, end) in from.into_iter().zip(to) {
            let crossing = start / (start - end);
            match (start >= 0.0, end >= 0.0) {
                (false, false) => return None,
                (false, true) => kept[0] = kept[0].max(crossing),
                (true, false) => kept[1] = kept[1].min(crossing),
                (true, true) => {}
            }
        }
        (kept[0] < kept[1]).then_some(kept)
    }

    /// How far inside each of the five sides of the view a point lies; all are linear in the point.
    fn inside(&self, point: DVec3) -> [f64; 5] {
        let from_eye = point - self.eye;
        let depth = from_eye.dot(self.forward);
        let reach = if self.parallel { 1.0 } else { depth };
        let [x, y] = [from_eye.dot(self.right), from_eye.dot(self.up)];
        let [half_x, half_y] = self.size.map(|px| reach * px / 2.0 / self.px_per_unit);
        let beyond = depth - self.nearest;
        [beyond, half_x - x, half_x + x, half_y - y, half_y + y]
    }

    /// The share of the world segment between two depths that lies before the share `s` of its picture.
    pub fn world_share(&self, depths: [f64; 2], s: f64) -> f64 {
        if self.parallel {
            return s;
        }
        let [near, far] = depths;
        s * near / ((1.0 - s) * far + s * near)
    }

    /// The eye; in parallel view a point that the view axis goes through.
    pub fn eye(&self) -> DVec3 {
        self.eye
    }
}

/// A point in double precision.
pub fn wide(point: [f32; 3]) -> DVec3 {
    DVec3::from(point.map(f64::from))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn camera(projection: Projection) -> Camera {
        Camera {
            eye: [1.0, 2.0, 5.0],
            target: [0.0, 0.5, 0.0],
            up: [0.0, 1.0, 0.0],
            projection,
        }
    }

    fn projections() -> impl Strategy<Value = Projection> {
        prop_oneof![
            Just(Projection::Perspective { fov_y: 0.6 }),
            Just(Projection::Parallel { height: 3.0 })
        ]
    }

    fn points() -> impl Strategy<Value = DVec3> {
        (-4.0..4.0, -4.0..4.0, -8.0..8.0).prop_map(|(x, y, z)| DVec3::new(x, y, z))
    }

    proptest! {
        #[test]
        fn the_camera_that_draws_agrees(projection in projections(), point in points()) {
            let camera = camera(projection);
            let view = Viewpoint::new(&camera, [640, 360]);
            prop_assume!(view.depth(point) > 0.2);
            let drawn = camera.view([640, 360], ([-4.0; 3], [4.0; 3]));
            let clip = glam::Mat4::from_cols_array_2d(&drawn.clip_from_world) * point.as_vec3().extend(1.0);
            let expected = [(clip.x / clip.w + 1.0) * 320.0, (1.0 - clip.y / clip.w) * 180.0];
            let found = view.project(point);
            let reach = 1.0 + found[0].abs() + found[1].abs();
            prop_assert!((0..2).all(|i| (found[i] - f64::from(expected[i])).abs() < 1e-3 * reach));
        }

        #[test]
        fn places_and_depths_are_points(projection in projections(), point in points()) {
            let view = Viewpoint::new(&camera(projection), [640, 360]);
            let depth = view.depth(point);
            prop_assume!(depth > 0.2);
            prop_assert!(view.point_at(view.project(point), depth).distance(point) < 1e-9);
        }

        #[test]
        fn what_is_kept_lies_in_the_frame(projection in projections(), a in points(), b in points()) {
            let view = Viewpoint::new(&camera(projection), [640, 360]);
            if let Some(kept) = view.clip(a, b) {
                for share in [kept[0], (kept[0] + kept[1]) / 2.0, kept[1]] {
                    let [x, y] = view.project(a.lerp(b, share));
                    prop_assert!((-1e-3..640.001).contains(&x) && (-1e-3..360.001).contains(&y));
                }
            }
        }

        #[test]
        fn shares_of_picture_and_world_agree(a in points(), b in points(), s in 0.0..1.0f64) {
            let view = Viewpoint::new(&camera(Projection::Perspective { fov_y: 0.6 }), [640, 360]);
            let depths = [view.depth(a), view.depth(b)];
            prop_assume!(depths[0] > 0.2 && depths[1] > 0.2);
            let [from, to] = [view.project(a), view.project(b)];
            let there = view.project(a.lerp(b, view.world_share(depths, s)));
            for i in 0..2 {
                let expected = from[i] + s * (to[i] - from[i]);
                prop_assert!((there[i] - expected).abs() < 1e-6 * (1.0 + expected.abs()));
            }
        }
    }
}
