// vector.rank_splitters: all rounds of loop breaking and list ranking at once, in one workgroup.
//
// For short lists, where a pass per round would take longer than the round.
//
// Source  Wyllie 1979; Rehman et al. 2009
// Twin    npr_vector::rank::splitter::rank_splitters
//
//# use lib/grid
//# use lib/list

@group(0) @binding(0) var<uniform> rounds: u32;
@group(0) @binding(1) var<storage, read> extent: array<u32>;
@group(0) @binding(2) var<storage, read> first: array<Reach>;
@group(0) @binding(3) var<storage, read> hops_in: array<Hop>;
@group(0) @binding(4) var<storage, read_write> settled: array<Reach>;
@group(0) @binding(5) var<storage, read_write> reach_scratch: array<Reach>;
@group(0) @binding(6) var<storage, read_write> hops: array<Hop>;
@group(0) @binding(7) var<storage, read_write> hops_scratch: array<Hop>;

// One workgroup in all; each invocation takes every WG-th element.
@compute @workgroup_size(WG)
fn main(@builtin(local_invocation_id) lid: vec3<u32>) {
    let count = extent[0];
    // More rounds would change nothing.
    let round_count = min(rounds, rounds_for(count));
    for (var i = lid.x; i < count; i += WG) { settled[i] = first[i]; }
    storageBarrier();
    for (var round = 0u; round < round_count; round++) {
        for (var i = lid.x; i < count; i += WG) { reach_scratch[i] = looked_on(settled[i], settled[settled[i].far]); }
        storageBarrier();
        for (var i = lid.x; i < count; i += WG) { settled[i] = reach_scratch[i]; }
        storageBarrier();
    }

    // Cut every chain at its head.
    for (var i = lid.x; i < count; i += WG) { hops[i] = cut_hop(first[i], settled[i], hops_in[i], i); }
    storageBarrier();
    for (var round = 0u; round < round_count; round++) {
        for (var i = lid.x; i < count; i += WG) { hops_scratch[i] = hopped_on(hops[i], hops[hops[i].far]); }
        storageBarrier();
        for (var i = lid.x; i < count; i += WG) { hops[i] = hops_scratch[i]; }
        storageBarrier();
    }
}
