// Ink where no surface has any.

fn mean_ink(id: u32, corners: Corners, known: f32, px: vec2<f32>, counted: u32, darks: vec4<u32>) -> f32 {
    return 0.0;
}

fn ink_on_sheet(part: u32, at: vec2<f32>, scale: f32, tone: f32, change: vec2<f32>) -> f32 {
    return 0.0;
}
