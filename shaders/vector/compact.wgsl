// vector.compact: writes the indices of marked elements in a row.
//
// The place of each is the scan of the marks, so the order never changes.
//
// Source  Hillis & Steele 1986
// Twin    npr_vector::rank::scan::compact
//
//# use lib/grid

@group(0) @binding(0) var<storage, read> flags: array<u32>;
@group(0) @binding(1) var<storage, read> slots: array<u32>;
@group(0) @binding(2) var<storage, read_write> list: array<u32>;

// One invocation per element.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&flags) { return; }

    let slot = slots[element];
    if flags[element] != 0u && slot < arrayLength(&list) { list[slot] = element; }
}
