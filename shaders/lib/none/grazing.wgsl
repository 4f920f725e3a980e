// Surfaces that show no line at a grazing angle.

fn grazing(triangle: Triangle, corners: Corners, px: vec2<f32>) -> f32 {
    return 0.0;
}
