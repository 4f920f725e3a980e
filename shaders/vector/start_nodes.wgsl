// vector.start_nodes: gives every node of a list a first hop and reach to its predecessor.
//
// Source  Jiang et al. 2022, loop breaking
// Twin    npr_vector::rank::jump::start_nodes
//
//# use lib/grid
//# use lib/list

@group(0) @binding(0) var<storage, read> links: array<Link>;
@group(0) @binding(1) var<storage, read_write> hops: array<Hop>;
@group(0) @binding(2) var<storage, read_write> reach: array<Reach>;
@group(0) @binding(3) var<storage, read_write> walks: array<Walk>;

// One invocation per node.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&links) { return; }

    let link = links[element];
    let is_start = link.prev == NONE;
    let far = select(link.prev, element, is_start);
    hops[element].far = far;
    hops[element].dist = select(1u, 0u, is_start);
    reach[element].far = far;
    reach[element].least = element;
    reach[element].hash = precedence(link);
    walks[element].slot = element;
    walks[element].steps = 0u;
}
