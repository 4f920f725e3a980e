//! A drawn line as its middle, with the width of its ink.

/// A point on the middle of a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CentrePoint {
    /// Pixels from the top left corner, y down; pixel centres lie at .5.
    pub place: [f64; 2],
    /// Whole width of the ink, in pixels.
    pub width: f64,
}

/// A drawn line.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct CentreStroke {
    /// About a pixel apart, at least two. Ends have round caps: the ink ends half a width beyond.
    pub points: Vec<CentrePoint>,
    /// The last point runs on to the first, which is not repeated.
    pub closed: bool,
    /// Whether it ends in nothing at its start and end, rather than on another stroke.
    pub free: [bool; 2],
}
