// Smooth steps. Twin: npr_core::math::smoothstep.

fn smooth_step(low: f32, high: f32, x: f32) -> f32 {
    if high <= low { return select(0.0, 1.0, x >= low); }
    let t = clamp((x - low) / (high - low), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

// `smooth_step` for four values.
fn smooth_steps(low: f32, high: f32, x: vec4<f32>) -> vec4<f32> {
    if high <= low { return select(vec4<f32>(0.0), vec4<f32>(1.0), x >= vec4<f32>(low)); }
    let t = clamp((x - low) / (high - low), vec4<f32>(0.0), vec4<f32>(1.0));
    return t * t * (3.0 - 2.0 * t);
}
