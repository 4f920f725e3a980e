// smoke.resolve_picture: tones and outlines of every pixel, and which of its samples the smoke covers.
//
// Colours are sRGB with straight alpha; depths are the bits of a float whose low four say which samples are covered.
// Most pixels show one sphere; where several meet or smoke ends, the spheres of the nine pixels around are tested for
// every sample.
//
// Source  Hoshino 2004, sections 3.4 and 3.5
// Twin    npr_style::smoke::resolve::resolve
//
//# use lib/geometry
//# use lib/surface
//# use lib/window
//# use lib/color
//# use lib/sphere
//# use lib/smoke

@group(0) @binding(0) var<uniform> window: Window;
@group(0) @binding(1) var<uniform> lens: SphereView;
@group(0) @binding(2) var<uniform> look: SmokeLook;
@group(0) @binding(3) var smoke_ids: texture_2d<u32>;
@group(0) @binding(4) var<storage, read> balls: array<ViewSphere>;
@group(0) @binding(5) var<storage, read> pixels: array<SmokePixel>;
@group(0) @binding(6) var<storage, read> tones: array<f32>;

//# use lib/step
//# use lib/smoke_line

const SMOKE_MASK: u32 = 15u;

struct Picture {
    @location(0) color: vec4<f32>,
    @location(1) depth: u32,
}

// A pixel before it is packed: linear light with straight alpha.
struct Drawn {
    color: vec4<f32>,
    depth: u32,
}

// Offset of the `k`th pixel of a neighbourhood: itself first, then those beside it.
fn around(k: u32) -> vec2<i32> {
    switch k {
        case 0u: { return vec2<i32>(0, 0); }
        case 1u: { return vec2<i32>(-1, 0); }
        case 2u: { return vec2<i32>(1, 0); }
        case 3u: { return vec2<i32>(0, -1); }
        case 4u: { return vec2<i32>(0, 1); }
        case 5u: { return vec2<i32>(-1, -1); }
        case 6u: { return vec2<i32>(1, -1); }
        case 7u: { return vec2<i32>(-1, 1); }
        default: { return vec2<i32>(1, 1); }
    }
}

// A neighbour, clamped to the picture.
fn pixel_near(pixel: vec2<i32>, step: vec2<i32>) -> vec2<u32> {
    return vec2<u32>(clamp(pixel + step, vec2<i32>(0), vec2<i32>(window.size) - 1));
}

fn texel_near(pixel: vec2<i32>, step: vec2<i32>) -> u32 {
    let at = pixel_near(pixel, step);
    return at.y * window.size.x + at.x;
}

fn with_mask(depth: f32, mask: u32) -> u32 {
    return (bitcast<u32>(depth) & ~SMOKE_MASK) | mask;
}

// Colour of a tone that changes by `slope` per pixel: steps are as wide as a pixel, or softer.
fn color_of(tone: f32, slope: f32) -> vec3<f32> {
    let width = max(max(look.softness, slope), 1e-6);
    var color = look.ramp[0].rgb;
    for (var i = 1u; i < 8u; i++) {
        let level = look.ramp[i];
        if level.a > 1.5 { break; }
        color += (level.rgb - color) * clamp((tone - level.a) / width + 0.5, 0.0, 1.0);
    }
    return color;
}

// A colour under a line that covers `line` of it.
fn under_line(color: vec4<f32>, line: f32) -> vec4<f32> {
    let top = line * look.line_color.a;
    let alpha = top + color.a * (1.0 - top);
    let part = top / max(alpha, 1e-6);
    return vec4<f32>(color.rgb + (look.line_color.rgb - color.rgb) * part, alpha);
}

// Change of tone per pixel over three pixels in a row, among those of the same layer.
fn change(before: u32, here: u32, after: u32) -> f32 {
    let place = pixels[here].place;
    let has_before = before != here && abs(pixels[before].place - place) < 0.5;
    let has_after = after != here && abs(pixels[after].place - place) < 0.5;
    if has_before && has_after { return (tones[after] - tones[before]) * 0.5; }
    if has_before { return tones[here] - tones[before]; }
    if has_after { return tones[after] - tones[here]; }
    return 0.0;
}

// Change of the smoothed tone per pixel.
fn slope_at(pixel: vec2<i32>) -> f32 {
    let here = texel_near(pixel, vec2<i32>(0));
    let across = change(texel_near(pixel, vec2<i32>(-1, 0)), here, texel_near(pixel, vec2<i32>(1, 0)));
    let down = change(texel_near(pixel, vec2<i32>(0, -1)), here, texel_near(pixel, vec2<i32>(0, 1)));
    return sqrt(across * across + down * down);
}

