// shade.compose_frame: surfaces shaded by their ramps, lines over them, background behind.
//
// Several samples per pixel say which triangles it shows; each triangle is shaded once,
// at the middle of its samples. Light is summed linearly and encoded at the end.
//
// Source  Suzuki 2004, section 3.2 (B14-B16) for the ramp; Porter & Duff 1984 for the layers
// Twin    npr_style::compose::compose
//
//# use lib/grid
//# use lib/geometry
//# use lib/surface
//# use lib/window
//# use lib/color
//# use lib/compose

override WG: u32 = 64u;

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var<uniform> window: Window;
@group(0) @binding(2) var<uniform> mask_window: Window;
@group(0) @binding(3) var<uniform> compose: Compose;
@group(0) @binding(4) var ids: texture_2d<u32>;
@group(0) @binding(5) var ribbons: texture_2d<f32>;
@group(0) @binding(6) var<storage, read> posed: array<PosedVertex>;
@group(0) @binding(7) var<storage, read> vertices: array<Vertex>;
@group(0) @binding(8) var<storage, read> triangles: array<Triangle>;
@group(0) @binding(9) var<storage, read> parts: array<Part>;
@group(0) @binding(10) var<storage, read> texels: array<u32>;
@group(0) @binding(11) var<storage, read> mask: array<u32>;
@group(0) @binding(12) var<storage, read> stamped: array<u32>;
@group(0) @binding(13) var<storage, read_write> frame: array<u32>;

//# use lib/texture

const MASK_KINDS: u32 = 47u;

// How far beside the tones of its corners a flat triangle's tone may lie, in ramp coordinate: rounding.
const TONE_ROOM: f32 = 0.002;

struct Corners {
    clip: array<vec4<f32>, 3>,
    normals: array<vec3<f32>, 3>,
    // 1 where the front is seen, -1 where the back is.
    side: f32,
}

fn corners_of(triangle: Triangle) -> Corners {
    let a = posed[triangle.corners.x];
    let b = posed[triangle.corners.y];
    let c = posed[triangle.corners.z];
    var corners: Corners;
    corners.clip = array<vec4<f32>, 3>(a.clip, b.clip, c.clip);
    corners.normals = array<vec3<f32>, 3>(a.normal, b.normal, c.normal);
    corners.side = select(-1.0, 1.0, faces_eye(corners.clip));
    return corners;
}

// Light of a ramp at coordinate `x`: each step takes over where its coordinate begins.
fn ramp_light(part: u32, x: f32) -> vec3<f32> {
    var light = parts[part].ramp[0].rgb;
    for (var i = 1u; i < 8u; i++) {
        let stop = parts[part].ramp[i];
        if stop.a > 1.5 { break; }
        light += (stop.rgb - light) * step_share(stop.a, parts[part].softness, x);
    }
    return light;
}

