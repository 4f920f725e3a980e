// vector.start_splitters: gives every splitter a first hop and reach to the one before it.
//
// On the way back it finds the least of the nodes in between, since any of them
// may be the head of the chain.
//
// Source  Helman & JaJa 1999; Rehman et al. 2009
// Twin    npr_vector::rank::splitter::start_splitters
//
//# use lib/grid
//# use lib/list

@group(0) @binding(0) var<storage, read> extent: array<u32>;
@group(0) @binding(1) var<storage, read> links: array<Link>;
@group(0) @binding(2) var<storage, read> splitters: array<u32>;
@group(0) @binding(3) var<storage, read> walks: array<Walk>;
@group(0) @binding(4) var<storage, read_write> hops: array<Hop>;
@group(0) @binding(5) var<storage, read_write> reach: array<Reach>;

// One invocation per splitter.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    let slot = element;
    if slot >= extent[0] { return; }

    let node = splitters[slot];
    let link = links[node];
    var found: Reach;
    found.least = node;
    found.hash = precedence(link);
    found.far = slot;
    var dist = 0u;
    if link.prev != NONE {
        let before = walks[link.prev];
        // A walk that was too long is reported by its own node.
        if before.slot != NONE {
            found.far = before.slot;
            dist = before.steps + 1u;
        }
    }
    var at = node;
    for (var step = 1u; step < dist; step++) {
        at = links[at].prev;
        let hash = precedence(links[at]);
        if precedes(hash, at, found) {
            found.least = at;
            found.hash = hash;
        }
    }
    hops[slot].far = found.far;
    hops[slot].dist = dist;
    reach[slot] = found;
}
