// stroke.draw_strokes: strokes as discs swept from each of their points to the next.
//
// Joins and ends are round, and thinner than a pixel is fainter. Of several pieces, the one that covers a pixel most is
// kept, so a stroke has no seams where its pieces meet, and the order of strokes does not matter. A brush leaves ink
// out; its pieces share pixels by the nearest.
//
// Twin    npr_vector::stroke_ink::draw
//
//# use lib/window
//# use lib/color
//# use lib/ink_point
//# use lib/ribbon
//# use lib/ribbon_quad
//# use lib/brush

@group(0) @binding(0) var<uniform> window: Window;
@group(0) @binding(1) var<storage, read> points: array<InkPoint>;
@group(0) @binding(2) var<storage, read> brushes: array<Brush>;
@group(0) @binding(3) var<storage, read> texels: array<u32>;

struct Varying {
    @builtin(position) position: vec4<f32>,
    @location(0) @interpolate(flat, either) spine: vec4<f32>,
    @location(1) @interpolate(flat, either) halves_and_nearness: vec4<f32>,
    @location(2) @interpolate(flat, either) colors_and_element: vec3<u32>,
}

// Six vertices per point: a rectangle around the piece up to the next point.
@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Varying {
    let element = index / 6u;
    var passed: Varying;
    passed.position = vec4<f32>(0.0);
    let a = points[element];
    if (a.flags & INK_GOES_ON) == 0u || element + 1u >= arrayLength(&points) { return passed; }
    let b = points[element + 1u];

    let ribbon = Ribbon(a.px, b.px, a.half_width, b.half_width);
    passed.position = ribbon_corner(window, ribbon, index % 6u);
    passed.spine = vec4<f32>(a.px, b.px);
    passed.halves_and_nearness = vec4<f32>(a.half_width, b.half_width, a.nearness, b.nearness);
    passed.colors_and_element = vec3<u32>(a.color, b.color, element);
    return passed;
}

struct Ink {
    @location(0) color: vec4<f32>,
    @builtin(frag_depth) key: f32,
}

@fragment
fn fragment(passed: Varying) -> Ink {
    // Find how much of the pixel the piece covers, and what the brush leaves of it.
    var ribbon: Ribbon;
    ribbon.a = passed.spine.xy;
    ribbon.b = passed.spine.zw;
    ribbon.half_a = passed.halves_and_nearness.x;
    ribbon.half_b = passed.halves_and_nearness.y;
    let px = frame_at(window, vec2<u32>(passed.position.xy));
    let point = ribbon_swept(ribbon, px);
    if point.coverage * 255.0 < 0.5 { discard; }
    let coverage = point.coverage * brush_ink(passed.colors_and_element.z, px);
    if coverage * 255.0 < 0.5 { discard; }

    var ink: Ink;
    let near = passed.halves_and_nearness.zw;
    ink.key = line_key(coverage, near.x + (near.y - near.x) * point.t);
    let from_a = unpack_rgba8(passed.colors_and_element.x);
    let color = from_a + (unpack_rgba8(passed.colors_and_element.y) - from_a) * point.t;
    ink.color = vec4<f32>(color.rgb, color.a * coverage);
    return ink;
}
