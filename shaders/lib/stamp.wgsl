// Discs of ink. Twins: npr_core::geometry::Stamp and npr_vector::screen::residual.

//# use lib/ribbon

// How far along a line stamps are averaged, in mask pixels.
const SMOOTHING_REACH: u32 = 3u;

// A disc in frame pixels; half width 0 where there is none.
struct Stamp {
    center: vec2<f32>,
    half_width: f32,
    part: u32,
}

// The share of the pixel around a point of the frame that a stamp covers.
fn stamp_coverage(stamp: Stamp, px: vec2<f32>) -> f32 {
    let off = px - stamp.center;
    return line_coverage(sqrt(off.x * off.x + off.y * off.y), stamp.half_width);
}
