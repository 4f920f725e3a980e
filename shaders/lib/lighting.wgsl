// The lights of a frame. Twin: npr_style::lighting. The shader declares `lights: Lights`.

//# use lib/step
//# use lib/color

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

// Whether tones depend on the normal alone, apart from shadows.
fn only_distant() -> bool {
    return lights.count == 1u && lights.sources[0].kind == LIGHT_DISTANT && lights.sources[0].intensity == 1.0;
}

fn fading(distance: f32, range: f32) -> f32 {
    if range <= 0.0 { return 1.0; }
    let ratio = distance / range;
    let left = max(1.0 - ratio * ratio, 0.0);
    return left * left;
}

// Whether a light comes from the same direction everywhere.
fn is_far(source: LightSource) -> bool {
    return source.kind == LIGHT_DISTANT || source.kind == LIGHT_SKY;
}

fn towards_light(source: LightSource, world: vec3<f32>) -> vec3<f32> {
    if is_far(source) { return source.direction; }
    return unit_or_z(source.position - world);
}

// Unit vector from a place towards a light, and how strong it shines there.
struct Reach {
    towards: vec3<f32>,
    strength: f32,
}

fn reach_at(source: LightSource, world: vec3<f32>) -> Reach {
    var reach: Reach;
    reach.towards = source.direction;
    reach.strength = source.intensity;
    if is_far(source) { return reach; }
    let offset = source.position - world;
    let distance = sqrt(dot(offset, offset));
    reach.towards = unit_or_z(offset);
    reach.strength = source.intensity * fading(distance, source.range);
    if source.kind == LIGHT_SPOT {
        reach.strength *= smooth_step(source.cone.x, source.cone.y, -dot(reach.towards, source.direction));
    }
    return reach;
}

// What a light adds to the ramp coordinate of a surface at a place, at most `most` times its strength there.
fn share_at(source: LightSource, world: vec3<f32>, normal: vec3<f32>, most: f32) -> f32 {
    let reach = reach_at(source, world);
    return min(ramp_coordinate(dot(normal, reach.towards)), most) * reach.strength;
}

// Share of the sky and of the ground below that shines on a surface, 0..1.
struct Openness {
    above: f32,
    below: f32,
}

// The light of a sky on a surface.
struct SkyLight {
    // What it adds to the ramp coordinate.
    share: f32,
    // Colour of its light, times `share`.
    color: vec3<f32>,
}

// Light from the picture of the sky on a surface that faces along a unit vector.
fn dome_at(normal: vec3<f32>) -> vec3<f32> {
    var sum = lights.dome[0].rgb;
    sum += lights.dome[1].rgb * normal.x;
    sum += lights.dome[2].rgb * normal.y;
    sum += lights.dome[3].rgb * normal.z;
    sum += lights.dome[4].rgb * (normal.x * normal.y);
    sum += lights.dome[5].rgb * (normal.y * normal.z);
    sum += lights.dome[6].rgb * (normal.x * normal.z);
    sum += lights.dome[7].rgb * (3.0 * normal.z * normal.z - 1.0);
    sum += lights.dome[8].rgb * (normal.x * normal.x - normal.y * normal.y);
    return max(sum, vec3<f32>(0.0));
}

// Light of a sky on a surface that faces along a unit vector and sees `open` of it.
fn sky_light(source: LightSource, normal: vec3<f32>, open: Openness) -> SkyLight {
    let is_hidden = (source.sky & SKY_HIDDEN) != 0u;
    let upper = clamp(ramp_coordinate(dot(normal, source.direction)), 0.0, 1.0);
    let above = upper * select(1.0, open.above, is_hidden) * source.intensity;
    var below = (1.0 - upper) * select(1.0, open.below, is_hidden) * source.intensity;
    var given: SkyLight;
    if (source.sky & SKY_PICTURE) != 0u {
        let light = dome_at(normal);
        let strength = above + below;
        given.share = dot(light, LUMA) * strength;
        given.color = light * source.color * strength;
        return given;
    }
    below *= source.ground_strength;
    given.share = above + below;
    given.color = source.color * above + source.ground * below;
    return given;
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
    var sum = 0.0;
    var color = vec3<f32>(0.0);
    for (var i = 0u; i < lights.count; i++) {
        if lights.sources[i].kind == LIGHT_SKY {
            let light = sky_light(lights.sources[i], normal, open);
            sum += light.share;
            color += light.color;
            continue;
        }
        let most = select(1.0, lights.shadow_at, ((dark >> i) & 1u) != 0u);
        let share = share_at(lights.sources[i], world, normal, most);
        sum += share;
        color += lights.sources[i].color * share;
    }
    lit.x = min(sum, 1.0);
    lit.color = select(vec3<f32>(1.0), color / max(sum, 1e-6), sum > 1e-6);
    return lit;
}
