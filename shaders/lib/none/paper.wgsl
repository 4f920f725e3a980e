// Hatching on smooth paper.

fn on_paper(part: u32, ink: f32, px: vec2<f32>) -> f32 {
    return ink;
}
