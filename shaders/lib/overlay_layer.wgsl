// Stamps or the mask over a pixel; they lie in the picture itself before it is composed. The shader declares `compose`
// and `frame`.

// What lies over a pixel as an sRGB texel with coverage in alpha.
fn overlay_texel(element: u32) -> u32 {
    if (compose.flags & COMPOSE_OVERLAY) == 0u { return 0u; }
    return frame[element];
}
