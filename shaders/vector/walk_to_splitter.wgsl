// vector.walk_to_splitter: counts the links from every node back to the nearest splitter, 0 from a splitter.
//
// A walk longer than WALK_LIMIT is given up and reported, so that no input stops the device.
//
// Source  Helman & JaJa 1999; Rehman et al. 2009
// Twin    npr_vector::rank::splitter::walk_to_splitter
//
//# use lib/grid
//# use lib/list

@group(0) @binding(0) var<storage, read> links: array<Link>;
@group(0) @binding(1) var<storage, read> flags: array<u32>;
@group(0) @binding(2) var<storage, read> slots: array<u32>;
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

    var at = element;
    var steps = 0u;
    while flags[at] == 0u && steps < WALK_LIMIT {
        at = links[at].prev;
        steps++;
    }
    let found = flags[at] != 0u;
    walks[element].slot = select(NONE, slots[at], found);
    walks[element].steps = steps;
}
