// smoke.shade_spheres: light on spheres, and the layer in which each is smoothed.
//
// Source  Hoshino 2004, sections 3.2 and 3.3
// Twin    npr_style::smoke::shade::shade_spheres
//
//# use lib/grid
//# use lib/geometry
//# use lib/surface
//# use lib/window
//# use lib/sphere
//# use lib/smoke
//# use lib/depth_map

@group(0) @binding(0) var<uniform> window: Window;
@group(0) @binding(1) var<uniform> lens: SphereView;
@group(0) @binding(2) var<uniform> look: SmokeLook;
@group(0) @binding(3) var<uniform> lights: Lights;
@group(0) @binding(4) var smoke_ids: texture_2d<u32>;
@group(0) @binding(5) var<storage, read> spheres: array<Sphere>;
@group(0) @binding(6) var<storage, read> balls: array<ViewSphere>;
@group(0) @binding(7) var<storage, read_write> pixels: array<SmokePixel>;
@group(0) @binding(8) var smoke_lights: texture_2d_array<u32>;
@group(0) @binding(9) var surface_depths: texture_depth_2d_array;

//# use lib/lighting

// Whether the sphere that the light sees in the texel of a place lies between place and light.
fn is_dark(own: u32, light: u32, world: vec3<f32>, towards: vec3<f32>) -> bool {
    if look.shadow_side == 0u || lights.sources[light].shadow == 0u { return false; }
    let map = lights.sources[light].shadow - 1u;
    let clip = apply_point(lights.shadows[map], world);
    let side = f32(look.shadow_side);
    let texel = vec2<f32>((clip.x / clip.w + 1.0) * 0.5 * side, (1.0 - clip.y / clip.w) * 0.5 * side);
    if !(clip.w > 0.0 && all(texel >= vec2<f32>(0.0)) && all(texel < vec2<f32>(side))) { return false; }
    let seen = textureLoad(smoke_lights, vec2<u32>(texel), map, 0).x;
    if seen == 0u || seen == own { return false; }
    let caster = spheres[seen - 1u];
    let offset = caster.center - world;
    let ahead = dot(offset, towards);
    return ahead > 0.0 && dot(offset, offset) - ahead * ahead < caster.radius * caster.radius;
}

// Whether a surface lies between a place and a light.
fn is_behind_surface(light: u32, world: vec3<f32>) -> bool {
    let number = lights.sources[light].shadow;
    if number == 0u || number > look.surface_maps { return false; }
    let map = number - 1u;
    let texels = texels_around(lights.shadows[map], look.surface_side, world);
    if !texels.is_seen { return false; }
    let low = texels.low;
    return are_nearer(texels, vec4<f32>(
        textureLoad(surface_depths, low, map, 0),
        textureLoad(surface_depths, low + vec2<u32>(1u, 0u), map, 0),
        textureLoad(surface_depths, low + vec2<u32>(0u, 1u), map, 0),
        textureLoad(surface_depths, low + vec2<u32>(1u, 1u), map, 0),
    ));
}

// Light on a place of sphere `id` with the normal `normal`, 0..1.
fn light_at(id: u32, world: vec3<f32>, normal: vec3<f32>) -> f32 {
    var sum = look.ambient;
    for (var i = 0u; i < lights.count; i++) {
        let source = lights.sources[i];
        if source.kind == LIGHT_SKY {
            sum += sky_light(source, normal, Openness(1.0, 1.0)).share;
            continue;
        }
        let reach = reach_at(source, world);
        let wrap = look.wrap;
        let facing = (dot(normal, reach.towards) + wrap) / (1.0 + wrap);
        var lit = clamp(facing, 0.0, 1.0);
        if lit > lights.shadow_at
            && (is_dark(id, i, world, reach.towards) || is_behind_surface(i, world)) { lit = lights.shadow_at; }
        sum += lit * reach.strength;
    }
    return min(sum, 1.0);
}

// The layer of a sphere whose middle lies at a depth.
fn place_of(depth: f32) -> f32 {
    let last = f32(look.layers) - 1.0;
    let place = clamp((depth - look.range_start) / look.range_size, 0.0, last);
    let whole = floor(place);
    let passed = (place - whole - (1.0 - look.range_blend)) / max(look.range_blend, 1e-6);
    return min(whole + clamp(passed, 0.0, 1.0), last);
}

// One invocation per pixel.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&pixels) { return; }
    let pixel = pixel_of(element, window.size);
    let id = textureLoad(smoke_ids, pixel, 0).x;
    var result: SmokePixel;
    result.depth = FAR_DEPTH;
    result.place = -1.0;
    if id != 0u {
        let sphere = spheres[id - 1u];
        let ball = balls[id - 1u];
        let ray = ray_at(lens, frame_at(window, pixel));
        let depth = depth_of_ball(lens, ball, ray);
        var light = 1.0;
        if (look.flags & SMOKE_UNLIT) == 0u {
            let at = place_on(lens, ray, depth);
            let normal = direction_in_world(lens, (at - ball.center) / ball.radius);
            let world = sphere.center + normal * sphere.radius;
            light = light_at(id, world, normal);
        }
        result.tone = light + (clamp(sphere.heat, 0.0, 1.0) - light) * look.heat;
        result.depth = depth;
        result.place = place_of(ball.center.z);
    }
    pixels[element] = result;
}
