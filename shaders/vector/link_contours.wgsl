// vector.link_contours: makes a node of every marked half-edge and links it to the one that starts where it ends.
//
// Turning round a vertex through front faces leads out of each wedge of them at one half-edge and into it at one, so
// all lines are closed and no node is shared.
//
// Source  Hertzmann & Zorin 2000, mesh contours
// Twin    npr_vector::mesh_lines::contour::steps::link_contours
// Differs: the publication of 2022 links pixels along drawn contours; here half-edges
// on the mesh are linked, which gives one line instead of two and needs no picture.
//
//# use lib/grid
//# use lib/curve

@group(0) @binding(0) var<uniform> viewer: Viewer;
@group(0) @binding(1) var<storage, read> extent: array<u32>;
@group(0) @binding(2) var<storage, read> contours: array<u32>;
@group(0) @binding(3) var<storage, read> slots: array<u32>;
@group(0) @binding(4) var<storage, read> flags: array<u32>;
@group(0) @binding(5) var<storage, read> half_edges: array<HalfEdge>;
@group(0) @binding(6) var<storage, read> positions: array<f32>;
@group(0) @binding(7) var<storage, read_write> nodes: array<CurveNode>;

// The marked half-edge that starts where this one ends, around the same wedge of front faces.
fn successor(half_edge: u32) -> u32 {
    var next = following(half_edge);
    // On a shape, twins lead to a marked half-edge; the bound is for meshes that are no shape.
    for (var turn = 0u; turn < arrayLength(&half_edges); turn++) {
        if flags[next] != 0u { break; }
        next = following(half_edges[next].twin);
    }
    return next;
}

fn tail_of(half_edge: u32) -> vec3<f32> {
    let at = 3u * half_edges[half_edge].tail;
    return vec3<f32>(positions[at], positions[at + 1u], positions[at + 2u]);
}

// Whether the face across rises over the plane of the half-edge's face.
fn is_concave(half_edge: u32, twin: u32) -> bool {
    let tail = tail_of(half_edge);
    let head = scaled_difference(viewer, tail_of(following(half_edge)), tail);
    let own = scaled_difference(viewer, tail_of(following(following(half_edge))), tail);
    let across = scaled_difference(viewer, tail_of(following(following(twin))), tail);
    return settled_dot(viewer, settle(viewer, settled_cross(viewer, head, own)), across) > 0.0;
}

fn flags_of(half_edge: u32) -> u32 {
    let side = half_edges[half_edge];
    let odd = EDGE_BOUNDARY | EDGE_NON_MANIFOLD | EDGE_FLIPPED;
    if side.twin == NONE || (side.traits & odd) != 0u { return EDGE_SEAM; }
    return KIND_CONTOUR | select(0u, EDGE_CONCAVE, is_concave(half_edge, side.twin));
}

// One invocation per marked half-edge.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    let count = min(extent[0], arrayLength(&nodes));
    if element >= count { return; }

    let half_edge = contours[element];
    let side = half_edges[half_edge];
    let head = half_edges[following(half_edge)].tail;
    let next = slots[successor(half_edge)];
    nodes[element].edge = side.edge;
    nodes[element].t = select(1.0, 0.0, side.tail < head);
    nodes[element].next = next;
    nodes[element].flags = flags_of(half_edge);
    nodes[element].face = half_edge / 3u;
    // No two nodes have the same successor, so no other invocation writes this.
    if next < count { nodes[next].prev = element; }
}
