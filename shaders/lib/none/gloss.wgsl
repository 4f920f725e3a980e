// Highlights where no surface has any.

fn has_highlights(part: u32) -> bool {
    return false;
}

fn shines_gently(part: u32) -> bool {
    return true;
}

fn highlights_at(part: u32, world: vec3<f32>, normal: vec3<f32>, dark: u32) -> vec3<f32> {
    return vec3<f32>(0.0);
}
