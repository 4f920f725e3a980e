// Packed colours. Twin: npr_core::color.

// Share of each channel in luminance [ITU-R BT.709].
const LUMA: vec3<f32> = vec3<f32>(0.2126, 0.7152, 0.0722);

fn pack_rgba8(rgba: vec4<f32>) -> u32 {
    let bytes = vec4<u32>(clamp(rgba, vec4<f32>(0.0), vec4<f32>(1.0)) * 255.0 + 0.5);
    return bytes.x | (bytes.y << 8u) | (bytes.z << 16u) | (bytes.w << 24u);
}

fn srgb_from_linear(v: f32) -> f32 {
    let c = clamp(v, 0.0, 1.0);
    if c <= 0.0031308 { return c * 12.92; }
    return 1.055 * pow(c, 1.0 / 2.4) - 0.055;
}

// Premultiplied linear light as sRGB bytes with straight alpha.
fn encoded(light: vec4<f32>) -> u32 {
    let straight = light.rgb / max(light.a, 1e-6);
    return pack_rgba8(vec4<f32>(
        srgb_from_linear(straight.r),
        srgb_from_linear(straight.g),
        srgb_from_linear(straight.b),
        light.a,
    ));
}

fn unpack_rgba8(packed: u32) -> vec4<f32> {
    return vec4<f32>(f32(packed & 255u), f32((packed >> 8u) & 255u), f32((packed >> 16u) & 255u), f32(packed >> 24u)) / 255.0;
}

fn linear_from_srgb(v: f32) -> f32 {
    if v <= 0.04045 { return v / 12.92; }
    return pow((v + 0.055) / 1.055, 2.4);
}

fn linear_rgb(srgb: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(linear_from_srgb(srgb.r), linear_from_srgb(srgb.g), linear_from_srgb(srgb.b));
}

fn srgb_of(light: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(srgb_from_linear(light.r), srgb_from_linear(light.g), srgb_from_linear(light.b));
}
