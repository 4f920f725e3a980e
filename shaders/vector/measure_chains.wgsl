// vector.measure_chains: writes the length of every chain at its head, from the last node before a cut.
//
// Only heads get a length; all other entries keep their values.
//
// Source  Jiang et al. 2022, serialisation
// Twin    npr_vector::rank::place::measure_chains
//
//# use lib/grid
//# use lib/list

@group(0) @binding(0) var<storage, read> links: array<Link>;
@group(0) @binding(1) var<storage, read> places: array<ListPosition>;
@group(0) @binding(2) var<storage, read_write> lengths: array<u32>;

// One invocation per node.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&places) { return; }

    let next = links[element].next;
    var is_last = next == NONE;
    if !is_last { is_last = places[next].offset == 0u; }
    let place = places[element];
    if is_last && place.head < arrayLength(&lengths) {
        lengths[place.head] = place.offset + 1u;
    }
}
