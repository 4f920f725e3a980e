//! Cameras: where the eye is and how space becomes a picture.

use crate::math;
use crate::window::View;
use glam::{Mat4, Vec3, Vec4};

/// How far a view reaches around its axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Projection {
    /// Lines meet at the eye. The angle is vertical, in radians, between 0 and pi.
    Perspective {
        /// Vertical field of view in radians.
        fov_y: f32,
    },
    /// Lines stay parallel.
    Parallel {
        /// Height of the view in world units.
        height: f32,
    },
}

/// An eye in the world. Right-handed, looking at a target.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// Position of the eye in the world.
    pub eye: [f32; 3],
    /// A point on the view axis, in front of the eye.
    pub target: [f32; 3],
    /// Which way is up in the picture; need not be perpendicular to the axis.
    pub up: [f32; 3],
    /// Perspective or parallel.
    pub projection: Projection,
}

/// The vertical field of view of a camera that nobody set, in degrees.
pub const DEFAULT_FOV_DEG: f32 = 40.0;

/// Where a default view looks from, three quarters from above, and what is up in it.
pub const THREE_QUARTERS: ([f32; 3], [f32; 3]) = ([0.6, 0.45, 1.0], [0.0, 1.0, 0.0]);

/// How much of the frame a framed box fills, the rest is margin.
const FRAMED_SHARE: f32 = 0.88;

impl Camera {
    /// A 16:9 perspective view of a box, from three quarters above.
    pub fn framing(min: [f32; 3], max: [f32; 3]) -> Self {
        Self::framing_for(min, max, 16.0 / 9.0, DEFAULT_FOV_DEG.to_radians())
    }

    /// A perspective view of a box from three quarters above, for a frame of width / height `aspect`.
    pub fn framing_for(min: [f32; 3], max: [f32; 3], aspect: f32, fov_y: f32) -> Self {
        Self::framing_points(
            corners(Vec3::from(min), Vec3::from(max)).map(|corner| corner.to_array()),
            aspect,
            fov_y,
        )
    }

    /// A perspective view of points from three quarters above, for a frame of width / height `aspect`.
    ///
    /// The eye stands as near as it can with every point inside the frame and a margin around, and the points lie
    /// in the middle of the frame. Without points, a unit box is framed.
    pub fn framing_points(points: impl Iterator<Item = [f32; 3]>, aspect: f32, fov_y: f32) -> Self {
        Self::framing_points_from(points, THREE_QUARTERS, aspect, fov_y)
    }

    /// The same view from another side. `back` leads from the scene towards the eye, `up` is that of the picture; they
    /// must not be parallel.
    pub fn framing_points_from(
        points: impl Iterator<Item = [f32; 3]>,
        (back, up_world): ([f32; 3], [f32; 3]),
        aspect: f32,
        fov_y: f32,
    ) -> Self {
        let [right, up, back] = axes_of(back, up_world);
        let tan_y = math::tan(fov_y * 0.5) * FRAMED_SHARE;
        let tan_x = tan_y * aspect;

        // Along an axis of the picture, every point bounds where a pyramid with its side planes may have its tip.
        let mut reach = [f32::MIN; 4];
        let mut nearest = f32::MIN;
        for point in points.map(Vec3::from) {
            let (x, y, z) = (point.dot(right), point.dot(up), point.dot(back));
            let sides = [x / tan_x + z, -x / tan_x + z, y / tan_y + z, -y / tan_y + z];
            reach = std::array::from_fn(|i| reach[i].max(sides[i]));
            nearest = nearest.max(z);
        }
        if nearest == f32::MIN {
            return Self::framing_for([-0.5; 3], [0.5; 3], aspect, fov_y);
        }
        let x = (reach[0] - reach[1]) * 0.5 * tan_x;
        let y = (reach[2] - reach[3]) * 0.5 * tan_y;
        let across = (reach[0] + reach[1]).max(reach[2] + reach[3]) * 0.5;
        let z = across.max(nearest + (across - nearest).abs() * 0.01 + nearest.abs() * 1e-4 + 1e-6);
        let eye = right * x + up * y + back * z;
        Self {
            eye: eye.to_array(),
            target: (eye - back * (z - nearest).max(1e-3)).to_array(),
            up: up_world,
            projection: Projection::Perspective { fov_y },
        }
    }

