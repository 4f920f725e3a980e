// vector.drop_specks: marks the sides of all loops that are no specks.
//
// The area of a loop is a difference of two sums in the scan of its sides' shares.
//
// Source  Jiang et al. 2022, despeckling
// Twin    npr_vector::pixel_strokes::looped::drop_specks
//
//# use lib/grid
//# use lib/looped

struct SpeckRule {
    area: f32,
    thin_area: f32,
    thinness: f32,
    unused: u32,
}

@group(0) @binding(0) var<uniform> rule: SpeckRule;
@group(0) @binding(1) var<storage, read> spots: array<Spot>;
@group(0) @binding(2) var<storage, read> areas: array<u32>;
@group(0) @binding(3) var<storage, read> sums: array<u32>;
@group(0) @binding(4) var<storage, read_write> kept: array<u32>;

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
    let last = spot.start + spot.length - 1u;
    let end = sums[last] + areas[last];
    let area = bitcast<i32>(end - sums[spot.start]);
    let size = f32(u32(abs(area)));
    let is_thin = size <= rule.thinness * f32(spot.length);
    let is_speck = size < rule.area || (size < rule.thin_area && is_thin);
    kept[element] = select(1u, 0u, is_speck);
}
