// Toon materials as MToon draws them. Twin: npr_style::toon.
// The shader declares `view`, `compose`, `lights`, `posed`, `vertices`, `triangles`, `parts` and `texels`.

//# use lib/surface_color
//# use lib/lighting
//# use lib/line_place

const TOON_SHADE: u32 = 0u;
const TOON_RIM: u32 = 4u;
const TOON_MATCAP: u32 = 8u;
const TOON_EMISSIVE: u32 = 12u;
const TOON_OUTLINE: u32 = 16u;
const TOON_SHIFT: u32 = 20u;
const TOON_MAPS: u32 = 23u;
const TOON_MATCAP_MAP: u32 = 58u;
const TOON_MAP_WORDS: u32 = 7u;
const TOON_LAID: u32 = 5u;

// Least half width of the border, in cosines: a harder one has none.
const HARD: f32 = 1e-5;

// Whether a part is drawn as a toon.
fn is_toon(part: u32) -> bool {
    return (parts[part].flags & PART_TOON) != 0u;
}

// Whether the hull of a part has the colour of its toon material.
fn has_toon_line(part: u32) -> bool {
    return (parts[part].flags & PART_TOON_LINE) != 0u;
}

// Number `at` of a toon material that starts at `toon`.
fn toon_number(toon: u32, at: u32) -> f32 {
    return bitcast<f32>(texels[toon + at]);
}

fn toon_color(toon: u32, at: u32) -> vec3<f32> {
    return vec3<f32>(toon_number(toon, at), toon_number(toon, at + 1u), toon_number(toon, at + 2u));
}

// Coordinates of the picture whose description starts at `map`, at those of the vertices.
fn toon_uv(map: u32, uv: vec2<f32>) -> vec2<f32> {
    let along = vec2<f32>(toon_number(map, 1u), toon_number(map, 4u));
    let across = vec2<f32>(toon_number(map, 2u), toon_number(map, 5u));
    return along * uv.x + across * uv.y + vec2<f32>(toon_number(map, 3u), toon_number(map, 6u));
}

// Coordinates of the vertices at a place, to its right and below.
struct ToonUvs {
    here: vec2<f32>,
    right: vec2<f32>,
    down: vec2<f32>,
}

// Colour of the picture whose description starts at `map`; white without one.
fn toon_map(map: u32, uvs: ToonUvs) -> vec3<f32> {
    let texture = texels[map];
    if texture == NONE { return vec3<f32>(1.0); }
    let uv = toon_uv(map, uvs.here);
    return sample_texture(texture, uv, footprint(uv, toon_uv(map, uvs.right), toon_uv(map, uvs.down))).rgb;
}

// How lit a surface is, 0..1: a straight line over the border.
fn toon_shading(n_dot_l: f32, shift: f32, toony: f32) -> f32 {
    let half = max(1.0 - toony, HARD);
    return clamp((n_dot_l + shift + half) / (2.0 * half), 0.0, 1.0);
}

// Strength of the rim, 0..1.
fn toon_rim(n_dot_v: f32, lift: f32, power: f32) -> f32 {
    let base = clamp(1.0 - n_dot_v + lift, 0.0, 1.0);
    if base <= 0.0 { return 0.0; }
    return pow(base, power);
}

// Where a matcap is looked up: by normal and eye in the camera's axes.
fn matcap_uv(normal: vec3<f32>, eye: vec3<f32>) -> vec2<f32> {
    let x = unit_or_z(vec3<f32>(eye.z, 0.0, -eye.x));
    let y = vec3<f32>(
        eye.y * x.z - eye.z * x.y,
        eye.z * x.x - eye.x * x.z,
        eye.x * x.y - eye.y * x.x,
    );
    return vec2<f32>(0.5 + 0.5 * dot(x, normal), 0.5 - 0.5 * dot(y, normal));
}

// What of a toon material is looked up in pictures, at one place.
struct ToonPaint {
    base: vec3<f32>,
    shade: vec3<f32>,
    shift: f32,
    rim: vec3<f32>,
    emissive: vec3<f32>,
}

