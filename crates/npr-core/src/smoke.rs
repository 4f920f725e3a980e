//! Smoke as spheres: what passes read and write, and where a ray of the picture meets a sphere.
//!
//! Rasterisers store which sphere a pixel shows; depth, place and normal are found again from the number with
//! [`SphereView::depth_of`], the same few operations on both engines. WGSL text: `shaders/lib/sphere.wgsl`.

use crate::geometry::FAR_DEPTH;
use crate::gpu_layout;
use crate::light_view::Matrix;
use crate::surface::dot;
use crate::window::{View, pixel_size};
use bytemuck::{Pod, Zeroable};

/// Farthest that a sphere may lie from the eye, and largest radius, to be drawn: squares stay finite.
pub const REACH: f32 = 1e15;

/// A puff of smoke. Its place in the list is its identity.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct Sphere {
    /// Middle, in the world.
    pub center: [f32; 3],
    /// Radius in world units. A sphere of radius 0, or with anything that is no finite number, is not drawn.
    pub radius: f32,
    /// How hot it is, 0 cold smoke, 1 the heart of an explosion.
    pub heat: f32,
    /// Keeps the size a multiple of 16 bytes, with the next.
    pub unused: f32,
    /// See `unused`.
    pub unused_b: [f32; 2],
}
gpu_layout!(Sphere {
    center,
    radius,
    heat,
    unused,
    unused_b
});

impl Sphere {
    /// Cold smoke.
    pub fn new(center: [f32; 3], radius: f32) -> Self {
        Self {
            center,
            radius,
            ..Self::default()
        }
    }
}

/// A sphere as a [`SphereView`] sees it.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct ViewSphere {
    /// Middle, from the eye: to the right, up, and along the view axis.
    pub center: [f32; 3],
    /// Radius in world units; 0 where the sphere is not drawn.
    pub radius: f32,
    /// What encloses its image, in frame pixels, at most a pixel beyond the frame: left, top, right, bottom.
    /// Left lies right of right where nothing is seen.
    pub bounds: [f32; 4],
}
gpu_layout!(ViewSphere {
    center,
    radius,
    bounds
});

/// What the passes of smoke know of a pixel.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct SmokePixel {
    /// Light on the sphere, 0..1.
    pub tone: f32,
    /// View depth of its surface; [`FAR_DEPTH`] where there is none.
    pub depth: f32,
    /// Which layer it is smoothed in, from 0; between two numbers it belongs to both. Below 0 where there is no smoke.
    pub place: f32,
    /// Keeps rows of 16 bytes.
    pub unused: f32,
}
gpu_layout!(SmokePixel {
    tone,
    depth,
    place,
    unused
});

/// An eye that looks at spheres: a camera or a light.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct SphereView {
    /// Where depths and places count from, in the world.
    pub eye_world: [f32; 3],
    /// 1 where rays meet at the eye, 0 where they are parallel.
    pub perspective: f32,
    /// Unit vector to the right of the picture.
    pub right_world: [f32; 3],
    /// Depth of the near plane: what is nearer is not seen.
    pub near: f32,
    /// Unit vector to the top of the picture.
    pub up_world: [f32; 3],
    /// Reversed depth at view depth `t` is `depth_start + depth_step * t`, over `t` in perspective.
    pub depth_start: f32,
    /// Unit view axis.
    pub forward_world: [f32; 3],
    /// See `depth_start`.
    pub depth_step: f32,
    /// Half the width and height of the view: at depth 1 in perspective, at any depth else.
    pub half: [f32; 2],
    /// Width and height of the frame in pixels.
    pub frame_px: [f32; 2],
    /// 1 for discs that face the view instead of spheres [Selle 2004], 0 for spheres.
    pub discs: f32,
    /// Keeps the size a multiple of 16 bytes, with the next.
    pub unused: f32,
    /// See `unused`.
    pub unused_b: [f32; 2],
}
gpu_layout!(SphereView {
    eye_world,
    perspective,
    right_world,
    near,
    up_world,
    depth_start,
    forward_world,
    depth_step,
    half,
    frame_px,
    discs,
    unused,
    unused_b
});

