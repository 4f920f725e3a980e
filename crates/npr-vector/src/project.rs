//! From the world to the picture, in double precision.

use glam::DVec3;
use npr_core::camera::{Camera, Projection};

/// A camera as lines see it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Projector {
    eye: DVec3,
    right: DVec3,
    up: DVec3,
    forward: DVec3,
    perspective: bool,
    /// Pixels per world unit: at depth 1 in perspective, at any depth in parallel view.
    scale_px: f64,
    center_px: [f64; 2],
    near: f64,
    far: f64,
}

impl Projector {
    /// A camera for a picture of `size` pixels of a scene within `bounds` (lowest and highest corner).
    pub fn new(camera: &Camera, size: [u32; 2], bounds: ([f32; 3], [f32; 3])) -> Self {
        // Take the axes of the camera, and how much of the world is in sight.
        let [right, up, back] = exact_axes(camera);
        let [width, height] = size.map(f64::from);
        let (perspective, view_height) = match camera.projection {
            Projection::Perspective { fov_y } => {
                (true, 2.0 * npr_core::math::tan_f64(f64::from(fov_y) * 0.5))
            }
            Projection::Parallel { height } => (false, f64::from(height)),
        };

        // Take the near plane of frames, and the farthest corner as the far one.
        let view = camera.view(size, bounds);
        let eye = double(camera.eye);
        let far = corners(bounds)
            .map(|corner| (eye - corner).dot(back))
            .fold(f64::MIN, f64::max);
        Self {
            eye,
            right,
            up,
            forward: -back,
            perspective,
            scale_px: height / view_height,
            center_px: [width * 0.5, height * 0.5],
            near: f64::from(view.near),
            far,
        }
    }

    /// Whether lines meet at the eye.
    pub fn is_perspective(&self) -> bool {
        self.perspective
    }

    /// The direction in which it looks, of length 1.
    pub fn forward(&self) -> DVec3 {
        self.forward
    }

    /// Distance of the near plane along the view axis; what is nearer is not drawn.
    pub fn near(&self) -> f64 {
        self.near
    }

    /// Distance of a point from the eye along the view axis.
    pub fn depth(&self, world: DVec3) -> f64 {
        (world - self.eye).dot(self.forward)
    }

    /// Place of a point in the picture, in pixels, y down; its depth must be positive in perspective.
    pub fn project(&self, world: DVec3) -> [f64; 2] {
        self.project_from_eye(self.from_eye(world))
    }

    /// A point as the eye has it: to the right, up, and along the view axis.
    pub fn from_eye(&self, world: DVec3) -> DVec3 {
        let v = world - self.eye;
        DVec3::new(v.dot(self.right), v.dot(self.up), v.dot(self.forward))
    }

    /// The point in the world of one as the eye has it.
    pub fn world_of(&self, from_eye: DVec3) -> DVec3 {
        self.eye + self.right * from_eye.x + self.up * from_eye.y + self.forward * from_eye.z
    }

    /// [`Projector::project`] of a point as the eye has it.
    pub fn project_from_eye(&self, v: DVec3) -> [f64; 2] {
        let scale = self.pixels_per_unit(v.z);
        [
            self.center_px[0] + scale * v.x,
            self.center_px[1] - scale * v.y,
        ]
    }

    /// Pixels per world unit at a depth.
    pub fn pixels_per_unit(&self, depth: f64) -> f64 {
        if self.perspective {
            self.scale_px / depth
        } else {
            self.scale_px
        }
    }

    /// Where the way from the eye to a point starts; in parallel view, in front of the whole scene.
    pub fn sight_start(&self, world: DVec3) -> DVec3 {
        if self.perspective {
            self.eye
        } else {
            let depth = self.depth(world);
            world - self.forward * (depth - self.near)
        }
    }

    /// A point in the world on the way through a place of the picture, at a depth.
    pub fn unproject(&self, place: [f64; 2], depth: f64) -> DVec3 {
        let scale = 1.0 / self.pixels_per_unit(depth);
        self.eye + self.forward * depth + self.right * ((place[0] - self.center_px[0]) * scale)
            - self.up * ((place[1] - self.center_px[1]) * scale)
    }

    /// Depth behind the whole scene, for sights that look for whatever is there.
    pub fn far(&self) -> f64 {
        self.far.max(self.near * 2.0) * 1.01
    }

    /// The eye in homogeneous coordinates: a point, or the direction towards it.
    pub fn eye(&self) -> [f64; 4] {
        if self.perspective {
            [self.eye.x, self.eye.y, self.eye.z, 1.0]
        } else {
            [-self.forward.x, -self.forward.y, -self.forward.z, 0.0]
        }
    }

    /// How images of lines are stretched.
    pub fn lens(&self) -> Lens {
        match self.perspective {
            true => Lens::Perspective,
            false => Lens::Parallel,
        }
    }

    /// [`Lens::world_share`] of this view.
    pub fn world_share(&self, image_share: f64, depths: [f64; 2]) -> f64 {
        self.lens().world_share(image_share, depths)
    }

    /// Place along a line's image, 0..1, from the place along it in the world.
    pub fn image_share(&self, world_share: f64, depths: [f64; 2]) -> f64 {
        let [z0, z1] = depths;
        let whole = z0 + world_share * (z1 - z0);
        if self.perspective && whole > 0.0 {
            world_share * z1 / whole
        } else {
            world_share
        }
    }
}

/// How the image of a line is stretched along it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Lens {
    /// What is nearer takes more of the image.
    Perspective,
    /// Evenly.
    Parallel,
}

impl Lens {
    /// Place along a line in the world, 0..1, from the place along its image; `depths` are those of both ends.
    pub fn world_share(self, image_share: f64, depths: [f64; 2]) -> f64 {
        let [z0, z1] = depths;
        let whole = z1 + image_share * (z0 - z1);
        match self {
            Self::Perspective if whole > 0.0 => image_share * z0 / whole,
            _ => image_share,
        }
    }
}

fn double(v: [f32; 3]) -> DVec3 {
    DVec3::from(v.map(f64::from))
}

fn corners((low, high): ([f32; 3], [f32; 3])) -> impl Iterator<Item = DVec3> {
    (0..8).map(move |i| {
        double(std::array::from_fn(|axis| {
            if i >> axis & 1 == 0 {
                low[axis]
            } else {
                high[axis]
            }
        }))
    })
}

/// Right, up and back, as [`Camera::axes`] finds them, but orthonormal in double precision.
fn exact_axes(camera: &Camera) -> [DVec3; 3] {
    let [_, _, rough_back] = camera.axes().map(double);
    let back = (double(camera.eye) - double(camera.target))
        .try_normalize()
        .unwrap_or(rough_back);
    let right = double(camera.up)
        .cross(back)
        .try_normalize()
        .unwrap_or_else(|| back.any_orthonormal_vector());
    [right, back.cross(right), back]
}
