// vector.scan_blocks: in each workgroup, the sums of all values before each one, and the sum of all.
//
// An invocation adds up a run of values, eight neighbours add up their runs, and the workgroup those sums: two barriers
// for 512 values. Zeros follow the last sum up to a whole block, so that the next level may sum whole blocks however
// many workgroups ran.
//
// Twin    npr_vector::rank::scan::scan_blocks
//
//# use lib/grid

// Values of an invocation, and of a workgroup.
const RUN: u32 = 8u;
const BLOCK: u32 = 512u;

@group(0) @binding(0) var<storage, read> values: array<u32>;
@group(0) @binding(1) var<storage, read_write> prefixes: array<u32>;
@group(0) @binding(2) var<storage, read_write> sums: array<u32>;

// Sums of runs, and of eight runs each.
var<workgroup> runs: array<u32, BLOCK / RUN>;
var<workgroup> eights: array<u32, BLOCK / RUN / 8u>;

// A value, 0 behind the last.
fn value_at(element: u32) -> u32 {
    if element >= arrayLength(&values) { return 0u; }
    return values[element];
}

// Writes the sums before four values, the first of which is `before`; gives the sum with them.
fn write_sums(first: u32, before: u32, four: vec4<u32>) -> u32 {
    let count = arrayLength(&values);
    var sum = before;
    if first < count { prefixes[first] = sum; }
    sum += four.x;
    if first + 1u < count { prefixes[first + 1u] = sum; }
    sum += four.y;
    if first + 2u < count { prefixes[first + 2u] = sum; }
    sum += four.z;
    if first + 3u < count { prefixes[first + 3u] = sum; }
    return sum + four.w;
}

// One invocation per run; WG is BLOCK / RUN.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let run = element_index(wid, nwg, lid, WG);
    let first = run * RUN;
    let low = vec4<u32>(value_at(first), value_at(first + 1u), value_at(first + 2u), value_at(first + 3u));
    let high = vec4<u32>(value_at(first + 4u), value_at(first + 5u), value_at(first + 6u), value_at(first + 7u));
    let sum = low.x + low.y + low.z + low.w + high.x + high.y + high.z + high.w;

    // The first workgroup clears the sums that no workgroup writes, as far as they lie in the last block.
    let group_count = nwg.x * nwg.y;
    if wid.x + wid.y == 0u {
        for (var part = 0u; part < RUN; part++) {
            let behind = group_count + part * WG + lid.x;
            let is_last_block = behind / BLOCK == (group_count - 1u) / BLOCK;
            if is_last_block && behind < arrayLength(&sums) { sums[behind] = 0u; }
        }
    }

    runs[lid.x] = sum;
    workgroupBarrier();
    var before = 0u;
    for (var other = lid.x & ~7u; other < lid.x; other++) { before += runs[other]; }
    if (lid.x & 7u) == 7u { eights[lid.x / 8u] = before + sum; }
    workgroupBarrier();
    for (var other = 0u; other < lid.x / 8u; other++) { before += eights[other]; }

    // If workgroups come in rows, one past the end has nothing to write.
    let middle = write_sums(first, before, low);
    let end = write_sums(first + 4u, middle, high);
    let block = run / WG;
    if lid.x == WG - 1u && block < arrayLength(&sums) && block * BLOCK < arrayLength(&values) { sums[block] = end; }
}
