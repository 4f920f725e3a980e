//! The camera in the hand.

use npr_core::camera::{Camera, DEFAULT_FOV_DEG, Projection};
use npr_core::math;
use npr_core::standard_view::StandardView;

/// Radians that a drag over the height of the picture turns by.
const TURN: f32 = 3.2;

/// Nearest angle to the poles that a drag reaches, in radians.
const POLE: f32 = 0.02;

/// Where the picture is seen from, as options of a command line say it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Viewpoint {
    /// Position of the eye in the world.
    pub eye: [f32; 3],
    /// The point that drags turn about.
    pub target: [f32; 3],
    /// Which way is up in the picture.
    pub up: [f32; 3],
    /// Vertical field of view in degrees.
    pub fov_deg: f32,
    /// Whether it is drawn without perspective; the frame is as high as it would be at the target.
    pub is_parallel: bool,
}

impl Viewpoint {
    /// The viewpoint of a camera. One in parallel view gets the usual field of view, and an eye where that makes the
    /// same height.
    pub fn of(camera: &Camera) -> Self {
        let mut point = Self {
            eye: camera.eye,
            target: camera.target,
            up: camera.up,
            fov_deg: DEFAULT_FOV_DEG,
            is_parallel: false,
        };
        match camera.projection {
            Projection::Perspective { fov_y } => point.fov_deg = fov_y.to_degrees(),
            Projection::Parallel { height } => {
                let back = camera.axes()[2];
                let distance = height / (2.0 * math::tan(point.fov_deg.to_radians() * 0.5));
                point.eye = along(camera.target, back, distance);
                point.is_parallel = true;
            }
        }
        point
    }

    /// The camera.
    pub fn camera(&self) -> Camera {
        let camera = Camera {
            eye: self.eye,
            target: self.target,
            up: self.up,
            projection: Projection::Perspective {
                fov_y: self.fov_deg.to_radians(),
            },
        };
        match self.is_parallel {
            true => camera.in_parallel(),
            false => camera,
        }
    }

    /// Turns about the target by a drag, given in heights of the picture to the right and down.
    pub fn orbit(&mut self, [right, down]: [f32; 2]) {
        // Turn about the world's up, which is +y unless the picture lies on its side.
        let camera = self
            .camera()
            .turned(self.target, [0.0, 1.0, 0.0], -right * TURN);

        // Turn up or down, not over the poles.
        let [across, _, back] = camera.axes();
        let height = math::acos(back[1].clamp(-1.0, 1.0));
        let wanted = (height - down * TURN).clamp(POLE, std::f32::consts::PI - POLE);
        let camera = camera.turned(self.target, across, wanted - height);

        // Set the picture upright.
        let upright = Camera {
            up: [0.0, 1.0, 0.0],
            ..camera
        };
        let is_same_way_up = dot(upright.axes()[0], across) > 0.0;
        let camera = if is_same_way_up { upright } else { camera };
        (self.eye, self.up) = (camera.eye, camera.up);
    }

    /// Moves along with a drag, given in heights of the picture to the right and down.
    pub fn pan(&mut self, [right, down]: [f32; 2]) {
        let [across, up, _] = self.camera().axes();
        let height = self.height();
        for point in [&mut self.eye, &mut self.target] {
            *point = along(*point, across, -right * height);
            *point = along(*point, up, down * height);
        }
    }

    /// Comes nearer by a factor below 1, or goes away by one above. What lies under the pointer stays there: its place
    /// is given in heights of the picture from the middle, to the right and down.
    pub fn zoom(&mut self, factor: f32, [right, down]: [f32; 2]) {
        let [_, _, back] = self.camera().axes();
        let distance = self.distance() * factor;
        if !(1e-6..1e9).contains(&distance) {
            return;
        }
        self.pan([-right * (1.0 - factor), -down * (1.0 - factor)]);
        self.eye = along(self.target, back, distance);
    }

    /// Looks at the target from a side.
    pub fn look_from(&mut self, side: StandardView) {
        let distance = self.distance();
        let (back, up) = side.sides();
        let length = dot(back, back).sqrt();
        self.eye = along(self.target, back, distance / length);
        self.up = up;
    }

    /// Where a point of the world lies in a picture of `size` pixels, in shares of its width and height from the upper
    /// left corner; `None` behind the eye.
    pub(crate) fn share_of(&self, [x, y, z]: [f32; 3], size: [u32; 2]) -> Option<[f32; 2]> {
        let around = self.distance();
        let bounds = [-1.0, 1.0].map(|side| self.target.map(|middle| middle + side * around));
        let m = self
            .camera()
            .view(size, (bounds[0], bounds[1]))
            .clip_from_world;
        let [right, up, w] =
            [0, 1, 3].map(|row| m[0][row] * x + m[1][row] * y + m[2][row] * z + m[3][row]);
        (w > 0.0).then(|| [0.5 + 0.5 * right / w, 0.5 - 0.5 * up / w])
    }

    fn distance(&self) -> f32 {
        let apart: [f32; 3] = std::array::from_fn(|i| self.eye[i] - self.target[i]);
        dot(apart, apart).sqrt()
    }

    /// Height of the frame at the target, in the units of the scene.
    fn height(&self) -> f32 {
        2.0 * math::tan(self.fov_deg.to_radians() * 0.5) * self.distance()
    }
}

fn along(point: [f32; 3], direction: [f32; 3], distance: f32) -> [f32; 3] {
    std::array::from_fn(|i| point[i] + direction[i] * distance)
}

fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn front() -> Viewpoint {
        Viewpoint {
            eye: [0.0, 0.0, 5.0],
            target: [0.0; 3],
            up: [0.0, 1.0, 0.0],
            fov_deg: 40.0,
            is_parallel: false,
        }
    }

    fn near(a: [f32; 3], b: [f32; 3]) -> bool {
        (0..3).all(|i| (a[i] - b[i]).abs() < 1e-4)
    }

    #[test]
    fn a_drag_turns_about_the_target_at_one_distance() {
        let mut point = front();
        point.orbit([0.2, 0.1]);
        assert!(point.eye[0] < -1.0 && point.eye[1] > 1.0, "{point:?}");
        assert!((point.distance() - 5.0).abs() < 1e-4);
        point.orbit([0.0, -0.1]);
        point.orbit([-0.2, 0.0]);
        assert!(near(point.eye, [0.0, 0.0, 5.0]), "{point:?}");
        point.orbit([0.0, 40.0]);
        assert!(
            point.eye[1] > 4.9 && point.up == [0.0, 1.0, 0.0],
            "{point:?}"
        );
    }

    #[test]
    fn from_the_top_a_drag_leads_back_to_the_front() {
        let mut point = front();
        point.look_from(StandardView::Top);
        assert!(near(point.eye, [0.0, 5.0, 0.0]));
        point.orbit([0.0, -0.2]);
        assert!(point.eye[2] > 1.0 && point.eye[0].abs() < 1e-4, "{point:?}");
        assert_eq!(point.up, [0.0, 1.0, 0.0]);
    }

    /// Where a point of the world lies in the picture, in heights from the middle.
    fn seen(point: &Viewpoint, world: [f32; 3]) -> [f32; 2] {
        let view = point.camera().view([100, 100], ([-1.0; 3], [1.0; 3]));
        let clip: Vec<f32> = (0..4)
            .map(|row| {
                let m = view.clip_from_world;
                m[0][row] * world[0] + m[1][row] * world[1] + m[2][row] * world[2] + m[3][row]
            })
            .collect();
        [clip[0] / clip[3] * 0.5, -clip[1] / clip[3] * 0.5]
    }

    #[test]
    fn a_point_of_the_world_lies_where_the_picture_shows_it() {
        for is_parallel in [false, true] {
            let point = Viewpoint {
                is_parallel,
                ..front()
            };
            let world = [0.7, -0.4, 0.3];
            let [x, y] = seen(&point, world);
            let share = point.share_of(world, [100, 100]).expect("before the eye");
            assert!((share[0] - 0.5 - x).abs() < 1e-5 && (share[1] - 0.5 - y).abs() < 1e-5);
            let wide = point.share_of(world, [200, 100]).expect("before the eye");
            assert!((wide[0] - 0.5 - 0.5 * x).abs() < 1e-5 && wide[1] == share[1]);
        }
        assert_eq!(front().share_of([0.0, 0.0, 6.0], [100, 100]), None);
    }

    #[test]
    fn what_lies_under_the_pointer_stays_there() {
        for is_parallel in [false, true] {
            let mut point = Viewpoint {
                is_parallel,
                ..front()
            };
            let world = [0.7, -0.4, 0.0];
            let at = seen(&point, world);
            point.zoom(0.5, at);
            let now = seen(&point, world);
            assert!((now[0] - at[0]).abs() < 1e-4 && (now[1] - at[1]).abs() < 1e-4);
            assert!((point.distance() - 2.5).abs() < 1e-4);
            point.pan([0.1, 0.2]);
            let moved = seen(&point, world);
            assert!((moved[0] - now[0] - 0.1).abs() < 1e-4, "{moved:?} {now:?}");
            assert!((moved[1] - now[1] - 0.2).abs() < 1e-4, "{moved:?} {now:?}");
        }
    }

    /// What a hand may do to a camera.
    fn moves() -> impl Strategy<Value = Vec<(u32, [f32; 2])>> {
        prop::collection::vec((0u32..3, prop::array::uniform2(-1f32..1.0)), 0..12)
    }

    proptest! {
        /// Drags turn about the target at one distance and pan it along, zooms change the distance by their factor, and
        /// whatever comes the picture stands upright.
        #[test]
        fn drags_keep_the_distance_and_zooms_change_it(moves in moves(), is_parallel: bool) {
            let mut point = Viewpoint { is_parallel, ..front() };
            let mut distance = 5.0;
            for (kind, way) in moves {
                let before = point;
                match kind {
                    0 => point.orbit(way),
                    1 => point.pan(way),
                    _ => {
                        let factor = 1.0 + 0.5 * way[0];
                        point.zoom(factor, [0.0, way[1]]);
                        distance *= factor;
                    }
                }
                prop_assert!((point.distance() / distance - 1.0).abs() < 1e-3, "{point:?}");
                prop_assert!(kind != 0 || point.target == before.target);
                prop_assert!(point.camera().axes()[1][1] > 0.0, "{point:?}");
            }
        }
    }

    #[test]
    fn a_parallel_camera_keeps_its_height() {
        let camera = Camera {
            projection: Projection::Parallel { height: 3.0 },
            ..front().camera()
        };
        let point = Viewpoint::of(&camera);
        let Projection::Parallel { height } = point.camera().projection else {
            panic!("perspective");
        };
        assert!((height - 3.0).abs() < 1e-5);
        assert_eq!(Viewpoint::of(&front().camera()).camera().eye, front().eye);
    }
}