    /// A parallel view of points, from a side as [`Camera::framing_points_from`] takes it, with the same margin.
    ///
    /// The target is the middle of the points, and the eye stands where a perspective view with the field of view
    /// `fov_y` would have the same height at the target: [`Camera::in_parallel`] gives the height back.
    pub fn framing_parallel(
        points: impl Iterator<Item = [f32; 3]>,
        (back, up_world): ([f32; 3], [f32; 3]),
        aspect: f32,
        fov_y: f32,
    ) -> Self {
        let axes = axes_of(back, up_world);
        let mut reach = [(f32::MAX, f32::MIN); 3];
        for point in points.map(Vec3::from) {
            for ((low, high), axis) in reach.iter_mut().zip(axes) {
                let place = point.dot(axis);
                (*low, *high) = (low.min(place), high.max(place));
            }
        }
        if reach[0].0 > reach[0].1 {
            reach = [(-0.5, 0.5); 3];
        }
        let length = |(low, high): (f32, f32)| high - low;
        let middle = |(low, high): (f32, f32)| (low + high) * 0.5;
        let height = length(reach[1])
            .max(length(reach[0]) / aspect)
            .max(length(reach[2]) * 1e-4)
            .max(1e-6)
            / FRAMED_SHARE;
        let [right, up, back] = axes;
        let target = right * middle(reach[0]) + up * middle(reach[1]) + back * middle(reach[2]);
        Self {
            eye: (target + back * (height / (2.0 * math::tan(fov_y * 0.5)))).to_array(),
            target: target.to_array(),
            up: up_world,
            projection: Projection::Perspective { fov_y },
        }
        .in_parallel()
    }

    /// The camera in parallel view: what lies at the target keeps its size. One that is parallel stays as it is.
    pub fn in_parallel(&self) -> Self {
        let Projection::Perspective { fov_y } = self.projection else {
            return *self;
        };
        let distance = Vec3::from(self.eye).distance(Vec3::from(self.target));
        let height = 2.0 * math::tan(fov_y * 0.5) * distance;
        Self {
            projection: Projection::Parallel { height },
            ..*self
        }
    }

    /// The camera turned by `angle` radians about an axis through `pivot`, counter-clockwise as seen from where the
    /// axis points. An angle of 0 gives the same camera, bit for bit.
    pub fn turned(&self, pivot: [f32; 3], axis: [f32; 3], angle: f32) -> Self {
        if angle == 0.0 {
            return *self;
        }
        let (pivot, axis) = (Vec3::from(pivot), axis_of(axis));
        let place = |point: [f32; 3]| pivot + turned_about(axis, Vec3::from(point) - pivot, angle);
        Self {
            eye: place(self.eye).to_array(),
            target: place(self.target).to_array(),
            up: turned_about(axis, Vec3::from(self.up), angle).to_array(),
            projection: self.projection,
        }
    }

    /// Right, up and back axes of the picture, unit length, whatever the input.
    pub fn axes(&self) -> [[f32; 3]; 3] {
        let toward_eye = Vec3::from(self.eye) - Vec3::from(self.target);
        let back = toward_eye.try_normalize().unwrap_or(Vec3::Z);
        let right = Vec3::from(self.up)
            .cross(back)
            .try_normalize()
            .unwrap_or_else(|| back.any_orthonormal_vector());
        let up = back.cross(right);
        [right.to_array(), up.to_array(), back.to_array()]
    }

