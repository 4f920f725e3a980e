// Shadows of smoke where it throws none.

fn is_behind_smoke(map: u32, world: vec3<f32>) -> bool {
    return false;
}
