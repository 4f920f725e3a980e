// Smooth steps. Twin: npr_core::math::smoothstep.

fn smooth_step(low: f32, high: f32, x: f32) -> f32 {
    if high <= low { return select(0.0, 1.0, x >= low); }
    let t = clamp((x - low) / (high - low), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}
