// The samples of a pixel, one or two rows of two. The shader declares `compose` and `ids`.

//# use lib/compose

fn sample_count() -> u32 {
    return compose.samples * compose.samples;
}

// Position of sample `i` within a pixel, from its centre.
fn sample_offset(i: u32) -> vec2<f32> {
    if compose.samples == 1u { return vec2<f32>(0.0); }
    return vec2<f32>(f32(i & 1u), f32(i >> 1u)) * 0.5 - 0.25;
}

// The triangles that the samples of a pixel show, plus one; 0 where they show none.
fn ids_at(pixel: vec2<u32>) -> vec4<u32> {
    let at = pixel * compose.samples;
    let first = textureLoad(ids, at, 0).x;
    if compose.samples == 1u { return vec4<u32>(first, 0u, 0u, 0u); }
    return vec4<u32>(
        first,
        textureLoad(ids, at + vec2<u32>(1u, 0u), 0).x,
        textureLoad(ids, at + vec2<u32>(0u, 1u), 0).x,
        textureLoad(ids, at + vec2<u32>(1u, 1u), 0).x,
    );
}
