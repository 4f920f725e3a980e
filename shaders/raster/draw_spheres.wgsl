// raster.draw_spheres: the number of the nearest sphere, plus one, at every pixel.
//
// A rectangle around the image of each sphere; every pixel casts its ray, so depth is that of the sphere itself.
//
// Twin    npr_style::smoke::draw::draw_spheres
//
//# use lib/geometry
//# use lib/window
//# use lib/sphere

@group(0) @binding(0) var<uniform> window: Window;
@group(0) @binding(1) var<uniform> lens: SphereView;
@group(0) @binding(2) var<storage, read> balls: array<ViewSphere>;

struct Passed {
    @builtin(position) position: vec4<f32>,
    @location(0) @interpolate(flat, either) ball: u32,
}

struct Seen {
    @location(0) id: u32,
    @builtin(frag_depth) depth: f32,
}

// Six vertices per ball; balls that are not seen collapse to a point.
@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Passed {
    var passed: Passed;
    passed.ball = index / 6u;
    passed.position = vec4<f32>(0.0);
    let bounds = balls[passed.ball].bounds;
    if bounds.x > bounds.z || bounds.y > bounds.w { return passed; }
    // Two triangles over the rectangle, a pixel wider on each side than rounding can reach.
    let corner = index % 6u;
    let is_right = corner == 1u || corner == 2u || corner == 4u;
    let is_low = corner == 2u || corner >= 4u;
    let at = vec2<f32>(select(bounds.x, bounds.z, is_right), select(bounds.y, bounds.w, is_low));
    let room = vec2<f32>(select(-1.0, 1.0, is_right), select(-1.0, 1.0, is_low));
    let pixel = (at - window.frame_origin) / window.frame_step + room;
    let ndc = pixel / vec2<f32>(window.size) * 2.0 - 1.0;
    passed.position = vec4<f32>(ndc.x, -ndc.y, 0.5, 1.0);
    return passed;
}

@fragment
fn fragment(passed: Passed) -> Seen {
    let ray = ray_at(lens, frame_at(window, vec2<u32>(passed.position.xy)));
    let depth = depth_of_ball(lens, balls[passed.ball], ray);
    if depth >= FAR_DEPTH { discard; }
    var seen: Seen;
    seen.id = passed.ball + 1u;
    seen.depth = clamp(reversed_depth(lens, depth), 0.0, 1.0);
    return seen;
}
