// stroke.part_samples: marks the first sample of every visible and every hidden part of a line.
//
// Twin    npr_vector::sampled::part_samples
//
//# use lib/grid
//# use lib/spine

@group(0) @binding(0) var<storage, read> samples: array<SpineSample>;
@group(0) @binding(1) var<storage, read> visible: array<u32>;
@group(0) @binding(2) var<storage, read_write> part_starts: array<u32>;

// One invocation per sample.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&samples) { return; }

    part_starts[element] = 1u;
    if element == 0u { return; }
    let before = element - 1u;
    let goes_on = visible[before] == visible[element] && samples[before].line == samples[element].line;
    part_starts[element] = select(1u, 0u, goes_on);
}
