// Smoke that needs no ink.

fn penned(pixel: vec2<u32>, frame_px: vec2<f32>, color: vec4<f32>) -> vec4<f32> {
    return color;
}
