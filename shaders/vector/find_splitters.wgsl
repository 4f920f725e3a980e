// vector.find_splitters: marks the splitters, nodes that all others count from.
//
// A node is a splitter if its hash is the least in a window of its list, or if a list starts with it.
//
// Source  Helman & JaJa 1999; Rehman et al. 2009
// Twin    npr_vector::rank::splitter::find_splitters
// Differs: the papers take splitters at regular places of memory, or at random.
//
//# use lib/grid
//# use lib/list

@group(0) @binding(0) var<storage, read> links: array<Link>;
@group(0) @binding(1) var<storage, read_write> flags: array<u32>;

fn is_splitter(element: u32) -> bool {
    if links[element].prev == NONE { return true; }
    let own = mix_bits(element);
    var ahead = element;
    var behind = element;
    for (var step = 0u; step < WINDOW; step++) {
        if ahead != NONE { ahead = links[ahead].next; }
        if behind != NONE { behind = links[behind].prev; }
        if ahead != NONE && mix_bits(ahead) < own { return false; }
        if behind != NONE && mix_bits(behind) < own { return false; }
    }
    return true;
}

// One invocation per node.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&links) { return; }

    flags[element] = select(0u, 1u, is_splitter(element));
}
