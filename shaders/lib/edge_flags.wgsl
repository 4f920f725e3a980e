// Special properties of a mesh edge, or of a line along one. Twin: npr_core::edge_flags.

//# use lib/line_kind

const EDGE_BOUNDARY: u32 = KIND_BOUNDARY;
const EDGE_MATERIAL: u32 = KIND_MATERIAL;
const EDGE_FLIPPED: u32 = KINDS_END;
const EDGE_NON_MANIFOLD: u32 = KINDS_END << 1u;
const EDGE_CONCAVE: u32 = KINDS_END << 3u;
const EDGE_OPEN: u32 = KINDS_END << 4u;
const EDGE_REVERSED: u32 = KINDS_END << 5u;
const EDGE_POLYLINE: u32 = KINDS_END << 6u;
const EDGE_FACING: u32 = KINDS_END << 7u;
const EDGE_SEAM: u32 = KINDS_END << 9u;
