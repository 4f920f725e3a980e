// vector.rank_strips: ranks the sides of all strips, which may run across the start of their loop's list.
//
// Source  Jiang et al. 2022, segmentation by segmented scan
// Twin    npr_vector::pixel_strokes::strip::rank_strips
//
//# use lib/grid
//# use lib/looped

@group(0) @binding(0) var<storage, read> spots: array<Spot>;
@group(0) @binding(1) var<storage, read> kept: array<u32>;
@group(0) @binding(2) var<storage, read> flags: array<u32>;
@group(0) @binding(3) var<storage, read> slots: array<u32>;
@group(0) @binding(4) var<storage, read> firsts: array<u32>;
@group(0) @binding(5) var<storage, read_write> strips: array<StripSpot>;

fn last_start(element: u32) -> u32 {
    let started = slots[element] + flags[element];
    if started == 0u { return NONE; }
    return firsts[started - 1u];
}

fn is_in_loop(spot: Spot, start: u32) -> bool {
    return start != NONE && start >= spot.start;
}

// One invocation per side.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&spots) { return; }

    let spot = spots[element];
    strips[element].start = NONE;
    strips[element].rank = 0u;
    if kept[element] == 0u { return; }
    var start = last_start(element);
    if !is_in_loop(spot, start) { start = last_start(spot.start + spot.length - 1u); }
    if !is_in_loop(spot, start) { start = spot.start; }
    strips[element].start = start;
    strips[element].rank = select(element + spot.length - start, element - start, element >= start);
}
