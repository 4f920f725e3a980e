// The structs that passes share. Twin: npr_core::geometry.

//# use lib/line_kind

const NONE: u32 = 0xffffffffu;
const FAR_DEPTH: f32 = 1e30;

struct Vertex {
    position: vec3<f32>,
    color: u32,
    normal: vec3<f32>,
    direction: u32,
    uv: vec2<f32>,
    curvatures: vec2<f32>,
    weld_normal: u32,
    width: f32,
    part: u32,
    pen: u32,
}

struct Influence {
    joints: vec4<u32>,
    weights: vec4<f32>,
}

struct PosedVertex {
    clip: vec4<f32>,
    world: vec3<f32>,
    depth: f32,
    normal: vec3<f32>,
    half_width: f32,
}

struct Triangle {
    corners: vec3<u32>,
    part: u32,
}

struct ChartCorners {
    a: vec2<f32>,
    b: vec2<f32>,
    c: vec2<f32>,
}

const CHART_TEXELS: u32 = 6u;
const CHART_ACROSS: u32 = 1024u;

struct Edge {
    ends: vec2<u32>,
    faces: vec2<u32>,
    dihedral_cos: f32,
    traits: u32,
}

struct EdgeRole {
    kinds: u32,
    part: u32,
}

struct Part {
    base_color: vec4<f32>,
    line_color: vec4<f32>,
    ink_color: vec4<f32>,
    object: u32,
    material: u32,
    texture: u32,
    flags: u32,
    width_factor: f32,
    facing_threshold: f32,
    alpha_cutoff: f32,
    softness: f32,
    hatch: u32,
    dark_at: f32,
    light_at: f32,
    threshold: f32,
    spacing_px: f32,
    hatch_gain: f32,
    second_from: f32,
    tile_scale: f32,
    turn: vec2<f32>,
    paint_color: u32,
    tone_row: u32,
    highlight_color: vec4<f32>,
    back_color: vec4<f32>,
    highlight: vec4<f32>,
    highlight_shape: vec4<f32>,
    highlight_turn: vec4<f32>,
    back: vec4<f32>,
    beam_alpha: vec4<f32>,
    ramp: array<vec4<f32>, 8>,
    line_flags: u32,
    line_factor: f32,
    line_texture: u32,
    line_depth_row: u32,
    line_light_row: u32,
    line_tint: u32,
    line_rim: f32,
    component: u32,
    line_depth: vec2<f32>,
    line_opacity: vec2<f32>,
    line_width: vec2<f32>,
    streak_across: vec2<f32>,
    back_direction: vec3<f32>,
    line_kinds: array<u32, COLORED_KINDS>,
    hatch_grain: f32,
    spots_per_px: f32,
    toon: u32,
    tone_reach_px: f32,
}

const PART_DOUBLE_SIDED: u32 = 1u;
const PART_CUTOUT: u32 = 2u;
const PART_LINES: u32 = 4u;
const PART_UNLIT: u32 = 8u;
const PART_INK: u32 = 16u;
const PART_HATCH: u32 = 32u;
const PART_ON_SCREEN: u32 = 64u;
const PART_ON_SURFACE: u32 = 128u;
const PART_ISOTROPIC: u32 = 256u;
const PART_TWO_LAYERS: u32 = 512u;
const PART_CRISP: u32 = 1024u;
const PART_SOFT: u32 = 2048u;
const PART_PHONG: u32 = 4096u;
const PART_BACK_LIGHT: u32 = 8192u;
const PART_STREAK: u32 = 16384u;
const PART_HIGHLIGHTS: u32 = 27648u;
const PART_BEAM: u32 = 32768u;
const PART_BEAM_COVERS: u32 = 65536u;
const PART_BEAM_BEHIND: u32 = 131072u;
const PART_HULL: u32 = 262144u;
const PART_ANGLE: u32 = 524288u;
const PART_PAINTED: u32 = 1048576u;
const PART_PLAIN: u32 = 2097152u;
const PART_TONE_ROW: u32 = 4194304u;
const PART_TOON: u32 = 8388608u;
const PART_TOON_LINE: u32 = 16777216u;
const PART_WORLD_LINE: u32 = 33554432u;
const PART_SPARED: u32 = 67108864u;
const PART_CUT: u32 = 134217728u;
const PART_FOLDS: u32 = 1073741824u;

const LINE_KINDS: u32 = KINDS_COLORED;
const LINE_SURFACE: u32 = KINDS_END;
const LINE_VERTEX: u32 = KINDS_END << 1u;
const LINE_TEXTURE: u32 = KINDS_END << 2u;
const LINE_DEPTH: u32 = KINDS_END << 3u;
const LINE_FROM_MIDDLE: u32 = KINDS_END << 4u;
const LINE_LIGHT: u32 = KINDS_END << 5u;
const LINE_OPACITY: u32 = KINDS_END << 6u;
const LINE_TINT: u32 = KINDS_END << 7u;
const LINE_RIM: u32 = KINDS_END << 8u;
const LINE_WIDTH: u32 = KINDS_END << 9u;
const LINE_SOURCES: u32 = LINE_SURFACE | LINE_VERTEX | LINE_TEXTURE;
const LINE_PLACED: u32 = LINE_SOURCES | LINE_DEPTH | LINE_LIGHT | LINE_TINT | LINE_RIM | LINE_OPACITY;

struct GPixel {
    plane_step: vec2<f32>,
    depth: f32,
    half_width: f32,
    normal: u32,
    part: u32,
}

const HULL_BIT: u32 = 0x80000000u;
const ID_MASK: u32 = 0x7fffffffu;
