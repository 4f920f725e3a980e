// vector.project_edges: clips each drawn edge to the six planes of the view, projects it, and counts its fragments.
//
// Every sum and product is rounded on its own, so segments have the bits of the twin.
//
// Source  Liang & Barsky 1984; Jiang et al. 2022, line rasterisation, first pass
// Twin    npr_vector::pixel_strokes::segment::project_edges
//
//# use lib/grid
//# use lib/pixel

@group(0) @binding(0) var<uniform> view: PixelView;
@group(0) @binding(1) var<storage, read> extent: array<u32>;
@group(0) @binding(2) var<storage, read> list: array<u32>;
@group(0) @binding(3) var<storage, read> marks: array<u32>;
@group(0) @binding(4) var<storage, read> edges: array<DrawnEdge>;
@group(0) @binding(5) var<storage, read> positions: array<f32>;
@group(0) @binding(6) var<storage, read_write> segments: array<Segment>;
@group(0) @binding(7) var<storage, read_write> counts: array<u32>;

const LEAST_EXTENT: f32 = 1e-4;

// Clip position of a vertex.
fn clip(vertex: u32) -> vec4<f32> {
    let at = 3u * vertex;
    let m = view.clip_from_world;
    let x = keep(m[0] * positions[at]);
    let y = keep(m[1] * positions[at + 1u]);
    let z = keep(m[2] * positions[at + 2u]);
    return keep(keep(keep(x + y) + z) + m[3]);
}

fn keep(v: vec4<f32>) -> vec4<f32> {
    return bitcast<vec4<f32>>(bitcast<vec4<u32>>(v) ^ vec4<u32>(view.zero));
}

// Place on the fine grid and reversed depth of a clip position.
fn place(at: vec4<f32>) -> vec3<f32> {
    let r = reciprocal(view, at.w);
    let half = vec2<f32>(view.size) * 0.5 * view.fine;
    let ndc = keep(at * r);
    let x = clamp(keep(keep(vec4<f32>(ndc.x * half.x, 0.0, 0.0, 0.0)) + vec4<f32>(half.x)).x, 0.0, 2.0 * half.x);
    let y = clamp(keep(vec4<f32>(half.y) - keep(vec4<f32>(ndc.y * half.y, 0.0, 0.0, 0.0))).x, 0.0, 2.0 * half.y);
    return vec3<f32>(x, y, clamp(ndc.z, 0.0, 1.0));
}

// Distance of a clip position from a plane of the view, positive inside: left, right, bottom, top, near, far.
fn distance_from(at: vec4<f32>, plane: u32) -> f32 {
    switch plane {
        case 0u: { return rounded(view, at.w + at.x); }
        case 1u: { return rounded(view, at.w - at.x); }
        case 2u: { return rounded(view, at.w + at.y); }
        case 3u: { return rounded(view, at.w - at.y); }
        case 4u: { return rounded(view, at.w - at.z); }
        default: { return at.z; }
    }
}

fn between(a: vec4<f32>, b: vec4<f32>, share: f32) -> vec4<f32> {
    return keep(a + keep(keep(b - a) * share));
}

fn fragment_count(segment: Segment) -> u32 {
    let extent = abs(segment.end - segment.start);
    return u32(ceil(rounded(view, rounded(view, max(extent.x, extent.y)) + LEAST_EXTENT)));
}

// One invocation per edge drawn.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&segments) { return; }

    counts[element] = 0u;
    if element >= min(extent[0], arrayLength(&list)) { return; }
    let number = list[element];
    let edge = edges[number];
    let mark = marks[number];
    let is_reversed = (mark & EDGE_REVERSED) != 0u;
    let a = clip(select(edge.tail, edge.head, is_reversed));
    let b = clip(select(edge.head, edge.tail, is_reversed));
    var enter = 0.0;
    var leave = 1.0;
    for (var plane = 0u; plane < 6u; plane++) {
        let start = distance_from(a, plane);
        let end = distance_from(b, plane);
        let share = rounded(view, start * reciprocal(view, rounded(view, start - end)));
        if !(start >= 0.0) && !(end >= 0.0) { return; }
        if !(start >= 0.0) { enter = max(enter, share); }
        if !(end >= 0.0) { leave = min(leave, share); }
    }
    if !(enter <= leave) { return; }
    let start = place(between(a, b, enter));
    let end = place(between(a, b, leave));
    var segment: Segment;
    segment.start = start.xy;
    segment.end = end.xy;
    segment.start_z = start.z;
    segment.end_z = end.z;
    segment.edge = number;
    segment.mark = mark;
    segments[element] = segment;
    counts[element] = fragment_count(segment);
}
