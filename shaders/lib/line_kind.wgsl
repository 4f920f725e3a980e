// The bits of the kinds of line. Twin: npr_core::line_kind.

const KIND_CONTOUR: u32 = 1u;
const KIND_BOUNDARY: u32 = 2u;
const KIND_CREASE: u32 = 4u;
const KIND_MATERIAL: u32 = 8u;
const KIND_INTERSECTION: u32 = 16u;
const KIND_MARKED: u32 = 32u;
const KINDS: u32 = 2u * KIND_MARKED - 1u;
const KINDS_COLORED: u32 = KIND_MARKED - 1u;
const KINDS_EDGES: u32 = KIND_CONTOUR | KIND_BOUNDARY | KIND_CREASE | KIND_MATERIAL;
const KINDS_END: u32 = 1u << 16u;
const COLORED_KINDS: u32 = 5u;
