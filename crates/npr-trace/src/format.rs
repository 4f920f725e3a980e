//! The file formats of tracings.

/// A file format for traced bitmaps. Coordinates are pixels, to a hundredth.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum TraceFormat {
    /// Black shapes with their holes, each a path; y down.
    Svg,
    /// One page with the same shapes.
    Pdf,
    /// Every outline with area, parent and segments, y down. A segment of four numbers is a corner and the end of the
    /// straight piece after it, one of six is an arc: two control points and the end. The last end is the start.
    Json,
    /// A polygon for every shape, with its holes, within 0.05 pixels of the curves; y up from the lower edge.
    GeoJson,
}

impl TraceFormat {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Svg, Self::Pdf, Self::Json, Self::GeoJson];
}
