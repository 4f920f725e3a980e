// Hatches of which nothing is cut away.

fn hatch_left(frame_px: vec2<f32>) -> f32 {
    return 1.0;
}
