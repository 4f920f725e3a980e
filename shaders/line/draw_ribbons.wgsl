// line.draw_ribbons: edges as ribbons of varying width, where the mask shows them.
//
// Every fragment looks up the mask at its reference coordinate, the nearest point of the edge itself (A17, A18).
// Coverage is analytic, and of several ribbons the one that covers a pixel most is kept, so the order of edges does
// not matter.
//
// Source  Okuya et al. 2016, sections 3.3 and 4.4
// Twin    npr_vector::screen::ribbon::draw
// Differs: unique edges instead of the three of each triangle (A22); quads are made by
// vertex pulling, there being no geometry shader; round joins (A37) and depth tests (A26) unless OUTLINE_PUBLISHED.
//
//# use lib/geometry
//# use lib/window
//# use lib/outline
//# use lib/ribbon
//# use lib/ribbon_quad

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var<uniform> window: Window;
@group(0) @binding(2) var<uniform> mask_window: Window;
@group(0) @binding(3) var<uniform> outline: Outline;
@group(0) @binding(4) var<storage, read> posed: array<PosedVertex>;
@group(0) @binding(5) var<storage, read> parts: array<Part>;
@group(0) @binding(6) var<storage, read> edges: array<Edge>;
@group(0) @binding(7) var<storage, read> roles: array<EdgeRole>;
@group(0) @binding(8) var<storage, read> gbuffer: array<GPixel>;
@group(0) @binding(9) var<storage, read> mask: array<u32>;
@group(0) @binding(10) var<storage, read> tints: array<LineTint>;

//# use lib/tints

// Depth by which an edge may lie behind the surface around it and still show, in mask pixels.
const DEPTH_TOLERANCE_PX: f32 = 1.0;
// Factor on that depth for a rim that bends away.
const RIM_FACTOR: f32 = 16.0;
// Length along an edge over which the mask must continue, in mask pixels; a line that only crosses is thinner.
const LINE_REACH_PX: f32 = 2.5;

struct Varying {
    @builtin(position) position: vec4<f32>,
    @location(0) @interpolate(flat, either) spine: vec4<f32>,
    @location(1) @interpolate(flat, either) halves_and_depths: vec4<f32>,
    @location(2) @interpolate(flat, either) part_and_kind: vec2<u32>,
}

struct End {
    px: vec2<f32>,
    half_width: f32,
    depth: f32,
}

// An end point in frame pixels; behind the near plane it moves along the edge to that plane.
fn end_of(here: PosedVertex, other: PosedVertex) -> End {
    var t = 0.0;
    if here.depth < view.near { t = (view.near - here.depth) / (other.depth - here.depth); }
    let clip = here.clip + (other.clip - here.clip) * t;
    var end: End;
    end.px = vec2<f32>(clip.x / clip.w + 1.0, 1.0 - clip.y / clip.w) * 0.5 * view.frame_px;
    end.half_width = here.half_width + (other.half_width - here.half_width) * t;
    end.depth = here.depth + (other.depth - here.depth) * t;
    return end;
}

// Six vertices per edge: a rectangle around the ribbon.
@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Varying {
    let element = index / 6u;
    var passed: Varying;
    passed.position = vec4<f32>(0.0);
    let role = roles[element];
    if role.kinds == 0u { return passed; }
    let ends = edges[element].ends;
    let first = posed[ends.x];
    let second = posed[ends.y];
    if max(first.depth, second.depth) <= view.near { return passed; }

    let a = end_of(first, second);
    let b = end_of(second, first);
    let ribbon = Ribbon(a.px, b.px, a.half_width, b.half_width);
    passed.position = ribbon_corner(window, ribbon, index % 6u);
    passed.spine = vec4<f32>(a.px, b.px);
    passed.halves_and_depths = vec4<f32>(a.half_width, b.half_width, a.depth, b.depth);
    passed.part_and_kind = vec2<u32>(role.part, role.kinds);
    return passed;
}

fn mask_at(px: vec2<f32>) -> bool {
    let pixel = pixel_at(mask_window, px);
    return (mask[pixel.y * mask_window.size.x + pixel.x] & MASK_KINDS) != 0u;
}

// Whether any of the 3x3 mask pixels around a point is set.
fn mask_near(px: vec2<f32>) -> bool {
    let center = vec2<i32>(pixel_at(mask_window, px));
    let last = vec2<i32>(mask_window.size) - 1;
    for (var dy = -1; dy <= 1; dy++) {
        for (var dx = -1; dx <= 1; dx++) {
            let pixel = vec2<u32>(clamp(center + vec2<i32>(dx, dy), vec2<i32>(0), last));
            if (mask[pixel.y * mask_window.size.x + pixel.x] & MASK_KINDS) != 0u { return true; }
        }
    }
    return false;
}

