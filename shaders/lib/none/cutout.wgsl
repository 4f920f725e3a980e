// Holes in cut-out parts where there are none.

fn is_hole_at(triangle: u32, weights: vec3<f32>) -> bool {
    return false;
}
