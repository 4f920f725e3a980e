// Stamps or the mask over a pixel, linear light with straight alpha. The shader declares `compose` and `overlay`.

fn overlay_at(element: u32) -> vec4<f32> {
    if (compose.flags & COMPOSE_OVERLAY) == 0u { return vec4<f32>(0.0); }
    return linear_texel(overlay[element]);
}
