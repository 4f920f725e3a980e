// Streaks where there are none.

fn streak_at(part: u32, world: vec3<f32>, normal: vec3<f32>, eye: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(0.0);
}
