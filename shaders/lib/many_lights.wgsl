// Lights that are not one sun: several, near, strong or weak, or a sky. Twin: npr_style::lighting.

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

// The light of all sources on a place.
fn lit_by_all(world: vec3<f32>, normal: vec3<f32>, dark: u32, open: Openness) -> Lit {
    var lit: Lit;
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
