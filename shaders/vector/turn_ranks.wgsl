// vector.turn_ranks: counts from the head of a chain instead of from its cut.
//
// Source  Jiang et al. 2022, serialisation
// Twin    npr_vector::rank::place::turn_ranks
//
//# use lib/grid
//# use lib/list

@group(0) @binding(0) var<storage, read> places: array<ListPosition>;
@group(0) @binding(1) var<storage, read> lengths: array<u32>;
@group(0) @binding(2) var<storage, read_write> standings: array<Standing>;
@group(0) @binding(3) var<storage, read_write> sizes: array<u32>;
@group(0) @binding(4) var<storage, read_write> heads: array<u32>;

// One invocation per node.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&places) { return; }

    let place = places[element];
    let head = min(place.head, arrayLength(&places) - 1u);
    let length = lengths[head];
    let start = places[head].offset;
    let wraps = place.offset < start;
    let is_head = place.head == element;
    standings[element].head = place.head;
    standings[element].rank = place.offset - start + select(0u, length, wraps);
    standings[element].length = length;
    heads[element] = select(0u, 1u, is_head);
    sizes[element] = select(0u, length, is_head);
}
