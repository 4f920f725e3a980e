// line.detect: marks the pixels that differ from a neighbour.
//
// Each G-buffer has its own threshold; the mask is the union (A9). A marked pixel says which buffers found it, whether
// its surface is the one in front, and on which sides the line runs.
//
// Source  Okuya et al. 2016, sections 3.2 and 4.3
// Twin    npr_vector::screen::detect::detect
//
//# use lib/grid
//# use lib/geometry
//# use lib/unit
//# use lib/window
//# use lib/outline

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var<uniform> window: Window;
@group(0) @binding(2) var<uniform> outline: Outline;
@group(0) @binding(3) var<storage, read> parts: array<Part>;
@group(0) @binding(4) var<storage, read> gbuffer: array<GPixel>;
@group(0) @binding(5) var<storage, read_write> mask: array<u32>;
@group(0) @binding(6) var<storage, read_write> owners: array<atomic<u32>>;

// Depth change per pixel, in pixels, from which a surface is grazing: 63 degrees.
const GRAZING_SLOPE: f32 = 2.0;

// Depth of the tangent plane of a pixel, one pixel along `step`.
fn plane_depth(pixel: GPixel, step: vec2<f32>) -> f32 {
    let change = pixel.plane_step.x * step.x + pixel.plane_step.y * step.y;
    return depth_of_coordinate(view, plane_coordinate(view, pixel.depth) + change);
}

// Distance in depth of `there` from the tangent plane of `here`, one pixel along `step`.
fn plane_gap(here: GPixel, there: GPixel, step: vec2<f32>) -> f32 {
    return abs(plane_depth(here, step) - there.depth);
}

// Whether the surface may bend between a pixel and its neighbour along `step`, convex as a body is: each lies behind
// the tangent plane of the other, so both planes cross between them. Never where depths are compared directly.
fn may_bend(here: GPixel, there: GPixel, step: vec2<f32>) -> bool {
    if (outline.detects & DETECT_PLANE_DEPTH) == 0u { return false; }
    return there.depth > plane_depth(here, step) && here.depth > plane_depth(there, -step);
}

// Depth by which two neighbours must differ for a jump: the threshold's share of the frame's height there.
fn least_jump(here: f32, there: f32) -> f32 {
    return outline.depth_threshold * height_at(view, min(here, there));
}

// Whether depth jumps between two neighbours.
fn jumps(here: GPixel, there: GPixel, step: vec2<f32>) -> bool {
    let least = least_jump(here.depth, there.depth);
    if abs(here.depth - there.depth) <= least { return false; }
    if (outline.detects & DETECT_PLANE_DEPTH) == 0u { return true; }
    return plane_gap(here, there, step) > least && plane_gap(there, here, -step) > least;
}

// Object and material of a part; the background has neither.
fn ids_of(part: u32) -> vec2<u32> {
    if part == NONE { return vec2<u32>(NONE); }
    return vec2<u32>(parts[part].object, parts[part].material);
}

// Which of object and material two parts differ in.
fn differing_ids(here: u32, there: u32) -> u32 {
    if here == there { return 0u; }
    let differ = ids_of(here) != ids_of(there);
    return select(0u, DETECT_OBJECT, differ.x) | select(0u, DETECT_MATERIAL, differ.y);
}

// The buffers that separate two neighbours.
fn separations(here: GPixel, there: GPixel, step: vec2<f32>) -> u32 {
    if here.part == NONE && there.part == NONE { return 0u; }
    var found = differing_ids(here.part, there.part);
    if here.part == NONE || there.part == NONE {
        return (found | DETECT_DEPTH | DETECT_NORMAL) & outline.detects;
    }
    if jumps(here, there, step) { found |= DETECT_DEPTH; }
    if here.normal != there.normal {
        let turn = dot(unpack_unit(here.normal), unpack_unit(there.normal));
        if turn < outline.normal_cos { found |= DETECT_NORMAL; }
        var meets = here.part != there.part && (found & (DETECT_OBJECT | DETECT_MATERIAL)) == 0u;
        if meets { meets = parts[here.part].component != parts[there.part].component; }
        if meets && turn < PIECE_COS { found |= DETECT_PIECE; }
    }
    return found & outline.detects & MASK_KINDS;
}

