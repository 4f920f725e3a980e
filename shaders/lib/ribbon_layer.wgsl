// The ribbons over a pixel. The shader declares `compose` and `ribbons`.

// The ribbons over a pixel as an sRGB texel with coverage in alpha.
fn ribbon_texel(pixel: vec2<u32>) -> u32 {
    if (compose.flags & COMPOSE_RIBBONS) == 0u { return 0u; }
    return pack_rgba8(textureLoad(ribbons, pixel, 0));
}
