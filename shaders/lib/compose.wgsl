// Settings of the last pass. Twin: npr_style::compose::Compose.

struct Compose {
    background: vec4<f32>,
    line_color: vec4<f32>,
    background_texture: u32,
    flags: u32,
    saturation: f32,
    samples: u32,
    right_world: vec3<f32>,
    smoke_shadow_side: u32,
    up_world: vec3<f32>,
    radius: f32,
    near_world: vec3<f32>,
    angle_softness: f32,
    center_world: vec3<f32>,
    smoke_part: u32,
    smoke_line: vec4<f32>,
    smoke_anchor_px: vec2<f32>,
    smoke_tiles: f32,
    background_texel: u32,
}

const COMPOSE_RIBBONS: u32 = 1u;
const COMPOSE_OVERLAY: u32 = 2u;
const COMPOSE_BEAMS: u32 = 4u;
const COMPOSE_SMOKE: u32 = 8u;
const COMPOSE_SMOKE_PEN: u32 = 16u;
const COMPOSE_LINES_IN_SRGB: u32 = 32u;
const COMPOSE_BACKDROP: u32 = 64u;
const COMPOSE_BARE: u32 = 128u;

// A vector in the camera's axes as one in the world.
fn in_world(compose: Compose, direction: vec3<f32>) -> vec3<f32> {
    return compose.right_world * direction.x + compose.up_world * direction.y + compose.near_world * direction.z;
}
