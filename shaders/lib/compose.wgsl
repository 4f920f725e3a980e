// Settings of the last pass. Twin: npr_style::compose::Compose.

struct Compose {
    light_world: vec3<f32>,
    samples: u32,
    background: vec4<f32>,
    line_color: vec4<f32>,
    background_texture: u32,
    flags: u32,
    saturation: f32,
    unused: u32,
}

const COMPOSE_MASK: u32 = 1u;
const COMPOSE_ANGLE: u32 = 2u;
const COMPOSE_RIBBONS: u32 = 4u;
const COMPOSE_STAMPS: u32 = 8u;
