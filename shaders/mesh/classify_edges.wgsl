// mesh.classify_edges: which edges may become lines, and of which kind.
//
// An edge is chosen by its role on the shape, so tessellation edges that merely touch the mask leave no stubs along a
// line (A40).
//
// Source  Okuya et al. 2016, section 3.3; Marshall 2001 for contours
// Twin    npr_mesh::classify::classify
// Differs from the publication, which draws every edge of a front face: that is EDGE_FACING.
//
//# use lib/grid
//# use lib/geometry
//# use lib/edge_flags
//# use lib/surface
//# use lib/outline

@group(0) @binding(0) var<uniform> outline: Outline;
@group(0) @binding(1) var<storage, read> posed: array<PosedVertex>;
@group(0) @binding(2) var<storage, read> triangles: array<Triangle>;
@group(0) @binding(3) var<storage, read> parts: array<Part>;
@group(0) @binding(4) var<storage, read> edges: array<Edge>;
@group(0) @binding(5) var<storage, read_write> roles: array<EdgeRole>;

fn face_is_front(face: u32) -> bool {
    let corners = triangles[face].corners;
    let clip = array<vec4<f32>, 3>(posed[corners.x].clip, posed[corners.y].clip, posed[corners.z].clip);
    return faces_eye(clip);
}

// The bits of all kinds that an edge of a part with these flags has.
fn kinds_of(edge: Edge, flags: u32) -> u32 {
    let front = face_is_front(edge.faces.x);
    if edge.faces.y == NONE {
        let seen = front || (flags & PART_DOUBLE_SIDED) != 0u;
        return select(0u, KIND_BOUNDARY | select(0u, EDGE_FACING, front), seen);
    }
    var second = face_is_front(edge.faces.y);
    let published = select(0u, EDGE_FACING, front || second);
    if (edge.traits & EDGE_FLIPPED) != 0u { second = !second; }
    let seen = front || second || (flags & PART_DOUBLE_SIDED) != 0u;
    var kind = select(0u, KIND_CONTOUR, front != second);
    if seen && edge.dihedral_cos < outline.crease_cos { kind |= KIND_CREASE; }
    if seen && (edge.traits & EDGE_MATERIAL) != 0u { kind |= KIND_MATERIAL; }
    return kind | published;
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

    let edge = edges[element];
    let part = triangles[edge.faces.x].part;
    let flags = parts[part].flags;
    roles[element].kinds = select(0u, kinds_of(edge, flags) & outline.kinds, (flags & PART_LINES) != 0u);
    roles[element].part = part;
}
