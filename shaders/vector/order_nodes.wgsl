// vector.order_nodes: puts every node at its place in the row of all chains.
//
// Source  Jiang et al. 2022, serialisation
// Twin    npr_vector::rank::place::order_nodes
// Differs: chains come by the index of their heads, from a scan; the publication lets
// heads take room from a shared counter, so their order changes from run to run.
//
//# use lib/grid
//# use lib/list

@group(0) @binding(0) var<storage, read> standings: array<Standing>;
@group(0) @binding(1) var<storage, read> starts: array<u32>;
@group(0) @binding(2) var<storage, read_write> order: array<u32>;

// One invocation per node.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&standings) { return; }

    let standing = standings[element];
    let head = min(standing.head, arrayLength(&starts) - 1u);
    let at = starts[head] + standing.rank;
    if at < arrayLength(&order) { order[at] = element; }
}
