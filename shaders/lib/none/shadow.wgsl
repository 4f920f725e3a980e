// Cast shadows where no light throws any.

fn shadowed(id: u32, corners: Corners, weights: vec3<f32>) -> u32 {
    return 0u;
}

fn even_ink_in_shadow(part: u32, corners: Corners, dark: u32) -> f32 {
    return -1.0;
}
