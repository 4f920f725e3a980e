// The ribbons over a pixel, linear light with straight alpha. The shader declares `compose` and `ribbons`.

fn ribbon_at(pixel: vec2<u32>) -> vec4<f32> {
    if (compose.flags & COMPOSE_RIBBONS) == 0u { return vec4<f32>(0.0); }
    return linear_of(textureLoad(ribbons, pixel, 0));
}
