// vector.cut_loops: makes an element the first of its chain if its own first reach holds the chain's head.
//
// Source  Jiang et al. 2022, loop breaking
// Twin    npr_vector::rank::jump::cut_loops
//
//# use lib/grid
//# use lib/list

@group(0) @binding(0) var<storage, read> extent: array<u32>;
@group(0) @binding(1) var<storage, read> first: array<Reach>;
@group(0) @binding(2) var<storage, read> settled: array<Reach>;
@group(0) @binding(3) var<storage, read> hops_in: array<Hop>;
@group(0) @binding(4) var<storage, read_write> hops_out: array<Hop>;

// One invocation per element.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= min(extent[0], arrayLength(&hops_out)) { return; }

    hops_out[element] = cut_hop(first[element], settled[element], hops_in[element], element);
}
