// What the knife takes a pixel for where no surface has ink.

fn cut_tone_at(id: u32, constants: TriangleConstants, px: vec2<f32>) -> u32 {
    return 0u;
}
