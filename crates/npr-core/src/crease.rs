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
    /// Cosine of the angle from which an edge is a crease where a line of creases goes on along it: `cos` or more.
    pub weak_cos: f32,
    /// What the angles lie between.
    pub from: CreaseFrom,
    /// Cosine of the angle between faces from which an edge is a crease however smooth its normals, where `from` is
    /// [`CreaseFrom::Normals`]; -1 for none.
    pub hard_cos: f32,
    /// Width of the widest rounding that is a crease all the same, in the unit of positions; 0 for none.
    pub round: f32,
}

impl Creases {
    /// Creases from an angle in radians.
    pub fn over(angle: f32, from: CreaseFrom) -> Self {
        Self::with_slack(angle, 0.0, from)
    }

    /// Creases from an angle, and from one smaller by `slack` where a line of creases goes on, both in radians.
    pub fn with_slack(angle: f32, slack: f32, from: CreaseFrom) -> Self {
        Self {
            cos: crate::math::cos(angle),
            weak_cos: crate::math::cos((angle - slack.max(0.0)).max(0.0)),
            from,
            hard_cos: -1.0,
            round: 0.0,
        }
    }

    /// The same with edges that fold by this angle between faces, in radians, as creases whatever their normals.
    pub fn with_hard_folds(self, angle: f32) -> Self {
        let hard_cos = if angle < std::f32::consts::PI {
            crate::math::cos(angle)
        } else {
            -1.0
        };
        Self { hard_cos, ..self }
    }

    /// The same with narrow roundings, of this width at most, as creases.
    pub fn with_roundings(self, round: f32) -> Self {
        Self { round, ..self }
    }
}

impl From<f32> for Creases {
    /// Under this cosine, by the file's normals.
    fn from(cos: f32) -> Self {
        Self {
            cos,
            weak_cos: cos,
            from: CreaseFrom::Normals,
            hard_cos: -1.0,
            round: 0.0,
        }
    }
}
