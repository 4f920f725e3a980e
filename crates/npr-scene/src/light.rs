//! Lights as stored in files (`KHR_lights_punctual`).

/// A light; its node says where it stands, and it shines along the node's -Z.
#[derive(Debug, Clone, PartialEq)]
pub struct Light {
    /// Name as in the file; empty where it has none.
    pub name: String,
    /// Shape of the light.
    pub kind: LightKind,
    /// Colour in linear light.
    pub color: [f32; 3],
    /// Strength: lux for a directional light, candela for the others.
    pub intensity: f32,
    /// Distance beyond which it has no effect; none is unbounded.
    pub range: Option<f32>,
}

/// Shape of a light.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LightKind {
    /// Parallel rays, like the sun.
    Directional,
    /// Rays to all sides from one point.
    Point,
    /// Rays in a cone.
    Spot {
        /// Angle from the axis within which it is full, in radians.
        inner: f32,
        /// Angle from the axis beyond which it is dark, in radians, above `inner`.
        outer: f32,
    },
}
