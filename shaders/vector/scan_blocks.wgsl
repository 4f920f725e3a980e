// vector.scan_blocks: in each workgroup, the sums of all values before each one, and the sum of all.
//
// Zeros follow the last sum up to a whole block, so that the next level may sum whole blocks however many workgroups
// ran.
//
// Source  Hillis & Steele 1986
// Twin    npr_vector::rank::scan::scan_blocks
//
//# use lib/grid

override WG: u32 = 64u;

const BLOCK: u32 = 64u;

@group(0) @binding(0) var<storage, read> values: array<u32>;
@group(0) @binding(1) var<storage, read_write> prefixes: array<u32>;
@group(0) @binding(2) var<storage, read_write> sums: array<u32>;

// Sums of the values up to and with each invocation's own; two halves alternate.
var<workgroup> running: array<u32, 2u * BLOCK>;

// One invocation per value; WG is BLOCK.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    let is_inside = element < arrayLength(&values);
    var value = 0u;
    if is_inside { value = values[element]; }

    // Each invocation of the first workgroup clears a sum that no workgroup writes, if it lies in the last block.
    let group_count = nwg.x * nwg.y;
    let behind = group_count + lid.x;
    let is_last_block = behind / BLOCK == (group_count - 1u) / BLOCK;
    if wid.x + wid.y == 0u && is_last_block && behind < arrayLength(&sums) { sums[behind] = 0u; }

    var here = 0u;
    var there = BLOCK;
    running[here + lid.x] = value;
    workgroupBarrier();
    for (var width = 1u; width < BLOCK; width *= 2u) {
        var sum = running[here + lid.x];
        if lid.x >= width { sum += running[here + lid.x - width]; }
        running[there + lid.x] = sum;
        workgroupBarrier();
        let swapped = here;
        here = there;
        there = swapped;
    }

    // If workgroups come in rows, one past the end has nothing to write.
    if !is_inside { return; }
    prefixes[element] = running[here + lid.x] - value;
    if lid.x == 0u { sums[element / BLOCK] = running[here + BLOCK - 1u]; }
}
