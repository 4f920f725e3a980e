// The bits of the kinds of line. Twin: npr_core::line_kind.

const KIND_CONTOUR: u32 = 1u;
const KIND_BOUNDARY: u32 = 2u;
const KIND_CREASE: u32 = 4u;
const KIND_MATERIAL: u32 = 8u;
const KIND_INTERSECTION: u32 = 16u;
const KINDS: u32 = 63u;
