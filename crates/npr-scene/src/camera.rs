//! Cameras as stored in files.

/// A camera; its node says where it stands, and it looks along the node's -Z.
#[derive(Debug, Clone, PartialEq)]
pub struct Camera {
    /// Name as in the file; empty where it has none.
    pub name: String,
    /// How it projects.
    pub projection: Projection,
}

/// How a camera projects.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Projection {
    /// Far things look smaller.
    Perspective {
        /// Vertical field of view in radians, between 0 and pi.
        yfov: f32,
        /// Distance of the near plane, above 0.
        znear: f32,
        /// Distance of the far plane, above `znear`; none is infinitely far.
        zfar: Option<f32>,
        /// Width over height the camera was made for.
        aspect: Option<f32>,
    },
    /// All things keep their size.
    Orthographic {
        /// Half the visible width in scene units.
        xmag: f32,
        /// Half the visible height in scene units.
        ymag: f32,
        /// Distance of the near plane, not negative.
        znear: f32,
        /// Distance of the far plane, above `znear`.
        zfar: f32,
    },
}
