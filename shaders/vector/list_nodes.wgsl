// vector.list_nodes: the links of nodes, as ranking reads them.
//
// Each element after the last node becomes a loop of its own, which comes after all lines. If there was no room for all
// nodes, links would lead nowhere, and all elements become such loops.
//
// Source  Jiang et al. 2022, serialisation
// Twin    npr_vector::mesh_lines::contour::steps::list_nodes
//
//# use lib/grid
//# use lib/curve
//# use lib/list

@group(0) @binding(0) var<storage, read> extent: array<u32>;
@group(0) @binding(1) var<storage, read> nodes: array<CurveNode>;
@group(0) @binding(2) var<storage, read_write> links: array<Link>;

// One invocation per element.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&nodes) { return; }

    let has_room = extent[0] <= arrayLength(&nodes);
    let is_node = has_room && element < extent[0];
    let node = nodes[element];
    links[element].next = select(element, node.next, is_node);
    links[element].prev = select(element, node.prev, is_node);
    links[element].key = select(0u, node.edge, is_node);
}
