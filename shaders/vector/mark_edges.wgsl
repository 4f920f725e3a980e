// vector.mark_edges: the kind and direction of every edge that is drawn.
//
// Edges run in the winding of the face that is turned to the eye.
//
// Source  Jiang et al. 2022, contour extraction
// Twin    npr_vector::pixel_strokes::edge::mark_edges
//
//# use lib/grid
//# use lib/curve
//# use lib/pixel

@group(0) @binding(0) var<uniform> viewer: Viewer;
@group(0) @binding(1) var<uniform> view: PixelView;
@group(0) @binding(2) var<storage, read> positions: array<f32>;
@group(0) @binding(3) var<storage, read> front: array<u32>;
@group(0) @binding(4) var<storage, read> edges: array<DrawnEdge>;
@group(0) @binding(5) var<storage, read_write> flags: array<u32>;
@group(0) @binding(6) var<storage, read_write> marks: array<u32>;

fn position_of(vertex: u32) -> vec3<f32> {
    let at = 3u * vertex;
    return vec3<f32>(positions[at], positions[at + 1u], positions[at + 2u]);
}

// Whether the face across rises over the plane of the first.
fn is_concave(edge: DrawnEdge) -> bool {
    let tail = position_of(edge.tail);
    let head = scaled_difference(viewer, position_of(edge.head), tail);
    let own = scaled_difference(viewer, position_of(edge.beside), tail);
    let across = scaled_difference(viewer, position_of(edge.beyond), tail);
    return settled_dot(viewer, settle(viewer, settled_cross(viewer, head, own)), across) > 0.0;
}

// The kind and the direction of an edge; 0 if it is not drawn.
fn mark_of(edge: DrawnEdge) -> u32 {
    if (edge.bits & EDGE_POLYLINE) != 0u { return edge.bits & view.wanted & KINDS; }
    if edge.face == NONE { return 0u; }
    let is_front = front[edge.face] != 0u;
    let has_pair = edge.across != NONE && (edge.bits & EDGE_NON_MANIFOLD) == 0u;
    var is_front_across = false;
    if has_pair { is_front_across = front[edge.across] != 0u; }
    let is_flipped = (edge.bits & EDGE_FLIPPED) != 0u;
    let is_contour = has_pair && ((is_front != is_front_across) != is_flipped);
    let is_seen = is_front || is_front_across || (edge.bits & EDGE_OPEN) != 0u;
    let direction = select(EDGE_REVERSED, 0u, is_front);
    if is_contour && (view.wanted & KIND_CONTOUR) != 0u {
        var is_valley = view.is_convex_only != 0u && !is_flipped;
        if is_valley { is_valley = is_concave(edge); }
        return select(KIND_CONTOUR | direction, 0u, is_valley);
    }
    let kinds = edge.bits & view.wanted & KINDS;
    if kinds == 0u || !is_seen { return 0u; }
    // The first kind, in the order in which kinds are layered.
    let kind = kinds & (~kinds + 1u);
    return kind | direction;
}

// One invocation per edge.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&edges) { return; }

    let found = mark_of(edges[element]);
    marks[element] = found;
    flags[element] = select(0u, 1u, found != 0u);
}
