// Packed textures. Twin: npr_core::texture. The shader declares `texels: array<u32>`.

//# use lib/color

const HEADER_WORDS: u32 = 6u;
fn linear_byte(byte: u32) -> f32 {
    return bitcast<f32>(texels[byte]);
}

fn linear_texel(texel: u32) -> vec4<f32> {
    return vec4<f32>(
        linear_byte(texel & 255u),
        linear_byte((texel >> 8u) & 255u),
        linear_byte((texel >> 16u) & 255u),
        f32(texel >> 24u) / 255.0,
    );
}

// Linear light of an sRGB texel with straight alpha, as bytes hold it.
fn linear_of(srgb: vec4<f32>) -> vec4<f32> {
    return linear_texel(pack_rgba8(srgb));
}
