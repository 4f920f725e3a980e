// Cast shadows with exact edges. Twin: npr_style::shadow.
// The shader declares `lights`, `posed`, `triangles` and `shadows`.

//# use lib/cutout
//# use lib/ink_tone
//# use lib/smoke_shadow

// Height in texels under which a triangle counts as fine.
const FINE_TEXELS: f32 = 2.0;
// Least cosine between normal and light used for the slope of a surface.
const GRAZING: f32 = 0.1;
const ENDLESS: f32 = 1e30;

// A place that a light may reach.
struct LitPoint {
    // The triangle that it lies on, plus one.
    own: u32,
    world: vec3<f32>,
    towards: vec3<f32>,
    distance: f32,
    facing: f32,
    ndc: vec2<f32>,
    texel: vec2<f32>,
    texel_world: f32,
    map: u32,
}

// A triangle in the world and as the light of a place sees it.
struct Caster {
    world: array<vec3<f32>, 3>,
    clip: array<vec4<f32>, 3>,
}

// The lights whose shadow falls on a place of triangle `id`, one bit each.
fn shadowed(id: u32, corners: Corners, weights: vec3<f32>) -> u32 {
    if lights.shadow_side == 0u { return 0u; }
    let normal = normal_of(corners, weights);
    let world = lifted(corners, weights);
    var dark = 0u;
    for (var i = 0u; i < lights.count; i++) {
        if lights.sources[i].shadow == 0u { continue; }
        let towards = towards_light(lights.sources[i], world);
        let facing = dot(normal, towards);
        if facing <= 0.0 { continue; }
        let map = lights.sources[i].shadow - 1u;
        if is_dark(id, i, world, towards, facing) || is_behind_smoke(map, world) { dark |= 1u << i; }
    }
    return dark;
}

// Whether something stands between a place and a light.
fn is_dark(own: u32, light: u32, world: vec3<f32>, towards: vec3<f32>, facing: f32) -> bool {
    let map = lights.sources[light].shadow - 1u;
    let m = lights.shadows[map];
    let clip = apply_point(m, world);
    let side = f32(lights.shadow_side);
    let ndc = clip.xy / clip.w;
    let texel = vec2<f32>((ndc.x + 1.0) * 0.5 * side, (1.0 - ndc.y) * 0.5 * side);
    if !(clip.w > 0.0 && all(texel >= vec2<f32>(0.0)) && all(texel < vec2<f32>(side))) { return false; }
    let offset = lights.sources[light].position - world;
    let is_spot = lights.sources[light].kind == LIGHT_SPOT;
    let row = vec3<f32>(m[0].x, m[1].x, m[2].x);
    var place: LitPoint;
    place.own = own;
    place.world = world;
    place.towards = towards;
    place.distance = select(ENDLESS, sqrt(dot(offset, offset)), is_spot);
    place.facing = facing;
    place.ndc = ndc;
    place.texel = texel;
    place.texel_world = 2.0 * clip.w / (sqrt(dot(row, row)) * side);
    place.map = map;
    return is_covered(place);
}

// The triangle plus one in one of the nine texels around a place; 0 if there is none.
fn seen_near(place: LitPoint, k: u32) -> u32 {
    let at = vec2<u32>(place.texel) + vec2<u32>(k % 3u, k / 3u);
    let last = vec2<u32>(lights.shadow_side - 1u);
    return textureLoad(shadows, min(max(at, vec2<u32>(1u)) - 1u, last), place.map, 0).x;
}

// Whether something covers a place: each triangle seen around it is tested; if they are finer than texels, the texels
// vote.
fn is_covered(place: LitPoint) -> bool {
    var seen: array<u32, 9>;
    var distinct = 0u;
    for (var k = 0u; k < 9u; k++) {
        seen[k] = seen_near(place, k);
        var is_new = true;
        for (var j = 0u; j < k; j++) {
            if seen[j] == seen[k] { is_new = false; }
        }
        if !is_new { continue; }
        distinct += 1u;
        if covers(place, seen[k]) { return true; }
    }
    return distinct > 1u && vote(place, seen);
}

// Whether triangle `id` lies between a place and the light.
fn covers(place: LitPoint, id: u32) -> bool {
    if id == 0u || id == place.own { return false; }
    let caster = as_lit(place, id);
    let weights = weights_at(caster.clip, place.ndc);
    if !all(weights >= vec3<f32>(0.0)) { return false; }
    return is_between(place, caster.world, weights, lights.bias_world) && !is_hole_at(id - 1u, weights);
}

fn as_lit(place: LitPoint, id: u32) -> Caster {
    let corners = triangles[id - 1u].corners;
    let m = lights.shadows[place.map];
    var caster: Caster;
    caster.world = array<vec3<f32>, 3>(posed[corners.x].world, posed[corners.y].world, posed[corners.z].world);
    caster.clip = array<vec4<f32>, 3>(
        apply_point(m, caster.world[0]),
        apply_point(m, caster.world[1]),
        apply_point(m, caster.world[2]),
    );
    return caster;
}

// Whether a point of a triangle is nearer to the light than a place by more than `gap_world`, and not behind the light.
fn is_between(place: LitPoint, world: array<vec3<f32>, 3>, weights: vec3<f32>, gap_world: f32) -> bool {
    let point = blend3(weights, world[0], world[1], world[2]);
    let gap = dot(point - place.world, place.towards);
    return gap > gap_world && gap < place.distance;
}

// Whether the texels around a place vote for a shadow.
fn vote(place: LitPoint, seen: array<u32, 9>) -> bool {
    let side = f32(lights.shadow_side);
    let facing = max(place.facing, GRAZING);
    let slope = sqrt(max(1.0 - facing * facing, 0.0)) / facing;
    let gap_world = place.texel_world * (2.0 + 2.0 * slope) + lights.bias_world;
    let corner = floor(place.texel);
    var count = 0u;
    var share = 0.0;
    for (var k = 0u; k < 9u; k++) {
        let id = seen[k];
        if id == 0u || id == place.own { continue; }
        let center = corner + vec2<f32>(f32(k % 3u), f32(k / 3u)) - 0.5;
        let ndc = vec2<f32>(2.0 * center.x / side - 1.0, 1.0 - 2.0 * center.y / side);
        let caster = as_lit(place, id);
        if !is_between(place, caster.world, weights_at(caster.clip, ndc), gap_world) { continue; }
        count += 1u;
        if is_fine(caster.clip, side) {
            let near = max(1.0 - abs(center - place.texel), vec2<f32>(0.0));
            share += near.x * near.y;
        }
    }
    return count == 9u || share > 0.5;
}

// Whether a triangle is thinner than two texels as the light sees it.
fn is_fine(clip: array<vec4<f32>, 3>, side: f32) -> bool {
    if clip[0].w <= 0.0 || clip[1].w <= 0.0 || clip[2].w <= 0.0 { return false; }
    let a = clip[0].xy / clip[0].w * 0.5 * side;
    let b = clip[1].xy / clip[1].w * 0.5 * side;
    let c = clip[2].xy / clip[2].w * 0.5 * side;
    let area = abs(cross2(b - a, c - b));
    let longest = sqrt(max(dot(b - a, b - a), max(dot(c - b, c - b), dot(a - c, a - c))));
    return area < FINE_TEXELS * longest;
}

// Ink of a triangle where shadows make it differ from place to place and it is the same all over one of them; else -1.
fn even_ink_in_shadow(part: u32, corners: Corners, dark: u32) -> f32 {
    if lights.shadow_side == 0u { return -1.0; }
    return even_ink(part, corners, dark);
}
