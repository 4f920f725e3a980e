// vector.rank_jump: one round of Wyllie's list ranking.
//
// Each element adds to its hop the one from where it leads, so hops double every round. The host runs log2(n) rounds,
// swapping the two buffers in between.
//
// Source  Wyllie 1979; Jiang et al. 2022, serialisation
// Twin    npr_vector::rank::jump::rank_jump
//
//# use lib/grid
//# use lib/list

@group(0) @binding(0) var<storage, read> extent: array<u32>;
@group(0) @binding(1) var<storage, read> hops_in: array<Hop>;
@group(0) @binding(2) var<storage, read_write> hops_out: array<Hop>;

// One invocation per element.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= min(extent[0], arrayLength(&hops_out)) { return; }

    let here = hops_in[element];
    hops_out[element] = hopped_on(here, hops_in[here.far]);
}
