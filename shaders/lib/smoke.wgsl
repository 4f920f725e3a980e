// Settings of smoke. Twin: npr_style::smoke::SmokeLook.

struct SmokeLook {
    layers: u32,
    shift: u32,
    taps: u32,
    flags: u32,
    cells: vec2<u32>,
    range_start: f32,
    range_size: f32,
    range_blend: f32,
    softness: f32,
    heat: f32,
    wrap: f32,
    line_px: f32,
    line_inner: f32,
    line_from: f32,
    line_weight: f32,
    depth_start: f32,
    depth_size: f32,
    swell: f32,
    alpha: f32,
    line_color: vec4<f32>,
    towards_light: vec3<f32>,
    ambient: f32,
    samples: u32,
    shadow_side: u32,
    surface_maps: u32,
    surface_side: u32,
    kernel: array<vec4<f32>, 3>,
    ramp: array<vec4<f32>, 8>,
}

const SMOKE_PUBLISHED: u32 = 1u;
const SMOKE_UNLIT: u32 = 2u;

// Share of a pixel at `place` in a layer; 0 for a pixel without smoke.
fn share_of(place: f32, layer: u32) -> f32 {
    if place < 0.0 { return 0.0; }
    return max(1.0 - abs(place - f32(layer)), 0.0);
}

// Index of the first cell of a layer in row `y`.
fn row_start(look: SmokeLook, y: u32, layer: u32) -> u32 {
    return (y * look.layers + layer) * look.cells.x;
}
