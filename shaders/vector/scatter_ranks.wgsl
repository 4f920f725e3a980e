// vector.scatter_ranks: gives nodes what is known of the elements that they count from.
//
// A node is unsettled if its element disagrees with the one before about the head of their chain, if that element's hop
// does not lead to the first of the chain, or if it counts from no element.
//
// Source  Helman & JaJa 1999; Rehman et al. 2009
// Twin    npr_vector::rank::place::scatter_ranks
//
//# use lib/grid
//# use lib/list

@group(0) @binding(0) var<storage, read> walks: array<Walk>;
@group(0) @binding(1) var<storage, read> first: array<Reach>;
@group(0) @binding(2) var<storage, read> settled: array<Reach>;
@group(0) @binding(3) var<storage, read> hops: array<Hop>;
@group(0) @binding(4) var<storage, read_write> places: array<ListPosition>;
@group(0) @binding(5) var<storage, read_write> unsettled: array<u32>;

// One invocation per node.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&walks) { return; }

    let walk = walks[element];
    var place: ListPosition;
    place.head = NONE;
    place.offset = 0u;
    var is_open = 1u;
    if walk.slot != NONE {
        let head = settled[walk.slot].least;
        let hop = hops[walk.slot];
        let is_common = settled[first[walk.slot].far].least == head;
        let is_first = hops[hop.far].far == hop.far;
        place.head = head;
        place.offset = hop.dist + walk.steps;
        is_open = select(1u, 0u, is_common && is_first);
    }
    places[element] = place;
    unsettled[element] = is_open;
}
