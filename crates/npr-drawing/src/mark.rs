//! Shapes of one colour, with which pictures and files are painted.

use kurbo::BezPath;

/// How a shape is painted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Paint {
    /// The inside, by the nonzero rule.
    Ink,
    /// The inside, by the even-odd rule, and a thin line around it that covers the seam to its neighbours.
    Region,
    /// A line of this width with round ends and joins, along the path.
    Line(f64),
    /// A line as above, with dashes and gaps.
    Dashes(f64),
}

/// A shape of one colour.
#[derive(Debug, Clone, PartialEq)]
pub struct Mark {
    /// The stroke that it draws; `None` for flat colour.
    pub stroke: Option<u64>,
    /// Its curves, in the artwork's unit.
    pub path: BezPath,
    /// How it is painted.
    pub paint: Paint,
    /// sRGB and alpha.
    pub color: [u8; 4],
}
