//! Points of strokes, as the pass that inks them into a frame reads them.

use bytemuck::{Pod, Zeroable};
use npr_core::gpu_layout;

/// A point of a stroke, ready to be drawn into a frame.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct InkPoint {
    /// Place in the frame, in pixels from its top left corner, y down.
    pub px: [f32; 2],
    /// Half the width of the stroke here, in pixels.
    pub half_width: f32,
    /// 1 at the near plane, falling with depth to 0: of lines that cover a pixel alike, the nearer shows.
    pub nearness: f32,
    /// sRGB bytes and alpha, red lowest.
    pub color: u32,
    /// [`InkPoint::GOES_ON`] and the other bits, and the number of its brush from [`InkPoint::BRUSH_SHIFT`] on.
    pub flags: u32,
    /// Place along the image of the brush, which repeats from each whole number to the next.
    pub u: f32,
    /// Share of full pressure, 0..1.
    pub pressure: f32,
}
gpu_layout!(InkPoint {
    px,
    half_width,
    nearness,
    color,
    flags,
    u,
    pressure
});

impl InkPoint {
    /// The stroke is drawn from here to the point behind this one in the list.
    pub const GOES_ON: u32 = 1;
    /// The stroke runs on to that point, whether this piece of it is drawn or, of a ring, another one like it.
    pub const JOINED: u32 = 2;
    /// The image of the brush is turned over, left to right.
    pub const MIRRORED: u32 = 4;
    /// The piece from here to the next point is a stamp: the image of the brush lies once on it and ends at its sides.
    pub const STAMP: u32 = 8;
    /// The stamp is round: its ink falls off all around as it does across the image.
    pub const ROUND: u32 = 16;
    /// The lowest bit of the number of the brush.
    pub const BRUSH_SHIFT: u32 = 8;

    /// Whether the stroke is drawn from here to the point behind this one in the list.
    pub fn goes_on(&self) -> bool {
        self.flags & Self::GOES_ON != 0
    }
}
