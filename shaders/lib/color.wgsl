// Packed colours. Twin: npr_core::color.

fn pack_rgba8(rgba: vec4<f32>) -> u32 {
    let bytes = vec4<u32>(clamp(rgba, vec4<f32>(0.0), vec4<f32>(1.0)) * 255.0 + 0.5);
    return bytes.x | (bytes.y << 8u) | (bytes.z << 16u) | (bytes.w << 24u);
}

fn srgb_from_linear(v: f32) -> f32 {
    let c = clamp(v, 0.0, 1.0);
    if c <= 0.0031308 { return c * 12.92; }
    return 1.055 * pow(c, 1.0 / 2.4) - 0.055;
}
