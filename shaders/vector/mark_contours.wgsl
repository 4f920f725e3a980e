// vector.mark_contours: marks the half-edges of front faces that have no front face across.
//
// Source  Jiang et al. 2022, contour extraction
// Twin    npr_vector::mesh_lines::contour::steps::mark_contours
//
//# use lib/grid
//# use lib/curve

@group(0) @binding(0) var<storage, read> front: array<u32>;
@group(0) @binding(1) var<storage, read> half_edges: array<HalfEdge>;
@group(0) @binding(2) var<storage, read_write> flags: array<u32>;

// One invocation per half-edge.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&half_edges) { return; }

    let twin = half_edges[element].twin;
    var is_open = twin == NONE;
    if !is_open { is_open = front[twin / 3u] == 0u; }
    flags[element] = select(0u, 1u, front[element / 3u] != 0u && is_open);
}
