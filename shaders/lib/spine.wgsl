// Samples of lines, and how what is seen of them is drawn. Twin: npr_vector::sampled.

struct SpineSample {
    spine_px: vec2<f32>,
    depth: f32,
    line: u32,
    px: vec2<f32>,
    half_width: f32,
    color: u32,
}

const LINE_START_FREE: u32 = 1u;
const LINE_END_FREE: u32 = 2u;
const LINE_CLOSED: u32 = 4u;
const LINE_ONCE: u32 = 8u;
const LINE_WIDTH_SHIFT: u32 = 8u;

struct SampledLine {
    first: u32,
    count: u32,
    step_px: f32,
    ink_flags: u32,
    u_start: f32,
    u_per_px: f32,
    full_half_width: f32,
    bits: u32,
}

struct PartWidth {
    along: array<vec4<f32>, 8>,
    taper_px: vec2<f32>,
    taper_share: f32,
    tip: f32,
    short_px: f32,
    speck_px: f32,
    at_all_ends: u32,
    radius: u32,
}

struct PartWidths { all: array<PartWidth, 64> }
