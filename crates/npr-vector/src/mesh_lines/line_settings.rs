//! Which lines of a view are wanted, and how.

pub use npr_core::line_source::LineSource;

/// Which lines are wanted, and how.
#[derive(Debug, Clone, PartialEq)]
pub struct LineSettings {
    /// Width and height of the picture in pixels.
    pub size: [u32; 2],
    /// Bits of [`KindSet::BITS`](npr_core::line_kind::KindSet::BITS).
    pub kinds: u32,
    /// How contours are found: across faces, or along edges of meshes, from which pictures start too.
    pub method: LineSource,
    /// Smooths strokes, joins their ends, and leaves out what is too short to read.
    pub smooth: bool,
    /// Gives hidden lines too, with the number of surfaces in front.
    pub hidden: bool,
    /// Turn, in radians, from which strokes are cut at a corner; `None` for never.
    pub split: Option<f32>,
    /// Most bytes that the lines of a view may take.
    pub memory_limit: u64,
}

/// How far smooth contours may leave the polygons' outline, in pixels.
pub(crate) const OUTLINE_TOLERANCE_PX: f64 = 2.0;
