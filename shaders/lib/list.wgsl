// Linked lists and their ranking. Twin: npr_vector::rank.

//# use lib/geometry
//# use lib/random

const WINDOW: u32 = 8u;
const WALK_LIMIT: u32 = 512u;

struct Link {
    next: u32,
    prev: u32,
    key: u32,
}

struct Reach {
    far: u32,
    least: u32,
    hash: u32,
}

struct Hop {
    far: u32,
    dist: u32,
}

struct Walk {
    slot: u32,
    steps: u32,
}

struct ListPosition {
    head: u32,
    offset: u32,
}

struct Standing {
    head: u32,
    rank: u32,
    length: u32,
}

fn hash_key(key: u32) -> u32 {
    return max(mix_bits(key), 1u);
}

// 0 at the start of an open chain, nowhere else.
fn precedence(link: Link) -> u32 {
    if link.prev == NONE { return 0u; }
    return hash_key(link.key);
}

// Whether a node comes before the one that a reach has found.
fn precedes(hash: u32, node: u32, found: Reach) -> bool {
    return hash < found.hash || (hash == found.hash && node < found.least);
}

// Rounds after which chains of a number of elements are ranked: log2, rounded up.
fn rounds_for(count: u32) -> u32 {
    return 32u - countLeadingZeros(max(count, 1u) - 1u);
}

// The reach of an element continued by the reach from its end: one round of loop breaking.
fn looked_on(here: Reach, there: Reach) -> Reach {
    var reach = here;
    if precedes(there.hash, there.least, here) { reach = there; }
    reach.far = there.far;
    return reach;
}

// The hop of an element; it stays where it is, as the first of its chain, if its own first reach holds the chain's
// head.
fn cut_hop(first: Reach, settled: Reach, hop: Hop, element: u32) -> Hop {
    let is_first = first.least == settled.least;
    var cut = hop;
    cut.far = select(hop.far, element, is_first);
    cut.dist = select(hop.dist, 0u, is_first);
    return cut;
}

// A hop continued by the hop from where it leads: one round of ranking.
fn hopped_on(here: Hop, there: Hop) -> Hop {
    var hop = there;
    hop.dist = here.dist + there.dist;
    return hop;
}
