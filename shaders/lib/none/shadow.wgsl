// Cast shadows where no light throws any.

fn shadowed(id: u32, corners: Corners, weights: vec3<f32>) -> u32 {
    return 0u;
}