    /// What passes need to know of this camera for a frame of `size` pixels.
    ///
    /// `bounds` is the box of the scene: near and far planes follow from it. Depth is reversed, 1 at the
    /// near plane and 0 at infinity (in perspective) or behind the scene (in parallel view), which keeps float depth
    /// equally fine near and far.
    pub fn view(&self, size: [u32; 2], bounds: ([f32; 3], [f32; 3])) -> View {
        // Turn the world into the axes of the camera.
        let [right, up, back] = self.axes().map(Vec3::from);
        let eye = Vec3::from(self.eye);
        let (nearest, farthest) = self.depth_range(bounds);
        let aspect = size[0] as f32 / size[1] as f32;
        let camera_from_world = Mat4::from_cols(
            Vec4::new(right.x, up.x, back.x, 0.0),
            Vec4::new(right.y, up.y, back.y, 0.0),
            Vec4::new(right.z, up.z, back.z, 0.0),
            Vec4::new(-right.dot(eye), -up.dot(eye), -back.dot(eye), 1.0),
        );

        // Put depth 1 on the near plane; in perspective, nothing is too far.
        let (clip_from_camera, perspective, view_height, near) = match self.projection {
            Projection::Perspective { fov_y } => {
                let height = 2.0 * math::tan(fov_y * 0.5);
                let near = nearest.max(farthest * 1e-5).max(1e-6);
                (
                    perspective_reversed(height, aspect, near),
                    1.0,
                    height,
                    near,
                )
            }
            Projection::Parallel { height } => (
                parallel_reversed(height, aspect, nearest, farthest),
                0.0,
                height,
                nearest,
            ),
        };
        View {
            clip_from_world: (clip_from_camera * camera_from_world).to_cols_array_2d(),
            eye_world: self.eye,
            perspective,
            forward_world: (-back).to_array(),
            view_height,
            frame_px: size.map(|v| v as f32),
            near,
            unused: 0.0,
        }
    }

    /// View depths that enclose a box, with a little room on both sides.
    fn depth_range(&self, (min, max): ([f32; 3], [f32; 3])) -> (f32, f32) {
        let back = Vec3::from(self.axes()[2]);
        let eye = Vec3::from(self.eye);
        let mut range = (f32::MAX, f32::MIN);
        for corner in corners(Vec3::from(min), Vec3::from(max)) {
            let depth = (eye - corner).dot(back);
            range = (range.0.min(depth), range.1.max(depth));
        }
        let room = (range.1 - range.0).max(range.1.abs() * 1e-3).max(1e-6) * 0.01;
        (range.0 - room, range.1 + room)
    }
}

/// Right, up and back of a picture, unit length, from where its eye stands and which way is up.
fn axes_of(back: [f32; 3], up: [f32; 3]) -> [Vec3; 3] {
    let back = Vec3::from(back).normalize();
    let right = Vec3::from(up).cross(back).normalize();
    [right, back.cross(right), back]
}

/// Slices along the axis, and points on the ring of each, that stand for what turns.
const SWEPT: [usize; 2] = [64, 32];

