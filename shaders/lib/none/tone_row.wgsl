// Rows of tones where there are none.

fn has_tone_row(part: u32) -> bool {
    return false;
}

fn row_light(row: u32, x: f32) -> vec3<f32> {
    return vec3<f32>(0.0);
}

fn row_is_even(row: u32, range: vec2<f32>) -> bool {
    return false;
}