/// A row of a column-major matrix.
fn row(m: &Matrix, i: usize) -> [f32; 4] {
    [m[0][i], m[1][i], m[2][i], m[3][i]]
}

/// The direction of a row, and its length.
fn unit_of(row: [f32; 4]) -> ([f32; 3], f32) {
    let v = [row[0], row[1], row[2]];
    let length = dot(v, v).sqrt();
    (v.map(|x| x / length), length)
}

impl SphereView {
    /// The lens of a camera.
    pub fn of_view(view: &View) -> Self {
        // Read the axes of the picture off the camera's matrix.
        let m = &view.clip_from_world;
        let (right_world, _) = unit_of(row(m, 0));
        let (up_world, _) = unit_of(row(m, 1));
        let depth = row(m, 2);
        let along = |v: [f32; 3]| dot([depth[0], depth[1], depth[2]], v);
        let half_height = view.view_height * 0.5;
        let is_perspective = view.perspective > 0.5;

        // Turn depths into reversed ones as the camera does.
        Self {
            eye_world: view.eye_world,
            perspective: view.perspective,
            right_world,
            near: view.near,
            up_world,
            depth_start: if is_perspective {
                view.near
            } else {
                along(view.eye_world) + depth[3]
            },
            forward_world: view.forward_world,
            depth_step: if is_perspective {
                0.0
            } else {
                along(view.forward_world)
            },
            half: [
                half_height * view.frame_px[0] / view.frame_px[1],
                half_height,
            ],
            frame_px: view.frame_px,
            ..Self::default()
        }
    }

    /// The lens of a light with the view `m`, made by [`crate::light_view`], and a picture `side` texels wide and high.
    pub fn of_light(m: &Matrix, side: u32) -> Self {
        let ((right_world, x), (up_world, y)) = (unit_of(row(m, 0)), unit_of(row(m, 1)));
        let depth = row(m, 2);
        let is_perspective = [m[0][3], m[1][3], m[2][3]] != [0.0; 3];
        let (forward_world, scale) = match is_perspective {
            true => unit_of(row(m, 3)),
            false => {
                let (back, scale) = unit_of(depth);
                (back.map(|v| -v), scale)
            }
        };
        // A parallel light stands where its reversed depth is 1.
        let back = match is_perspective {
            true => -m[3][3] / scale,
            false => (depth[3] - 1.0) / scale,
        };
        let (from_right, from_up) = (-m[3][0] / x, -m[3][1] / y);
        Self {
            eye_world: std::array::from_fn(|i| {
                right_world[i] * from_right + up_world[i] * from_up + forward_world[i] * back
            }),
            perspective: f32::from(is_perspective),
            right_world,
            near: if is_perspective { depth[3] } else { 0.0 },
            up_world,
            depth_start: if is_perspective { depth[3] } else { 1.0 },
            forward_world,
            depth_step: if is_perspective { 0.0 } else { -scale },
            half: match is_perspective {
                true => [scale / x, scale / y],
                false => [1.0 / x, 1.0 / y],
            },
            frame_px: [side as f32; 2],
            ..Self::default()
        }
    }

    /// Where the ray through a frame position goes: right and up, per depth in perspective, as they are else.
    pub fn ray(&self, frame_px: [f32; 2]) -> [f32; 2] {
        let x = 2.0 * frame_px[0] / self.frame_px[0] - 1.0;
        let y = 1.0 - 2.0 * frame_px[1] / self.frame_px[1];
        [x * self.half[0], y * self.half[1]]
    }

    /// The frame position of a place seen from the eye; anything where it lies behind.
    pub fn frame_of(&self, place: [f32; 3]) -> [f32; 2] {
        let depth = if self.perspective > 0.5 {
            place[2]
        } else {
            1.0
        };
        [
            (place[0] / (depth * self.half[0]) + 1.0) * 0.5 * self.frame_px[0],
            (1.0 - place[1] / (depth * self.half[1])) * 0.5 * self.frame_px[1],
        ]
    }

    /// The place at a depth of a ray, from the eye.
    pub fn place_at(&self, ray: [f32; 2], depth: f32) -> [f32; 3] {
        let spread = if self.perspective > 0.5 { depth } else { 1.0 };
        [ray[0] * spread, ray[1] * spread, depth]
    }

