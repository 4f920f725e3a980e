// vector.smooth_loops: replaces every vector by the weighted mean of those around it, along its loop.
//
// Source  Jiang et al. 2022, curve filtering
// Twin    npr_vector::pixel_strokes::looped::smooth_loops
//
//# use lib/grid
//# use lib/looped

@group(0) @binding(0) var<uniform> means: Filter;
@group(0) @binding(1) var<storage, read> weights: array<f32>;
@group(0) @binding(2) var<storage, read> spots: array<Spot>;
@group(0) @binding(3) var<storage, read> vectors_in: array<Planar>;
@group(0) @binding(4) var<storage, read_write> vectors_out: array<Planar>;

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
    var at = back(spot, element, means.radius);
    var mean: Planar;
    for (var step = 0u; step < 2u * means.radius + 1u; step++) {
        let away = select(means.radius - step, step - means.radius, step > means.radius);
        let weight = weights[away];
        let there = vectors_in[at];
        mean.x += weight * there.x;
        mean.y += weight * there.y;
        at = after(spot, at);
    }
    if means.unit != 0u { mean = unit_of(mean); }
    vectors_out[element] = mean;
}
