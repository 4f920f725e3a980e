// Light from behind where there is none.

fn back_light_at(part: u32, normal: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(0.0);
}
