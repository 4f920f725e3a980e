// Ribbons where there are none.

fn ribbon_at(pixel: vec2<u32>) -> vec4<f32> {
    return vec4<f32>(0.0);
}