// What a toon material's pictures show at a point of the frame; on a hull, at the nearest point of its triangle.
fn toon_paint(triangle: Triangle, corners: Corners, px: vec2<f32>, is_hull: bool) -> ToonPaint {
    let part = triangle.part;
    let toon = parts[part].toon;
    var uvs: ToonUvs;
    uvs.here = uv_at(triangle, line_weights(corners, px, is_hull));
    uvs.right = uv_at(triangle, line_weights(corners, px + vec2<f32>(1.0, 0.0), is_hull));
    uvs.down = uv_at(triangle, line_weights(corners, px + vec2<f32>(0.0, 1.0), is_hull));
    var paint: ToonPaint;
    paint.shift = toon_number(toon, TOON_SHIFT);
    // Look up one picture after the other by the same code, which takes long to compile.
    for (var i = 0u; i < TOON_LAID; i++) {
        let map = toon + TOON_MAPS + TOON_MAP_WORDS * i;
        let color = toon_map(map, uvs);
        switch i {
            case 0u: { paint.base = strengthened(parts[part].base_color.rgb * color); }
            case 1u: { paint.shade = strengthened(toon_color(toon, TOON_SHADE) * color); }
            case 2u: {
                // The shift is a number, not light.
                let scale = select(toon_number(toon, TOON_SHIFT + 1u), 0.0, texels[map] == NONE);
                paint.shift += srgb_from_linear(color.r) * scale;
            }
            case 3u: { paint.rim = color; }
            default: { paint.emissive = toon_color(toon, TOON_EMISSIVE) * color; }
        }
    }
    return paint;
}

// Light of a sky, equalised as far as the material asks for.
fn toon_sky(toon: u32, source: LightSource, normal: vec3<f32>, open: Openness) -> vec3<f32> {
    // Ask for one direction after the other by the same code, which takes long to compile.
    var light = array<vec3<f32>, 3>();
    for (var i = 0u; i < 3u; i++) {
        let upright = vec3<f32>(0.0, select(1.0, -1.0, i == 1u), 0.0);
        light[i] = sky_light(source, select(upright, normal, i == 2u), open).color;
    }
    let even = (light[0] + light[1]) * 0.5;
    return light[2] + (even - light[2]) * toon_number(toon, TOON_SHIFT + 2u);
}

// Light of a toon at `world` with the normal `normal`, in the shadow of the lights in `dark`, that sees `open` of the
// sky.
fn toon_light(
    part: u32,
    paint: ToonPaint,
    world: vec3<f32>,
    normal: vec3<f32>,
    dark: u32,
    open: Openness,
) -> vec3<f32> {
    let toon = parts[part].toon;
    let toony = toon_number(toon, TOON_SHADE + 3u);
    var sum = vec3<f32>(0.0);
    var lighting = vec3<f32>(0.0);
    for (var i = 0u; i < lights.count; i++) {
        if lights.sources[i].kind == LIGHT_SKY {
            let light = toon_sky(toon, lights.sources[i], normal, open);
            sum += paint.base * light;
            lighting += light;
            continue;
        }
        let reach = reach_at(lights.sources[i], world);
        var shading = 0.0;
        if ((dark >> i) & 1u) == 0u { shading = toon_shading(dot(normal, reach.towards), paint.shift, toony); }
        let light = lights.sources[i].color * reach.strength;
        sum += (paint.shade + (paint.base - paint.shade) * shading) * light;
        lighting += light;
    }

    // Add rim and matcap, and what the surface gives off.
    let eye = to_eye(view, world);
    let rim = toon_rim(dot(normal, eye), toon_number(toon, TOON_MATCAP + 3u), toon_number(toon, TOON_RIM + 3u));
    var added = toon_color(toon, TOON_RIM) * rim;
    let matcap = texels[toon + TOON_MATCAP_MAP];
    if matcap != NONE {
        let facing = vec3<f32>(
            dot(normal, compose.right_world), dot(normal, compose.up_world), dot(normal, compose.near_world),
        );
        let seen = vec3<f32>(
            dot(eye, compose.right_world), dot(eye, compose.up_world), dot(eye, compose.near_world),
        );
        let uv = toon_uv(toon + TOON_MATCAP_MAP, matcap_uv(facing, seen));
        added += toon_color(toon, TOON_MATCAP) * sample_texture(matcap, uv, 0.0).rgb;
    }
    let share = vec3<f32>(1.0) + (lighting - vec3<f32>(1.0)) * toon_number(toon, TOON_EMISSIVE + 3u);
    return sum + added * paint.rim * share + paint.emissive;
}

// Weights of a triangle's corners at a point of the frame, or on a toon's hull those of its nearest point.
fn toon_weights(corners: Corners, px: vec2<f32>, is_hull: bool) -> vec3<f32> {
    return line_weights(corners, px, is_hull);
}

// Whether light falls on the outline of a toon.
fn is_toon_line_lit(part: u32) -> bool {
    return toon_number(parts[part].toon, TOON_OUTLINE + 3u) != 0.0;
}

// Light of a toon's outline on its hull, where `light` is that of the toon there.
fn toon_outline(part: u32, light: vec3<f32>) -> vec3<f32> {
    let toon = parts[part].toon;
    let share = toon_number(toon, TOON_OUTLINE + 3u);
    return toon_color(toon, TOON_OUTLINE) * (vec3<f32>(1.0) + (light - vec3<f32>(1.0)) * share);
}
