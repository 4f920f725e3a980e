//! Within which limits ends are joined, and the margins that they have in films.

use crate::mesh_lines::joints::Bond;

/// Cosine of the largest bend where two runs are joined, and of the largest angle between an end and the gap it is
/// joined across.
pub const STRAIGHT_COS: f64 = 0.85;

/// Largest difference in depth where two runs are joined, as a share of the depth: where surfaces turn away, depth
/// changes by that within few pixels.
pub const DEPTH_SHARE: f64 = 0.03;

/// The limits within which two ends are joined.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Limits {
    /// Factor on all distances in pixels.
    pub reach: f64,
    /// Cosine of the largest bend, and of the largest angle between an end and the gap.
    pub straight_cos: f64,
    /// The same cosine where one of the runs is a dot and both touch; dots that do not touch are meant as such, like
    /// the holes of a belt.
    pub dot_cos: f64,
    /// Cosine of the largest turn at a corner; lines that come back more sharply are two.
    pub corner_cos: f64,
    /// Largest difference in depth, as a share of the depth.
    pub depth_share: f64,
    /// By how much two ends fit better than others that are as near and as straight.
    pub favour: f64,
    /// Whether they were joined, so that a third end near a corner changes nothing.
    pub is_joined: bool,
}

/// Those of stills, and of ends that were not there in the frame before.
const PLAIN: Limits = Limits {
    reach: 1.0,
    straight_cos: STRAIGHT_COS,
    dot_cos: 0.0,
    corner_cos: -0.5,
    depth_share: DEPTH_SHARE,
    favour: 0.0,
    is_joined: false,
};

/// Those of ends that were joined in the frame before.
const JOINED: Limits = Limits {
    reach: 1.5,
    straight_cos: 0.7,
    dot_cos: -0.25,
    corner_cos: -0.65,
    depth_share: 2.0 * DEPTH_SHARE,
    favour: 2.0,
    is_joined: true,
};

/// Those of ends where a line went on in the frame before.
const CONTINUED: Limits = Limits {
    corner_cos: PLAIN.corner_cos,
    is_joined: false,
    ..JOINED
};

/// Those of ends that were left apart.
const APART: Limits = Limits {
    reach: 0.67,
    straight_cos: 0.92,
    dot_cos: 0.2,
    corner_cos: -0.35,
    depth_share: 0.5 * DEPTH_SHARE,
    favour: 0.0,
    is_joined: false,
};

impl Limits {
    /// The limits for two ends, by what they were in the frame before.
    pub fn of(bond: Bond) -> Self {
        match bond {
            Bond::New => PLAIN,
            Bond::Joined => JOINED,
            Bond::Continued => CONTINUED,
            Bond::Apart => APART,
        }
    }
}
