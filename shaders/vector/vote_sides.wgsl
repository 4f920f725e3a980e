// vector.vote_sides: lets the sides around each one vote on whether it is kept.
//
// Source  Jiang et al. 2022, orientation culling
// Twin    npr_vector::pixel_strokes::strip::vote_sides
//
//# use lib/grid
//# use lib/looped

@group(0) @binding(0) var<uniform> rule: CullRule;
@group(0) @binding(1) var<storage, read> spots: array<Spot>;
@group(0) @binding(2) var<storage, read> kept_in: array<u32>;
@group(0) @binding(3) var<storage, read_write> kept_out: array<u32>;

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
    var at = back(spot, element, rule.vote_radius);
    let voters = 2u * rule.vote_radius + 1u;
    var votes = 0u;
    for (var voter = 0u; voter < voters; voter++) {
        votes += select(0u, 1u, kept_in[at] != 0u);
        at = after(spot, at);
    }
    kept_out[element] = select(0u, 1u, 2u * votes >= voters + rule.vote_margin);
}
