// The lights of a frame. Twin: npr_style::lighting. The shader declares `lights: Lights`.

//# use lib/step
//# use lib/color
//# use lib/many_lights

struct LightSource {
    position: vec3<f32>,
    kind: u32,
    direction: vec3<f32>,
    intensity: f32,
    color: vec3<f32>,
    range: f32,
    cone: vec2<f32>,
    shadow: u32,
    sky: u32,
    ground: vec3<f32>,
    ground_strength: f32,
}

struct Lights {
    count: u32,
    shadow_side: u32,
    shadow_at: f32,
    bias_world: f32,
    sources: array<LightSource, 16>,
    shadows: array<mat4x4<f32>, 4>,
    sky_center: vec3<f32>,
    sky_radius: f32,
    sky_maps: u32,
    sky_views: u32,
    sky_side: u32,
    sky_unused: u32,
    dome: array<vec4<f32>, 9>,
}

const LIGHT_DISTANT: u32 = 0u;
const LIGHT_SPOT: u32 = 2u;
const LIGHT_SKY: u32 = 3u;
const SKY_HIDDEN: u32 = 1u;
const SKY_PICTURE: u32 = 2u;

struct Lit {
    // Place on the ramp, 0..1.
    x: f32,
    color: vec3<f32>,
}

fn ramp_coordinate(n_dot_l: f32) -> f32 {
    return (n_dot_l + 1.0) * 0.5;
}

// Whether a light comes from the same direction everywhere.
fn is_far(source: LightSource) -> bool {
    return source.kind == LIGHT_DISTANT || source.kind == LIGHT_SKY;
}

// Share of the sky and of the ground below that shines on a surface, 0..1.
struct Openness {
    above: f32,
    below: f32,
}

// Bit `i` of `dark` says that the place lies in the shadow of light `i`. Nothing hides the sky.
fn coordinate_at(world: vec3<f32>, normal: vec3<f32>, dark: u32) -> Lit {
    return coordinate_under(world, normal, dark, Openness(1.0, 1.0));
}

// `coordinate_at` for a place that sees the shares `open` of the sky.
fn coordinate_under(world: vec3<f32>, normal: vec3<f32>, dark: u32, open: Openness) -> Lit {
    var lit: Lit;
    // The usual case: one sun, whose colour is the mean.
    if only_distant() && dark == 0u {
        let x = ramp_coordinate(dot(normal, lights.sources[0].direction));
        lit.x = min(x, 1.0);
        lit.color = select(vec3<f32>(1.0), lights.sources[0].color, x > 1e-6);
        return lit;
    }
    return lit_by_all(world, normal, dark, open);
}
