// What is the same all over a triangle. Twin: npr_style::triangle_constants.

struct TriangleConstants {
    // The triangle itself.
    corners: vec3<u32>,
    part: u32,
    // Linear light: the colour of the surface, or the light on it, or their product if both are known; with the ink
    // over it if KNOWN_WHOLE is set.
    color: vec3<f32>,
    // Bits of KNOWN_PLAIN to KNOWN_WHOLE; with the last, the colour as sRGB bytes above them.
    bits: u32,
}

const KNOWN_PLAIN: u32 = 1u;
const KNOWN_EVEN: u32 = 2u;
const KNOWN_MATT: u32 = 4u;
const KNOWN_BARE: u32 = 8u;
const KNOWN_SOLID: u32 = 16u;
const KNOWN_WHOLE: u32 = 32u;

// Place of the bytes of red, green and blue.
const KNOWN_BYTES: u32 = 8u;

// The bit `bit` if `is_so`.
fn learned(bit: u32, is_so: bool) -> u32 {
    return select(0u, bit, is_so);
}

// Ink, 0 or 1, where it is the same all over; else -1.
fn known_ink(known: TriangleConstants) -> f32 {
    if (known.bits & KNOWN_BARE) != 0u { return 0.0; }
    return select(-1.0, 1.0, (known.bits & KNOWN_SOLID) != 0u);
}

// The triangle that constants belong to.
fn triangle_of(constants: TriangleConstants) -> Triangle {
    return Triangle(constants.corners, constants.part);
}