fn step_share(at: f32, softness: f32, x: f32) -> f32 {
    if softness <= 0.0 { return select(0.0, 1.0, x >= at); }
    let t = clamp((x - at) / softness + 0.5, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

fn ramp_coordinate(normal: vec3<f32>) -> f32 {
    return (dot(normal, compose.light_world) + 1.0) * 0.5;
}

// Whether the whole triangle lies within one tone.
fn is_one_tone(part: u32, corners: Corners) -> bool {
    if (parts[part].flags & PART_UNLIT) != 0u { return true; }
    let a = ramp_coordinate(corners.normals[0] * corners.side);
    let b = ramp_coordinate(corners.normals[1] * corners.side);
    let c = ramp_coordinate(corners.normals[2] * corners.side);
    // A blend of normals that is made unit again bulges beyond them by at most what they differ.
    let apart = min(
        dot(corners.normals[0], corners.normals[1]),
        min(dot(corners.normals[1], corners.normals[2]), dot(corners.normals[2], corners.normals[0])),
    );
    let room = TONE_ROOM + 0.5 * (1.0 - apart) + parts[part].softness * 0.5;
    let low = min(a, min(b, c)) - room;
    let high = max(a, max(b, c)) + room;
    for (var i = 1u; i < 8u; i++) {
        let at = parts[part].ramp[i].a;
        if at > low && at <= high { return false; }
    }
    return true;
}

// Light on a surface that faces along `normal`.
fn light_of(part: u32, normal: vec3<f32>) -> vec3<f32> {
    if (parts[part].flags & PART_UNLIT) != 0u { return vec3<f32>(1.0); }
    return ramp_light(part, ramp_coordinate(normal));
}

// Tone and ink at one point: rgb light, alpha 1 where the surface-angle method draws a line.
fn tone_at(triangle: Triangle, corners: Corners, frame_px: vec2<f32>) -> vec4<f32> {
    let weights = weights_at(corners.clip, ndc_at(view, frame_px));
    let normal = unit_or_z(blend3(weights, corners.normals[0], corners.normals[1], corners.normals[2]))
        * corners.side;
    let light = light_of(triangle.part, normal);
    var ink = 0.0;
    if (compose.flags & COMPOSE_ANGLE) != 0u && (parts[triangle.part].flags & PART_LINES) != 0u {
        let world = blend3(weights, posed[triangle.corners.x].world, posed[triangle.corners.y].world,
            posed[triangle.corners.z].world);
        if abs(dot(normal, to_eye(view, world))) < parts[triangle.part].facing_threshold { ink = 1.0; }
    }
    return vec4<f32>(light, ink);
}

fn vertex_color(index: u32) -> vec3<f32> {
    return linear_texel(vertices[index].color).rgb;
}

// Surface colour without light.
fn base_color(triangle: Triangle, corners: Corners, frame_px: vec2<f32>) -> vec3<f32> {
    let weights = weights_at(corners.clip, ndc_at(view, frame_px));
    let at = triangle.corners;
    var color = parts[triangle.part].base_color.rgb
        * blend3(weights, vertex_color(at.x), vertex_color(at.y), vertex_color(at.z));
    let texture = parts[triangle.part].texture;
    if texture != NONE {
        let right = weights_at(corners.clip, ndc_at(view, frame_px + vec2<f32>(1.0, 0.0)));
        let down = weights_at(corners.clip, ndc_at(view, frame_px + vec2<f32>(0.0, 1.0)));
        let uv = uv_at(triangle, weights);
        let dx = uv_at(triangle, right) - uv;
        let dy = uv_at(triangle, down) - uv;
        let footprint = sqrt(max(dx.x * dx.x + dx.y * dx.y, dy.x * dy.x + dy.y * dy.y));
        color *= sample_texture(texture, uv, footprint).rgb;
    }
    if compose.saturation == 1.0 { return color; }
    let luma = dot(color, vec3<f32>(0.2126, 0.7152, 0.0722));
    return max(vec3<f32>(luma) + (color - luma) * compose.saturation, vec3<f32>(0.0));
}

fn uv_at(triangle: Triangle, weights: vec3<f32>) -> vec2<f32> {
    let at = triangle.corners;
    return vertices[at.x].uv * weights.x + vertices[at.y].uv * weights.y + vertices[at.z].uv * weights.z;
}

fn linear_of(srgb: vec4<f32>) -> vec4<f32> {
    return linear_texel(pack_rgba8(srgb));
}

// Position of sample `i` within a pixel, from its centre.
fn sample_offset(i: u32) -> vec2<f32> {
    if compose.samples == 1u { return vec2<f32>(0.0); }
    return vec2<f32>(f32(i & 1u), f32(i >> 1u)) * 0.5 - 0.25;
}

// Light of what the samples in `members` show, a triangle or its hull.
fn shade(id: u32, members: u32, frame_px: vec2<f32>) -> vec3<f32> {
    let triangle = triangles[(id & ID_MASK) - 1u];
    let line = linear_of(parts[triangle.part].line_color).rgb;
    if (id & HULL_BIT) != 0u { return line; }
    var center = vec2<f32>(0.0);
    let count = f32(countOneBits(members));
    for (var i = 0u; i < 4u; i++) {
        if (members & (1u << i)) != 0u { center += sample_offset(i) / count; }
    }
    let corners = corners_of(triangle);
    var tone = vec4<f32>(0.0);
    if (compose.flags & COMPOSE_ANGLE) == 0u && is_one_tone(triangle.part, corners) {
        tone = vec4<f32>(light_of(triangle.part, corners.normals[0] * corners.side), 0.0);
    } else {
        for (var i = 0u; i < 4u; i++) {
            if (members & (1u << i)) != 0u {
                tone += tone_at(triangle, corners, frame_px + sample_offset(i)) / count;
            }
        }
    }
    let color = base_color(triangle, corners, frame_px + center) * tone.rgb;
    return color + (line - color) * tone.a;
}

// The surfaces of a pixel, premultiplied.
fn surfaces(pixel: vec2<u32>, frame_px: vec2<f32>) -> vec4<f32> {
    var seen: array<u32, 4>;
    let count = compose.samples * compose.samples;
    for (var i = 0u; i < count; i++) {
        let at = pixel * compose.samples + vec2<u32>(i & 1u, i >> 1u);
        seen[i] = textureLoad(ids, at, 0).x;
    }
    var sum = vec4<f32>(0.0);
    var left = (1u << count) - 1u;
    for (var i = 0u; i < count; i++) {
        if (left & (1u << i)) == 0u { continue; }
        var members = 0u;
        for (var j = i; j < count; j++) {
            if seen[j] == seen[i] { members |= 1u << j; }
        }
        left &= ~members;
        if seen[i] == 0u { continue; }
        let share = f32(countOneBits(members)) / f32(count);
        sum += vec4<f32>(shade(seen[i], members, frame_px), 1.0) * share;
    }
    return sum;
}

// What lies behind everything, premultiplied.
fn background(frame_px: vec2<f32>) -> vec4<f32> {
    var color = compose.background;
    if compose.background_texture != NONE {
        let at = compose.background_texture;
        let size = vec2<f32>(f32(texels[at]), f32(texels[at + 1u]));
        // Cover the frame, centred, like a poster that is cut at two sides.
        let zoom = max(view.frame_px.x / size.x, view.frame_px.y / size.y);
        let uv = (frame_px - 0.5 * view.frame_px) / (size * zoom) + 0.5;
        color = sample_texture(at, uv, 1.0 / (max(size.x, size.y) * zoom));
    }
    return vec4<f32>(color.rgb * color.a, color.a);
}

// A straight-alpha layer laid over a premultiplied one.
fn over(top: vec4<f32>, below: vec4<f32>) -> vec4<f32> {
    return vec4<f32>(top.rgb * top.a, top.a) + below * (1.0 - top.a);
}

// One invocation per output pixel.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&frame) { return; }

    let pixel = pixel_of(element, window.size);
    let frame_px = frame_at(window, pixel);
    let surface = surfaces(pixel, frame_px);
    var color = surface;
    if surface.a < 1.0 { color += background(frame_px) * (1.0 - surface.a); }
    if (compose.flags & COMPOSE_MASK) != 0u {
        let at = pixel_at(mask_window, frame_px);
        if (mask[at.y * mask_window.size.x + at.x] & MASK_KINDS) != 0u {
            color = over(linear_of(compose.line_color), color);
        }
    }
    if (compose.flags & COMPOSE_RIBBONS) != 0u {
        color = over(linear_of(textureLoad(ribbons, pixel, 0)), color);
    }
    if (compose.flags & COMPOSE_STAMPS) != 0u {
        color = over(linear_texel(stamped[element]), color);
    }
    let straight = color.rgb / max(color.a, 1e-6);
    frame[element] = pack_rgba8(vec4<f32>(
        srgb_from_linear(straight.r),
        srgb_from_linear(straight.g),
        srgb_from_linear(straight.b),
        color.a,
    ));
}
