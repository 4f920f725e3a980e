//! Vectors in a picture.

use bytemuck::{Pod, Zeroable};
use npr_core::gpu_layout;

/// A vector in the picture.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct Planar {
    /// To the right, in pixels.
    pub x: f32,
    /// Down, in pixels.
    pub y: f32,
}
gpu_layout!(Planar { x, y });

impl Planar {
    /// The vector of length 1; zero for a vector without direction.
    pub fn unit(self) -> Self {
        let square = self.x * self.x + self.y * self.y;
        if square > LEAST_SQUARE {
            let r = 1.0 / square.sqrt();
            Self {
                x: self.x * r,
                y: self.y * r,
            }
        } else {
            Self::default()
        }
    }

    /// Scalar product.
    pub fn dot(self, other: Self) -> f32 {
        self.x * other.x + self.y * other.y
    }
}

/// Square of the length under which a vector has no direction.
pub(super) const LEAST_SQUARE: f32 = 1e-12;
