// stroke.filter_visibility: gives every sample the verdict of the last clear sample up to it.
//
// The first sample of a line is clear, so no line looks beyond its start.
//
// Source  Cole & Finkelstein 2010, filtering along the line
// Twin    npr_vector::sampled::filter_visibility
//
//# use lib/grid

@group(0) @binding(0) var<storage, read> verdicts: array<u32>;
@group(0) @binding(1) var<storage, read> clear: array<u32>;
@group(0) @binding(2) var<storage, read> clear_slots: array<u32>;
@group(0) @binding(3) var<storage, read> clear_list: array<u32>;
@group(0) @binding(4) var<storage, read_write> visible: array<u32>;

// One invocation per sample.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&verdicts) { return; }

    let last = clear_list[clear_slots[element] + clear[element] - 1u];
    visible[element] = verdicts[last];
}