    /// A direction given in axes of the picture, in the world.
    pub fn direction_in_world(&self, v: [f32; 3]) -> [f32; 3] {
        std::array::from_fn(|i| {
            self.right_world[i] * v[0] + self.up_world[i] * v[1] + self.forward_world[i] * v[2]
        })
    }

    /// View depth at which a ray first meets a ball; [`FAR_DEPTH`] where it passes by, or where it starts inside.
    pub fn depth_of(&self, ball: &ViewSphere, ray: [f32; 2]) -> f32 {
        if self.discs > 0.5 {
            self.depth_of_disc(ball, ray)
        } else {
            self.depth_of_sphere(ball, ray)
        }
    }

    /// [`SphereView::depth_of`] for spheres.
    ///
    /// The ray's nearest point to the middle is found first, so small balls far away lose no precision. No branches,
    /// so that rows of pixels are computed side by side.
    #[inline]
    pub fn depth_of_sphere(&self, ball: &ViewSphere, ray: [f32; 2]) -> f32 {
        // Start the ray at the eye, or at its own place in a parallel view.
        let meeting = self.perspective;
        let [x, y] = [ray[0] * meeting, ray[1] * meeting];
        let parallel = 1.0 - meeting;
        let offset = [
            ball.center[0] - ray[0] * parallel,
            ball.center[1] - ray[1] * parallel,
            ball.center[2],
        ];

        // Find the ray's nearest point to the middle.
        let scale = 1.0 / (x * x + y * y + 1.0);
        let middle = (offset[0] * x + offset[1] * y + offset[2]) * scale;
        let beside = [
            offset[0] - middle * x,
            offset[1] - middle * y,
            offset[2] - middle,
        ];

        // Step back from there to the surface.
        let left = ball.radius * ball.radius
            - (beside[0] * beside[0] + beside[1] * beside[1] + beside[2] * beside[2]);
        let depth = middle - (left.max(0.0) * scale).sqrt();
        if (left > 0.0) & (depth >= self.near) {
            depth
        } else {
            FAR_DEPTH
        }
    }

    fn depth_of_disc(&self, ball: &ViewSphere, ray: [f32; 2]) -> f32 {
        let place = self.place_at(ray, ball.center[2]);
        let [x, y] = [place[0] - ball.center[0], place[1] - ball.center[1]];
        if x * x + y * y < ball.radius * ball.radius && ball.center[2] >= self.near {
            ball.center[2]
        } else {
            FAR_DEPTH
        }
    }

    /// Size of a frame pixel in world units at a view depth.
    pub fn pixel_at(&self, depth: f32) -> f32 {
        let height = 2.0 * self.half[1];
        pixel_size(self.perspective, height, depth, self.frame_px[1])
    }

    /// Reversed depth at a view depth.
    pub fn reversed(&self, depth: f32) -> f32 {
        let over = if self.perspective > 0.5 { depth } else { 1.0 };
        (self.depth_start + self.depth_step * depth) / over
    }

    /// A sphere as this lens sees it: the twin of `smoke.project_spheres`, for one sphere.
    ///
    /// Not drawn: what has no size, what is no number, what lies behind the eye, and what the eye is inside of.
    pub fn project(&self, sphere: &Sphere) -> ViewSphere {
        let nothing = ViewSphere {
            bounds: [1.0, 1.0, 0.0, 0.0],
            ..ViewSphere::default()
        };

        // Place the sphere before the eye.
        let offset: [f32; 3] = std::array::from_fn(|i| sphere.center[i] - self.eye_world[i]);
        let center = [
            dot(offset, self.right_world),
            dot(offset, self.up_world),
            dot(offset, self.forward_world),
        ];

        // Leave out what cannot be seen.
        let (radius, square) = (sphere.radius, dot(center, center));
        let is_sound = radius > 0.0 && radius < REACH && square < REACH * REACH;
        let around_eye = self.perspective > 0.5 && square <= radius * radius;
        if !is_sound || around_eye || center[2] + radius <= self.near {
            return nothing;
        }

        // Bound its image in pixels.
        let x = self.reach(center[0], center[2], radius, 0);
        let y = self.reach(center[1], center[2], radius, 1);
        let [width, height] = self.frame_px;
        let px = |v: f32, length: f32| (v * 0.5 * length).clamp(-1.0, length + 1.0);
        ViewSphere {
            center,
            radius,
            bounds: [
                px(x[0] + 1.0, width),
                px(1.0 - y[1], height),
                px(x[1] + 1.0, width),
                px(1.0 - y[0], height),
            ],
        }
    }