/// Rings of points around all that points sweep as they turn about an axis through `pivot`, for framing a view that
/// turns. What is swept lies within them, up to a share of 0.5 % of its radius.
///
/// The points are cut into slices across the axis; each slice has a ring as wide as its farthest point, at its lower
/// and its upper end. O(points).
pub fn swept(
    points: impl Iterator<Item = Vec3> + Clone,
    pivot: [f32; 3],
    axis: [f32; 3],
) -> Vec<[f32; 3]> {
    // Measure how far the points reach along the axis.
    let (pivot, axis) = (Vec3::from(pivot), axis_of(axis));
    let heights = points.clone().map(|point| (point - pivot).dot(axis));
    let (low, high) = heights.fold((f32::MAX, f32::MIN), |(low, high), height| {
        (low.min(height), high.max(height))
    });
    if low > high {
        return Vec::new();
    }

    // Measure how far those of every slice lie from it.
    let [slices, sides] = SWEPT;
    let thickness = (high - low) / slices as f32;
    let mut radii = vec![-1.0_f32; slices];
    for point in points {
        let from_pivot = point - pivot;
        let height = from_pivot.dot(axis);
        let slice = ((height - low) / thickness.max(f32::MIN_POSITIVE)) as usize;
        let radius = &mut radii[slice.min(slices - 1)];
        *radius = radius.max((from_pivot - axis * height).length());
    }

    // Put a ring round both ends of every slice that holds a point.
    let (right, back) = axis.any_orthonormal_pair();
    let mut rings = Vec::with_capacity(slices * sides * 2);
    let filled = (0..slices).zip(radii).filter(|(_, radius)| *radius >= 0.0);
    for (slice, radius) in filled {
        for end in [slice, slice + 1] {
            let middle = pivot + axis * (low + thickness * end as f32);
            rings.extend((0..sides).map(|side| {
                let angle = side as f32 / sides as f32 * std::f32::consts::TAU;
                let across = right * math::cos(angle) + back * math::sin(angle);
                (middle + across * radius).to_array()
            }));
        }
    }
    rings
}

/// An axis with unit length; up where it has none.
fn axis_of(axis: [f32; 3]) -> Vec3 {
    Vec3::from(axis).try_normalize().unwrap_or(Vec3::Y)
}

/// A vector turned about a unit axis by Rodrigues' formula, counter-clockwise as seen from where the axis points.
fn turned_about(axis: Vec3, vector: Vec3, angle: f32) -> Vec3 {
    let (sin, cos) = (math::sin(angle), math::cos(angle));
    vector * cos + axis.cross(vector) * sin + axis * axis.dot(vector) * (1.0 - cos)
}

/// The box around points, its lowest and highest corner; a unit box where there are none.
pub fn bounds_of(points: impl Iterator<Item = Vec3>) -> ([f32; 3], [f32; 3]) {
    let none = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    let (min, max) = points.fold(none, |(min, max), point| (min.min(point), max.max(point)));
    if min.is_finite() && max.is_finite() {
        (min.to_array(), max.to_array())
    } else {
        ([-0.5; 3], [0.5; 3])
    }
}

/// The eight corners of a box, given by its lowest and highest.
pub fn box_corners((min, max): ([f32; 3], [f32; 3])) -> Vec<[f32; 3]> {
    let corners = corners(Vec3::from(min), Vec3::from(max));
    corners.map(|corner| corner.to_array()).collect()
}

/// The eight corners of a box.
fn corners(min: Vec3, max: Vec3) -> impl Iterator<Item = Vec3> {
    (0..8).map(move |i| {
        let pick = |bit: u32, low: f32, high: f32| if i & bit == 0 { low } else { high };
        Vec3::new(
            pick(1, min.x, max.x),
            pick(2, min.y, max.y),
            pick(4, min.z, max.z),
        )
    })
}

/// Perspective with depth 1 at `near` and 0 at infinity; `height` is the view's at distance 1.
fn perspective_reversed(height: f32, aspect: f32, near: f32) -> Mat4 {
    Mat4::from_cols(
        Vec4::new(2.0 / (height * aspect), 0.0, 0.0, 0.0),
        Vec4::new(0.0, 2.0 / height, 0.0, 0.0),
        Vec4::new(0.0, 0.0, 0.0, -1.0),
        Vec4::new(0.0, 0.0, near, 0.0),
    )
}

