// Highlights without a shape of their own.

fn has_shape(part: u32) -> bool {
    return false;
}

fn shaped_half(half: vec3<f32>, normal: vec3<f32>, right: vec3<f32>, part: u32) -> vec3<f32> {
    return half;
}
