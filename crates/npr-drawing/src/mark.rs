//! Shapes of one colour, with which pictures and files are painted.

use kurbo::{Affine, BezPath, PathEl};

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
    /// The image of this number, laid over the parallelogram that the path goes around from the image's upper left
    /// corner along its upper side.
    Image(u32),
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

impl Mark {
    /// What lays the unit square over the parallelogram of an image; `None` where the path is none.
    pub(crate) fn image_place(&self) -> Option<Affine> {
        let [
            PathEl::MoveTo(start),
            PathEl::LineTo(right),
            PathEl::LineTo(end),
            ..,
        ] = self.path.elements()
        else {
            return None;
        };
        let (along, across) = (*right - *start, *end - *right);
        Some(Affine::new([
            along.x, along.y, across.x, across.y, start.x, start.y,
        ]))
    }
}
