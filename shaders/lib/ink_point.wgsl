// Points of strokes, and the brushes that draw them. Twins: npr_vector::ink_point, npr_vector::brush.

const INK_GOES_ON: u32 = 1u;
const INK_JOINED: u32 = 2u;
const INK_MIRRORED: u32 = 4u;
const INK_STAMP: u32 = 8u;
const INK_ROUND: u32 = 16u;
const INK_BRUSH_SHIFT: u32 = 8u;

struct InkPoint {
    px: vec2<f32>,
    half_width: f32,
    nearness: f32,
    color: u32,
    flags: u32,
    u: f32,
    pressure: f32,
}

struct Brush {
    start: u32,
    texels_along: u32,
    texels_across: u32,
    levels: u32,
    dry: f32,
    grain: f32,
    soft: f32,
    spots_per_px: f32,
}
