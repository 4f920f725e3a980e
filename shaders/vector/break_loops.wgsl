// vector.break_loops: one round of finding the head of every chain.
//
// Each element takes over what is found from the end of its reach on, and extends its reach to where that one ends: it
// doubles every round. The host runs log2(n) rounds, swapping the two buffers in between.
//
// Source  Jiang et al. 2022, loop breaking
// Twin    npr_vector::rank::jump::break_loops
// Differs: the head is the node with the least hash of its mesh key, not the one at the greatest place in the picture,
// so loops start at the same place in every frame.
//
//# use lib/grid
//# use lib/list

@group(0) @binding(0) var<storage, read> extent: array<u32>;
@group(0) @binding(1) var<storage, read> reach_in: array<Reach>;
@group(0) @binding(2) var<storage, read_write> reach_out: array<Reach>;

// One invocation per element.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= min(extent[0], arrayLength(&reach_out)) { return; }

    let here = reach_in[element];
    reach_out[element] = looked_on(here, reach_in[here.far]);
}