// Depth, at a point of the frame, of the tangent plane of the surface in a mask pixel.
fn plane_at(seen: GPixel, pixel: vec2<u32>, px: vec2<f32>) -> f32 {
    let off = (px - frame_at(mask_window, pixel)) / mask_window.frame_step;
    let change = seen.plane_step.x * off.x + seen.plane_step.y * off.y;
    return depth_of_coordinate(view, plane_coordinate(view, seen.depth) + change);
}

// Whether the surface at the reference coordinate hides the edge.
fn is_hidden(px: vec2<f32>, depth: f32) -> bool {
    let pixel = pixel_at(mask_window, px);
    let seen = gbuffer[pixel.y * mask_window.size.x + pixel.x];
    if seen.part == NONE { return false; }
    let plane = plane_at(seen, pixel, px);
    let slope = slope_of(view, mask_window, seen.depth, seen.plane_step);
    if depth <= max(plane, seen.depth) + tolerance(depth) * (1.0 + slope) { return false; }
    return !is_rim(pixel, depth, tolerance(depth) * RIM_FACTOR * (1.0 + slope));
}

// Whether a depth belongs to the front one of two surfaces that 3x3 pixels show: a rim that bends away faster than the
// tangent plane of its pixel.
fn is_rim(center: vec2<u32>, depth: f32, room: f32) -> bool {
    let low = max(center, vec2<u32>(1u)) - 1u;
    let high = min(center + 1u, mask_window.size - 1u);
    var nearest = FAR_DEPTH;
    var farthest = 0.0;
    for (var y = low.y; y <= high.y; y++) {
        for (var x = low.x; x <= high.x; x++) {
            let seen = gbuffer[y * mask_window.size.x + x].depth;
            nearest = min(nearest, seen);
            farthest = max(farthest, seen);
        }
    }
    return depth - nearest < room && depth - nearest < farthest - depth;
}

fn tolerance(depth: f32) -> f32 {
    return DEPTH_TOLERANCE_PX * world_per_pixel(view, depth) * mask_window.frame_step.y;
}

// Whether the edge shows at a point of its spine.
fn shows_at(px: vec2<f32>, depth: f32, along: vec2<f32>, kind: u32) -> bool {
    if is_hidden(px, depth) { return false; }
    if (outline.flags & OUTLINE_UNMASKED) != 0u { return true; }
    if (outline.flags & OUTLINE_PUBLISHED) != 0u { return mask_at(px); }
    if !mask_near(px) { return false; }
    // The mask must run along the edge, not merely meet another line there.
    let ahead = along * mask_window.frame_step * LINE_REACH_PX;
    if (kind & (KIND_CONTOUR | KIND_BOUNDARY)) != 0u { return mask_near(px + ahead) || mask_near(px - ahead); }
    return mask_at(px + ahead) || mask_at(px - ahead);
}

// 1 at the near plane, falling with depth; in a parallel view the near plane may lie behind the eye.
fn nearness(depth: f32) -> f32 {
    if view.perspective < 0.5 { return 0.5; }
    return view.near / max(depth, view.near);
}

// Whether another object stands in front of a thick line's fragment. Its tangent plane is followed to the reference
// coordinate: the floor that a thing stands on is nearer to the eye below the line, but does not cover it.
fn is_covered(px: vec2<f32>, reference: vec2<f32>, depth: f32, object: u32) -> bool {
    let pixel = pixel_at(mask_window, px);
    let seen = gbuffer[pixel.y * mask_window.size.x + pixel.x];
    if seen.part == NONE || parts[seen.part].object == object { return false; }
    return max(seen.depth, plane_at(seen, pixel, reference)) < depth - tolerance(depth);
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
    ribbon.half_a = passed.halves_and_depths.x;
    ribbon.half_b = passed.halves_and_depths.y;
    let depth_a = passed.halves_and_depths.z;
    let depth_b = passed.halves_and_depths.w;
    let part = passed.part_and_kind.x;
    let px = frame_at(window, vec2<u32>(passed.position.xy));
    let point = ribbon_at(ribbon, px, (outline.flags & OUTLINE_PUBLISHED) != 0u);
    if point.coverage * 255.0 < 0.5 { discard; }

    // Find the reference coordinate and its depth.
    let along = ribbon.b - ribbon.a;
    let reference = ribbon.a + along * point.t;
    let from_a = plane_coordinate(view, depth_a);
    let coordinate = from_a + (plane_coordinate(view, depth_b) - from_a) * point.t;
    let depth = plane_coordinate(view, coordinate);
    let length = max(sqrt(along.x * along.x + along.y * along.y), 1e-6);
    if !shows_at(reference, depth, along / length, passed.part_and_kind.y) { discard; }
    if is_covered(px, reference, depth, parts[part].object) { discard; }

    var ink: Ink;
    let color = line_color_at(part, kind_of_edge(passed.part_and_kind.y), reference);
    ink.color = vec4<f32>(color.rgb, color.a * point.coverage);
    ink.key = line_key(point.coverage, nearness(depth));
    return ink;
}
