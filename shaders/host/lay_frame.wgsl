// host.lay_frame: a finished frame laid into a target of a host program, with its depths.
//
// Pixels at which nothing was drawn leave the target as it is. Colours are blended by their alpha, in the light that
// the target holds.
//
// Source  Porter & Duff 1984
//
//# use lib/color

struct Laying {
    host_from_frame: mat4x4<f32>,
    size: vec2<u32>,
    is_linear: u32,
    unused: u32,
}

@group(0) @binding(0) var<uniform> laying: Laying;
@group(0) @binding(1) var<storage, read> frame: array<u32>;
@group(0) @binding(2) var<storage, read> depths: array<f32>;

// What a target gets.
struct Laid {
    @location(0) color: vec4<f32>,
    @builtin(frag_depth) depth: f32,
}

// One triangle over the whole target.
@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    return vec4<f32>(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

// The place of a pixel in the frame; past its end where the frame ends before.
fn element_of(pixel: vec2<u32>) -> u32 {
    if any(pixel >= laying.size) { return 0xffffffffu; }
    return pixel.y * laying.size.x + pixel.x;
}

// The colour of an element as the target takes it, straight alpha; nothing past the end.
fn color_of(element: u32) -> vec4<f32> {
    if element == 0xffffffffu { return vec4<f32>(0.0); }
    let color = unpack_rgba8(frame[element]);
    if laying.is_linear == 0u { return color; }
    return vec4<f32>(linear_rgb(color.rgb), color.a);
}

@fragment
fn fragment_without_depth(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let color = color_of(element_of(vec2<u32>(position.xy)));
    if color.a == 0.0 { discard; }
    return color;
}

@fragment
fn fragment(@builtin(position) position: vec4<f32>) -> Laid {
    let element = element_of(vec2<u32>(position.xy));
    let color = color_of(element);
    if color.a == 0.0 { discard; }

    // What lies beyond the depths of the host still shows, on its nearest or farthest plane.
    let at = position.xy / vec2<f32>(laying.size);
    let place = vec4<f32>(2.0 * at.x - 1.0, 1.0 - 2.0 * at.y, depths[element], 1.0);
    let clip = laying.host_from_frame * place;
    return Laid(color, clamp(clip.z / clip.w, 0.0, 1.0));
}
