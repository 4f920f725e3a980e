// vector.measure_strips: writes the length of every strip at its first side, from its last.
//
// Source  Jiang et al. 2022, segmentation by segmented scan
// Twin    npr_vector::pixel_strokes::strip::measure_strips
//
//# use lib/grid
//# use lib/looped

@group(0) @binding(0) var<storage, read> spots: array<Spot>;
@group(0) @binding(1) var<storage, read> kept: array<u32>;
@group(0) @binding(2) var<storage, read> strips: array<StripSpot>;
@group(0) @binding(3) var<storage, read_write> lengths: array<u32>;

// One invocation per side.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&strips) { return; }

    let strip = strips[element];
    if strip.start == NONE { return; }
    let next = after(spots[element], element);
    // In a loop that is one strip, the first side comes after the last. A strip has one last side, so no other
    // invocation writes this.
    if kept[next] == 0u || next == strip.start { lengths[strip.start] = strip.rank + 1u; }
}
