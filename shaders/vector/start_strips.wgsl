// vector.start_strips: marks the first side of every strip of kept sides.
//
// Source  Jiang et al. 2022, segmentation
// Twin    npr_vector::pixel_strokes::strip::start_strips
//
//# use lib/grid
//# use lib/looped

@group(0) @binding(0) var<storage, read> spots: array<Spot>;
@group(0) @binding(1) var<storage, read> kept: array<u32>;
@group(0) @binding(2) var<storage, read_write> flags: array<u32>;

// One invocation per side.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&spots) { return; }

    let ahead = before(spots[element], element);
    flags[element] = select(0u, 1u, kept[element] != 0u && kept[ahead] == 0u);
}
