// The structs that passes share. Twin: npr_core::geometry.

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
    unused: u32,
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

struct Edge {
    ends: vec2<u32>,
    faces: vec2<u32>,
    dihedral_cos: f32,
    traits: u32,
}

const EDGE_MATERIAL: u32 = 1u;
const EDGE_FLIPPED: u32 = 2u;

struct Part {
    base_color: vec4<f32>,
    line_color: vec4<f32>,
    object: u32,
    material: u32,
    texture: u32,
    flags: u32,
    width_factor: f32,
    facing_threshold: f32,
    alpha_cutoff: f32,
    softness: f32,
    ramp: array<vec4<f32>, 8>,
}

const PART_DOUBLE_SIDED: u32 = 1u;
const PART_CUTOUT: u32 = 2u;
const PART_LINES: u32 = 4u;
const PART_UNLIT: u32 = 8u;

struct GPixel {
    plane_step: vec2<f32>,
    depth: f32,
    half_width: f32,
    normal: u32,
    object: u32,
    material: u32,
    part: u32,
}

const HULL_BIT: u32 = 0x80000000u;
const ID_MASK: u32 = 0x7fffffffu;
