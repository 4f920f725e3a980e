// vector.drop_short: drops the sides of strips that are too short to be strokes.
//
// Source  Jiang et al. 2022, segmentation
// Twin    npr_vector::pixel_strokes::strip::drop_short
//
//# use lib/grid
//# use lib/looped

@group(0) @binding(0) var<uniform> rule: CullRule;
@group(0) @binding(1) var<storage, read> strips: array<StripSpot>;
@group(0) @binding(2) var<storage, read> lengths: array<u32>;
@group(0) @binding(3) var<storage, read_write> kept: array<u32>;

// One invocation per side.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&strips) { return; }

    let start = strips[element].start;
    var is_long = false;
    if start != NONE { is_long = lengths[start] > rule.short; }
    kept[element] = select(0u, 1u, is_long);
}
