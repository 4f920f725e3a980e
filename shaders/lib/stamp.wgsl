// Discs of ink. Twin: npr_core::geometry::Stamp.

// Side of the square tiles in which stamps are looked for, in mask pixels.
const TILE: u32 = 16u;

// How far along a line stamps are averaged, in mask pixels.
const SMOOTHING_REACH: u32 = 3u;

// A disc in frame pixels; half width 0 where there is none.
struct Stamp {
    center: vec2<f32>,
    half_width: f32,
    part: u32,
}
