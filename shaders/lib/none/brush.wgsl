// Strokes of one even ink.

fn brush_ink(element: u32, px: vec2<f32>) -> f32 {
    return 1.0;
}
