//! Which edges between two faces are creases.

/// What a fold is measured between.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash)]
pub enum CreaseFrom {
    /// The file's normals where it has them, else the faces: where shading runs on smoothly there is no crease.
    #[default]
    Normals,
    /// The faces, whatever the file's normals: every fold counts.
    Faces,
}

/// From which angle an edge is a crease, and between what it is measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Creases {
    /// Cosine of the angle: an edge with a smaller one is a crease.
    pub cos: f32,
    /// What the angle lies between.
    pub from: CreaseFrom,
}

impl Creases {
    /// Creases from an angle in radians.
    pub fn over(angle: f32, from: CreaseFrom) -> Self {
        let cos = crate::math::cos(angle);
        Self { cos, from }
    }
}

impl From<f32> for Creases {
    /// Under this cosine, by the file's normals.
    fn from(cos: f32) -> Self {
        let from = CreaseFrom::Normals;
        Self { cos, from }
    }
}
