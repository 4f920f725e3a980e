// vector.scan_add: adds to every prefix the sum of all blocks before its own.
//
// Source  Hillis & Steele 1986
// Twin    npr_vector::rank::scan::scan_add
//
//# use lib/grid

const RUN: u32 = 8u;
const BLOCK: u32 = 512u;

@group(0) @binding(0) var<storage, read> prefixes_in: array<u32>;
@group(0) @binding(1) var<storage, read> offsets: array<u32>;
@group(0) @binding(2) var<storage, read_write> prefixes_out: array<u32>;

// One invocation per run.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let first = element_index(wid, nwg, lid, WG) * RUN;
    let count = arrayLength(&prefixes_in);
    if first >= count { return; }

    let offset = offsets[first / BLOCK];
    for (var element = first; element < min(first + RUN, count); element++) {
        prefixes_out[element] = prefixes_in[element] + offset;
    }
}