// Whether a surface turns away so far that its normals change from pixel to pixel without any crease.
fn is_grazing(pixel: GPixel) -> bool {
    return slope_of(view, window, pixel.depth, pixel.plane_step) > GRAZING_SLOPE;
}

// Whether neighbours that differ in nothing but their normals have no crease between them.
fn is_no_crease(here: GPixel, there: GPixel) -> bool {
    return (outline.kinds & KIND_CREASE) == 0u || is_grazing(here) || is_grazing(there);
}

fn step_to(side: u32) -> vec2<i32> {
    let along = i32(side & 1u) * 2 - 1;
    return select(vec2<i32>(0, along), vec2<i32>(along, 0), side < 2u);
}

fn neighbor_of(pixel: vec2<i32>, side: u32) -> u32 {
    let next = pixel + step_to(side);
    return u32(next.y) * window.size.x + u32(next.x);
}

// The sides of a pixel, a bit each, on which its neighbour may differ from it: few pixels have any, and only for these
// is everything compared.
fn sides_to_look_at(element: u32, pixel: vec2<i32>) -> u32 {
    let part = gbuffer[element].part;
    let depth = gbuffer[element].depth;
    let normal = gbuffer[element].normal;
    let unpacked = unpack_unit(normal);
    var sides = 0u;
    for (var side = 0u; side < 4u; side++) {
        let next = pixel + step_to(side);
        let is_inside = all(next >= vec2<i32>(0)) && all(next < vec2<i32>(window.size));
        // Beyond the picture a pixel is compared with itself.
        let at = select(element, neighbor_of(pixel, side), is_inside);
        let other = gbuffer[at].normal;
        let is_far = abs(depth - gbuffer[at].depth) > least_jump(depth, gbuffer[at].depth);
        let turns = normal != other && dot(unpacked, unpack_unit(other)) < outline.normal_cos;
        let differs = part != gbuffer[at].part || (part != NONE && (is_far || turns));
        sides |= select(0u, 1u, differs) << side;
    }
    return sides;
}

fn has_lines(pixel: GPixel) -> bool {
    return pixel.part != NONE && (parts[pixel.part].flags & PART_LINES) != 0u;
}

// Lists a pixel that owns a line.
fn append_owner(element: u32) {
    atomicStore(&owners[atomicAdd(&owners[0], 1u) + 1u], element);
}

// One invocation per pixel.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&mask) { return; }

    let pixel = vec2<i32>(pixel_of(element, window.size));
    let here = gbuffer[element];
    var left = sides_to_look_at(element, pixel);
    var found = 0u;
    if left == 0u {
        mask[element] = 0u;
        return;
    }
    loop {
        let side = firstTrailingBit(left);
        let along = i32(side & 1u) * 2 - 1;
        let step = step_to(side);
        let there = gbuffer[neighbor_of(pixel, side)];
        let kinds = separations(here, there, vec2<f32>(step));
        if kinds == 0u || !(has_lines(here) || has_lines(there)) { continue; }
        found |= kinds;
        // If the surface may bend there, a jump in depth owns no line.
        var owning = kinds;
        if (kinds & DETECT_DEPTH) != 0u && may_bend(here, there, vec2<f32>(step)) { owning &= ~DETECT_DEPTH; }
        if owning == 0u || (owning == DETECT_NORMAL && is_no_crease(here, there)) { continue; }
        // Of two equally near surfaces, the right or lower pixel owns the line.
        let owns = here.depth < there.depth || (here.depth == there.depth && along < 0);
        if owns { found |= MASK_OWNER | (MASK_SIDE << side); }
        continuing {
            left &= left - 1u;
            break if left == 0u;
        }
    }
    mask[element] = found;
    if (found & MASK_OWNER) != 0u { append_owner(element); }
}