    /// Lowest and highest normalised coordinate of a ball's image along an axis: where planes through the eye touch it.
    fn reach(&self, across: f32, along: f32, radius: f32, axis: usize) -> [f32; 2] {
        let half = self.half[axis];
        if self.perspective < 0.5 {
            return [(across - radius) / half, (across + radius) / half];
        }
        if along <= radius * 1.0001 {
            return [-BEYOND, BEYOND];
        }
        let reach = (across * across + along * along - radius * radius)
            .max(0.0)
            .sqrt();
        let over = 1.0 / ((along * along - radius * radius) * half);
        [
            (across * along - radius * reach) * over,
            (across * along + radius * reach) * over,
        ]
    }
}

/// A normalised coordinate beyond any frame.
const BEYOND: f32 = 4.0;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{Camera, Projection};
    use crate::light_view::{distant_view, spot_view};
    use crate::surface::{apply_point, unit_or_z};
    use proptest::prelude::*;

    const FRAME: [u32; 2] = [320, 200];

    fn lens(parallel: bool, eye: [f32; 3]) -> (SphereView, View) {
        let projection = match parallel {
            true => Projection::Parallel { height: 6.0 },
            false => Projection::Perspective { fov_y: 0.9 },
        };
        let camera = Camera {
            eye,
            target: [0.1, 0.2, 0.0],
            up: [0.0, 1.0, 0.0],
            projection,
        };
        let view = camera.view(FRAME, ([-3.0; 3], [3.0; 3]));
        (SphereView::of_view(&view), view)
    }

    fn world_of(lens: &SphereView, place: [f32; 3]) -> [f32; 3] {
        let offset = lens.direction_in_world(place);
        std::array::from_fn(|i| lens.eye_world[i] + offset[i])
    }

    fn distance(a: [f32; 3], b: [f32; 3]) -> f32 {
        let d: [f32; 3] = std::array::from_fn(|i| a[i] - b[i]);
        dot(d, d).sqrt()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        #[test]
        fn a_hit_lies_on_the_sphere_and_projects_back_to_its_pixel(
            parallel: bool, eye in prop::array::uniform3(3f32..6.0), center in prop::array::uniform3(-2f32..2.0),
            radius in 0.01f32..1.5, px in prop::array::uniform2(0f32..1.0),
        ) {
            let (lens, view) = lens(parallel, eye);
            let ball = lens.project(&Sphere::new(center, radius));
            let [left, top, right, bottom] = ball.bounds;
            let at = [left + (right - left) * px[0], top + (bottom - top) * px[1]];
            let depth = lens.depth_of(&ball, lens.ray(at));
            prop_assume!(depth < FAR_DEPTH);
            let world = world_of(&lens, lens.place_at(lens.ray(at), depth));
            prop_assert!((distance(world, center) - radius).abs() < 1e-4 + radius * 2e-3);
            let clip = apply_point(&view.clip_from_world, world);
            let ndc = view.ndc_at(at);
            prop_assert!((clip[0] / clip[3] - ndc[0]).abs() < 1e-3 && (clip[1] / clip[3] - ndc[1]).abs() < 1e-3);
            prop_assert!((clip[2] / clip[3] - lens.reversed(depth)).abs() < 1e-4);
            let back = lens.frame_of(lens.place_at(lens.ray(at), depth));
            prop_assert!((back[0] - at[0]).abs() < 0.01 && (back[1] - at[1]).abs() < 0.01);
        }

        #[test]
        fn bounds_enclose_the_image_closely(
            parallel: bool, center in prop::array::uniform3(-1f32..1.0), radius in 0.05f32..1.0,
            at in prop::array::uniform2(0f32..1.0),
        ) {
            let (lens, _) = lens(parallel, [3.0, 4.0, 5.0]);
            let ball = lens.project(&Sphere::new(center, radius));
            let at = [at[0] * 320.0, at[1] * 200.0];
            if lens.depth_of(&ball, lens.ray(at)) < FAR_DEPTH {
                let [left, top, right, bottom] = ball.bounds;
                let within = |low: f32, v: f32, high: f32| low - 0.01 <= v && v <= high + 0.01;
                let inside = within(left, at[0], right) && within(top, at[1], bottom);
                prop_assert!(inside, "{at:?} outside {:?}", ball.bounds);
            }
            let wide = ball.bounds[2] - ball.bounds[0];
            let per_px = if parallel { 6.0 } else { 2.0 * lens.half[1] * (ball.center[2] - radius) } / 200.0;
            prop_assert!(wide < 2.6 * radius / per_px + 1.0, "{wide} pixels for {}", radius / per_px);
        }

        #[test]
        fn nothing_hostile_is_drawn_and_nothing_panics(
            center in prop::array::uniform3(prop::num::f32::ANY), radius in prop::num::f32::ANY, parallel: bool,
        ) {
            let (lens, _) = lens(parallel, [3.0, 4.0, 5.0]);
            let ball = lens.project(&Sphere::new(center, radius));
            prop_assert!(ball.bounds.iter().all(|v| (-1.0..=321.0).contains(v)), "{ball:?}");
            let depth = lens.depth_of(&ball, lens.ray([160.0, 100.0]));
            prop_assert!(depth >= lens.near);
        }

        #[test]
        fn a_light_sees_places_where_its_matrix_says(
            towards in prop::array::uniform3(-1f32..1.0), point in prop::array::uniform3(-2f32..2.0), spot: bool,
        ) {
            let towards = unit_or_z(towards);
            let corners = [[-2.0f32; 3], [2.0; 3], [2.0, -2.0, 2.0], [-2.0, 2.0, -2.0]];
            let m = match spot {
                true => spot_view(towards.map(|v| v * 6.0), towards.map(|v| -v), 0.7, 0.01),
                false => distant_view(towards, &corners, &corners),
            };
            let lens = SphereView::of_light(&m, 512);
            let ball = lens.project(&Sphere::new(point, 0.1));
            prop_assume!(ball.radius > 0.0);
            let clip = apply_point(&m, point);
            let px = lens.frame_of(ball.center);
            prop_assert!((px[0] - (clip[0] / clip[3] + 1.0) * 256.0).abs() < 0.05, "{px:?}");
            prop_assert!((px[1] - (1.0 - clip[1] / clip[3]) * 256.0).abs() < 0.05, "{px:?}");
            prop_assert!((lens.reversed(ball.center[2]) - clip[2] / clip[3]).abs() < 1e-3);
        }
    }

    #[test]
    fn what_cannot_be_seen_has_no_bounds() {
        let (lens, _) = lens(false, [0.0, 0.0, 5.0]);
        let nan = f32::NAN;
        for (center, radius) in [
            ([0.0; 3], 0.0),
            ([0.0; 3], nan),
            ([nan, 0.0, 0.0], 1.0),
            ([0.0, 0.0, 9.0], 1.0),
            ([0.0, 0.0, 5.1], 0.5),
        ] {
            let ball = lens.project(&Sphere::new(center, radius));
            assert!(ball.bounds[0] > ball.bounds[2], "{ball:?}");
            assert_eq!(lens.depth_of(&ball, [0.0; 2]), FAR_DEPTH);
        }
    }

    #[test]
    fn discs_lie_flat() {
        let (mut lens, _) = lens(true, [0.0, 0.0, 5.0]);
        lens.discs = 1.0;
        let ball = lens.project(&Sphere::new([0.0; 3], 1.0));
        let at = |x: f32| lens.depth_of(&ball, [ball.center[0] + x, ball.center[1]]);
        assert_eq!(
            [at(0.0), at(0.9), at(1.1)],
            [ball.center[2], ball.center[2], FAR_DEPTH]
        );
    }
}