/// Parallel projection with depth 1 at `near` and 0 at `far`.
fn parallel_reversed(height: f32, aspect: f32, near: f32, far: f32) -> Mat4 {
    let range = far - near;
    Mat4::from_cols(
        Vec4::new(2.0 / (height * aspect), 0.0, 0.0, 0.0),
        Vec4::new(0.0, 2.0 / height, 0.0, 0.0),
        Vec4::new(0.0, 0.0, 1.0 / range, 0.0),
        Vec4::new(0.0, 0.0, far / range, 1.0),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::standard_view::StandardView;
    use proptest::prelude::*;

    fn project(view: &View, world: [f32; 3]) -> [f32; 4] {
        let clip = Mat4::from_cols_array_2d(&view.clip_from_world) * Vec3::from(world).extend(1.0);
        clip.to_array()
    }

    proptest! {
        #[test]
        fn a_framed_box_lies_inside_the_frame(
            x in -50f32..50.0, y in -50f32..50.0, z in -50f32..50.0,
            w in 0.01f32..20.0, h in 0.01f32..20.0, d in 0.01f32..20.0, aspect in 0.3f32..3.0,
        ) {
            let (min, max) = ([x, y, z], [x + w, y + h, z + d]);
            let camera = Camera::framing_for(min, max, aspect, 0.7);
            let view = camera.view([(aspect * 1000.0) as u32, 1000], (min, max));
            for corner in corners(Vec3::from(min), Vec3::from(max)) {
                let clip = project(&view, corner.to_array());
                prop_assert!(clip[3] > 0.0 && clip[2] <= clip[3] && clip[2] >= 0.0);
                prop_assert!(clip[0].abs() <= clip[3] && clip[1].abs() <= clip[3]);
            }
        }

        #[test]
        fn a_box_lies_inside_the_frame_from_every_side_in_both_projections(
            x in -50f32..50.0, w in 0.01f32..20.0, h in 0.01f32..20.0, d in 0.01f32..20.0,
            aspect in 0.3f32..3.0, side in 0..StandardView::ALL.len(), is_parallel: bool,
        ) {
            let side = StandardView::ALL[side];
            let (min, max) = ([x, 1.0, -2.0], [x + w, 1.0 + h, d - 2.0]);
            let points = corners(Vec3::from(min), Vec3::from(max)).map(|corner| corner.to_array());
            let camera = match is_parallel {
                true => Camera::framing_parallel(points, side.sides(), aspect, 0.7),
                false => Camera::framing_points_from(points, side.sides(), aspect, 0.7),
            };
            let parallel = matches!(camera.projection, Projection::Parallel { .. });
            prop_assert_eq!(parallel, is_parallel);
            let view = camera.view([(aspect * 1000.0) as u32, 1000], (min, max));
            let places = corners(Vec3::from(min), Vec3::from(max)).map(|corner| {
                let clip = project(&view, corner.to_array());
                [clip[0] / clip[3], clip[1] / clip[3]]
            });
            let places: Vec<[f32; 2]> = places.collect();
            let reach = |axis: usize| places.iter().fold(0.0, |far: f32, at| far.max(at[axis].abs()));
            prop_assert!(reach(0) < 0.95 && reach(1) < 0.95, "{} {}", reach(0), reach(1));
            prop_assert!(reach(0).max(reach(1)) > 0.8, "{} {}", reach(0), reach(1));
        }

        #[test]
        fn depth_is_reversed(near in 0.1f32..10.0, gap in 0.1f32..10.0) {
            let projection = Projection::Perspective { fov_y: 1.0 };
            let camera = Camera { eye: [0.0; 3], target: [0.0, 0.0, -1.0], up: [0.0, 1.0, 0.0], projection };
            let view = camera.view([100, 100], ([-1.0, -1.0, -near - gap], [1.0, 1.0, -near]));
            let (a, b) = (project(&view, [0.0, 0.0, -near]), project(&view, [0.0, 0.0, -near - gap]));
            prop_assert!(a[2] / a[3] > b[2] / b[3]);
        }
    }

    proptest! {
        /// What a camera sees of the world after it turned is what it saw before of a world turned the other way.
        #[test]
        fn a_turned_camera_sees_the_world_turned_back(
            eye in prop::array::uniform3(-3.0f32..3.0),
            pivot in prop::array::uniform3(-2.0f32..2.0),
            axis in prop::array::uniform3(-1.0f32..1.0),
            point in prop::array::uniform3(-1.0f32..1.0),
            angle in -7.0f32..7.0,
        ) {
            let camera = Camera { eye: [eye[0], eye[1], eye[2] + 9.0], ..Camera::framing([-1.0; 3], [1.0; 3]) };
            prop_assume!(Vec3::from(axis).length() > 0.1);
            let turn = glam::Quat::from_axis_angle(Vec3::from(axis).normalize(), -angle);
            let turned_back = Vec3::from(pivot) + turn * (Vec3::from(point) - Vec3::from(pivot));
            let seen = |camera: &Camera, point: [f32; 3]| {
                // Depths follow from the box, which turns too: only the place in the picture is compared.
                let [x, y, _, w] = project(&camera.view([16, 9], ([-20.0; 3], [20.0; 3])), point);
                [x / w, y / w]
            };
            let [now, wanted] = [
                seen(&camera.turned(pivot, axis, angle), point),
                seen(&camera, turned_back.to_array()),
            ];
            prop_assert!((now[0] - wanted[0]).abs() < 1e-3 && (now[1] - wanted[1]).abs() < 1e-3, "{now:?} {wanted:?}");
        }

        /// From every side of the axis, what is swept reaches as far as each point does at any angle.
        #[test]
        fn rings_enclose_what_turns(
            points in prop::collection::vec(prop::array::uniform3(-5.0f32..5.0), 1..20),
            pivot in prop::array::uniform3(-2.0f32..2.0),
            axis in prop::array::uniform3(-1.0f32..1.0),
            side in prop::array::uniform3(-1.0f32..1.0),
            angle in 0.0f32..7.0,
        ) {
            prop_assume!(Vec3::from(axis).length() > 0.1 && Vec3::from(side).length() > 0.1);
            let (unit, side) = (Vec3::from(axis).normalize(), Vec3::from(side).normalize());
            let pivot_world = Vec3::from(pivot);
            let points = points.into_iter().map(Vec3::from);
            let rings = swept(points.clone(), pivot, axis);
            let reach = rings.iter().map(|ring| Vec3::from(*ring).dot(side)).fold(f32::MIN, f32::max);
            for point in points {
                let turned = pivot_world + glam::Quat::from_axis_angle(unit, angle) * (point - pivot_world);
                let slack = 0.006 * (point - pivot_world).length() + 1e-4;
                prop_assert!(turned.dot(side) <= reach + slack, "{} beyond {reach}", turned.dot(side));
            }
        }
    }

    #[test]
    fn a_quarter_turn_leads_from_front_to_right() {
        let camera = Camera {
            eye: [0.0, 1.0, 5.0],
            target: [0.0, 1.0, 0.0],
            ..Camera::framing([-1.0; 3], [1.0; 3])
        };
        let [x, y, z] = camera
            .turned([0.0; 3], [0.0, 2.0, 0.0], std::f32::consts::FRAC_PI_2)
            .eye;
        assert!((x - 5.0).abs() < 1e-5 && (y - 1.0).abs() < 1e-5 && z.abs() < 1e-5);
        assert_eq!(camera.turned([7.0; 3], [0.3, 1.0, 0.2], 0.0), camera);
        assert!(swept(std::iter::empty(), [0.0; 3], [0.0, 1.0, 0.0]).is_empty());
    }

    #[test]
    fn a_camera_that_looks_along_its_up_still_has_axes() {
        let camera = Camera {
            eye: [0.0, 3.0, 0.0],
            target: [0.0; 3],
            up: [0.0, 1.0, 0.0],
            projection: Projection::Parallel { height: 2.0 },
        };
        let axes = camera.axes().map(Vec3::from);
        assert!(axes.iter().all(|axis| (axis.length() - 1.0).abs() < 1e-5));
        assert!(axes[0].dot(axes[2]).abs() < 1e-6);
    }
}
