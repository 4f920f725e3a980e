// stroke.draw_strokes: strokes as discs swept from each of their points to the next.
//
// Joins and ends are round, and thinner than a pixel is fainter. Of several pieces, the one that covers a pixel most is
// kept, so a stroke has no seams where its pieces meet, and the order of strokes does not matter.
//
// Twin    npr_vector::stroke_ink::draw
//
//# use lib/window
//# use lib/color
//# use lib/ribbon

struct InkPoint {
    px: vec2<f32>,
    half_width: f32,
    nearness: f32,
    color: u32,
    goes_on: u32,
}

@group(0) @binding(0) var<uniform> window: Window;
@group(0) @binding(1) var<storage, read> points: array<InkPoint>;

struct Varying {
    @builtin(position) position: vec4<f32>,
    @location(0) @interpolate(flat, either) spine: vec4<f32>,
    @location(1) @interpolate(flat, either) halves_and_nearness: vec4<f32>,
    @location(2) @interpolate(flat, either) colors: vec2<u32>,
}

// Six vertices per point: a rectangle around the piece up to the next point.
@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Varying {
    let element = index / 6u;
    var passed: Varying;
    passed.position = vec4<f32>(0.0);
    let a = points[element];
    if a.goes_on == 0u || element + 1u >= arrayLength(&points) { return passed; }
    let b = points[element + 1u];

    var along = b.px - a.px;
    let length = sqrt(along.x * along.x + along.y * along.y);
    along = select(vec2<f32>(1.0, 0.0), along / length, length > 1e-6);
    let corner = index % 6u;
    let at_b = corner == 1u || corner == 2u || corner == 4u;
    let at_left = corner == 2u || corner == 4u || corner == 5u;
    let reach = max(a.half_width, b.half_width) + 1.5;
    let end = select(a.px - along * reach, b.px + along * reach, at_b);
    let px = end + vec2<f32>(-along.y, along.x) * select(-reach, reach, at_left);

    let in_window = (px - window.frame_origin) / (window.frame_step * vec2<f32>(window.size));
    passed.position = vec4<f32>(in_window.x * 2.0 - 1.0, 1.0 - in_window.y * 2.0, 0.5, 1.0);
    passed.spine = vec4<f32>(a.px, b.px);
    passed.halves_and_nearness = vec4<f32>(a.half_width, b.half_width, a.nearness, b.nearness);
    passed.colors = vec2<u32>(a.color, b.color);
    return passed;
}

struct Ink {
    @location(0) color: vec4<f32>,
    @builtin(frag_depth) key: f32,
}

@fragment
fn fragment(passed: Varying) -> Ink {
    var ribbon: Ribbon;
    ribbon.a = passed.spine.xy;
    ribbon.b = passed.spine.zw;
    ribbon.half_a = passed.halves_and_nearness.x;
    ribbon.half_b = passed.halves_and_nearness.y;
    let px = frame_at(window, vec2<u32>(passed.position.xy));
    let point = ribbon_swept(ribbon, px);
    if point.coverage * 255.0 < 0.5 { discard; }

    var ink: Ink;
    let near = passed.halves_and_nearness.zw;
    ink.key = line_key(point.coverage, near.x + (near.y - near.x) * point.t);
    let from_a = unpack_rgba8(passed.colors.x);
    let color = from_a + (unpack_rgba8(passed.colors.y) - from_a) * point.t;
    ink.color = vec4<f32>(color.rgb, color.a * point.coverage);
    return ink;
}
