// Settings of outlines. Twin: npr_core::outline.

//# use lib/line_kind

struct Outline {
    base_width: f32,
    min_factor: f32,
    max_factor: f32,
    gain: f32,
    radius_world: f32,
    crease_cos: f32,
    depth_threshold: f32,
    normal_cos: f32,
    kinds: u32,
    detects: u32,
    flags: u32,
    reach_px: u32,
}

const DETECT_DEPTH: u32 = 1u;
const DETECT_NORMAL: u32 = 2u;
const DETECT_OBJECT: u32 = 4u;
const DETECT_MATERIAL: u32 = 8u;
const DETECT_PLANE_DEPTH: u32 = 16u;
const DETECT_PIECE: u32 = 32u;
const PIECE_COS: f32 = 0.99;

const OUTLINE_WORLD_WIDTH: u32 = 1u;
const OUTLINE_PROJECTED_CURVATURE: u32 = 2u;
const OUTLINE_PUBLISHED: u32 = 4u;
const OUTLINE_UNMASKED: u32 = 8u;

const MASK_KINDS: u32 = 47u;
const MASK_OWNER: u32 = 16u;
const MASK_SIDE: u32 = 256u;

fn width_factor(least: f32, greatest: f32, share: f32) -> f32 {
    return least + (greatest - least) * share;
}

fn width_of_curvature(curvature: f32, gain: f32) -> f32 {
    let x = abs(curvature) * gain;
    return x / (1.0 + x);
}
