// Ink where no surface has any.

fn even_ink(part: u32, corners: Corners, dark: u32) -> f32 {
    return 0.0;
}

fn inked(part: u32, lit: vec3<f32>, share: f32) -> vec3<f32> {
    return lit;
}