// Tone and line of sphere `id` at a position; the tone is that of a pixel which shows it.
fn paint(id: u32, pixel: vec2<i32>, frame_px: vec2<f32>) -> vec4<f32> {
    let tone = tones[texel_near(pixel, vec2<i32>(0))];
    return under_line(vec4<f32>(color_of(tone, slope_at(pixel)), look.alpha), line_at(id, frame_px));
}

// As published: one tone per pixel, and lines from differences of depth.
fn published(pixel: vec2<i32>, id: u32) -> Drawn {
    var drawn: Drawn;
    let line = published_line(pixel);
    if line == 0.0 && id == 0u { return drawn; }
    if id != 0u { drawn.color = vec4<f32>(color_of(tones[texel_near(pixel, vec2<i32>(0))], 0.0), look.alpha); }
    var nearest = FAR_DEPTH;
    for (var k = 0u; k < 9u; k++) { nearest = min(nearest, pixels[texel_near(pixel, around(k))].depth); }
    drawn.color = under_line(drawn.color, line);
    drawn.depth = with_mask(nearest, SMOKE_MASK);
    return drawn;
}

fn sample_at(frame_px: vec2<f32>, i: u32) -> vec2<f32> {
    if look.samples == 1u { return frame_px; }
    return frame_px + (vec2<f32>(f32(i & 1u), f32(i >> 1u)) * 0.5 - 0.25) * window.frame_step;
}

fn draw(pixel: vec2<i32>) -> Drawn {
    var drawn: Drawn;
    var ids: array<u32, 9>;
    var all_same = true;
    for (var k = 0u; k < 9u; k++) {
        ids[k] = textureLoad(smoke_ids, pixel_near(pixel, around(k)), 0).x;
        if ids[k] != ids[0] { all_same = false; }
    }
    if all_same && ids[0] == 0u { return drawn; }
    if (look.flags & SMOKE_PUBLISHED) != 0u { return published(pixel, ids[0]); }
    let frame_px = frame_at(window, vec2<u32>(pixel));
    if all_same {
        drawn.color = paint(ids[0], pixel, frame_px);
        drawn.depth = with_mask(pixels[texel_near(pixel, vec2<i32>(0))].depth, SMOKE_MASK);
        return drawn;
    }
    // Find the nearest sphere in every sample, among those of the nine pixels.
    var owners: array<u32, 4>;
    let count = look.samples * look.samples;
    for (var i = 0u; i < count; i++) {
        let ray = ray_at(lens, sample_at(frame_px, i));
        var nearest = FAR_DEPTH;
        owners[i] = 9u;
        for (var k = 0u; k < 9u; k++) {
            if ids[k] == 0u { continue; }
            let depth = depth_of_ball(lens, balls[ids[k] - 1u], ray);
            if depth < nearest {
                nearest = depth;
                owners[i] = k;
            }
        }
    }
    // Blend the colours of the samples.
    var sum = vec4<f32>(0.0);
    var covered = 0.0;
    var mask = 0u;
    var depth = FAR_DEPTH;
    for (var i = 0u; i < count; i++) {
        let k = owners[i];
        if k == 9u { continue; }
        mask |= 1u << i;
        covered += 1.0;
        var is_new = true;
        for (var j = 0u; j < i; j++) { is_new = is_new && owners[j] != k; }
        if !is_new { continue; }
        var same = 0.0;
        for (var j = i; j < count; j++) {
            if owners[j] == k { same += 1.0; }
        }
        let color = paint(ids[k], vec2<i32>(pixel_near(pixel, around(k))), frame_px);
        sum += vec4<f32>(color.rgb * (color.a * same), color.a * same);
        depth = min(depth, pixels[texel_near(pixel, around(k))].depth);
    }
    if mask == 0u { return drawn; }
    drawn.color = vec4<f32>(sum.rgb / max(sum.a, 1e-6), sum.a / covered);
    drawn.depth = with_mask(depth, mask);
    return drawn;
}

// A triangle over the whole picture.
@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    let at = vec2<f32>(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0);
    return vec4<f32>(at, 0.5, 1.0);
}

@fragment
fn fragment(@builtin(position) position: vec4<f32>) -> Picture {
    let drawn = draw(vec2<i32>(position.xy));
    var picture: Picture;
    picture.color = vec4<f32>(
        srgb_from_linear(drawn.color.r),
        srgb_from_linear(drawn.color.g),
        srgb_from_linear(drawn.color.b),
        drawn.color.a,
    );
    picture.depth = drawn.depth;
    return picture;
}
