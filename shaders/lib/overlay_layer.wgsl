// Stamps or the mask over a pixel, linear light with straight alpha. They lie in the picture itself before it is
// composed. The shader declares `compose` and `frame`.

fn overlay_at(element: u32) -> vec4<f32> {
    if (compose.flags & COMPOSE_OVERLAY) == 0u { return vec4<f32>(0.0); }
    return linear_texel(frame[element]);
}
