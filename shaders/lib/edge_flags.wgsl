// Special properties of mesh edges. Twin: npr_core::edge_flags.

const EDGE_BOUNDARY: u32 = 2u;
const EDGE_MATERIAL: u32 = 8u;
const EDGE_FLIPPED: u32 = 64u;
const EDGE_NON_MANIFOLD: u32 = 128u;
const EDGE_OPEN: u32 = 1024u;
const EDGE_REVERSED: u32 = 2048u;
const EDGE_WIRE: u32 = 4096u;
