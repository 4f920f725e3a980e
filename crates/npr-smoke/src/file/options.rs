//! What of a file becomes smoke, and which way is up in it.

use glam::{DAffine3, DMat3, DVec3};

/// What of a file becomes smoke.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct VolumeOptions {
    /// The grid of densities; by default one of a usual name, or the only one that can be.
    pub density: Option<String>,
    /// The grid of velocities, or three of their components; by default those of a usual name.
    pub velocity: Vec<String>,
    /// The grid of temperatures; by default one of a usual name.
    pub heat: Option<String>,
    /// Which axis of the file points up; it becomes the world's y.
    pub up: UpAxis,
    /// Most bytes that one volume may take.
    pub memory_limit: u64,
}

impl Default for VolumeOptions {
    fn default() -> Self {
        Self {
            density: None,
            velocity: Vec::new(),
            heat: None,
            up: UpAxis::Y,
            memory_limit: 4 << 30,
        }
    }
}

/// Which axis of a file points up.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum UpAxis {
    /// As in this world and in Houdini.
    #[default]
    Y,
    /// As in Blender; x stays x, y becomes -z.
    Z,
}

impl UpAxis {
    /// This world from a file's.
    pub(super) fn turn(self) -> DAffine3 {
        match self {
            Self::Y => DAffine3::IDENTITY,
            Self::Z => DAffine3::from_mat3(DMat3::from_cols(DVec3::X, DVec3::NEG_Z, DVec3::Y)),
        }
    }
}
