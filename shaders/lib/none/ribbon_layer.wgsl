// Ribbons where there are none.

fn ribbon_texel(pixel: vec2<u32>) -> u32 {
    return 0u;
}
