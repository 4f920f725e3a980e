// The beams of a pixel. The shader declares `compose` and `beam_ids`.

//# use lib/samples
//# use lib/four

// The beams in the samples of a pixel, plus one; 0 where there are none.
fn beams_at(pixel: vec2<u32>) -> vec4<u32> {
    var here = vec4<u32>(0u);
    if (compose.flags & COMPOSE_BEAMS) == 0u { return here; }
    for (var i = 0u; i < sample_count(); i++) {
        let at = pixel * compose.samples + vec2<u32>(i & 1u, i >> 1u);
        here = with_number(here, i, textureLoad(beam_ids, at, 0).x);
    }
    return here;
}

fn has_beams(pixel: vec2<u32>) -> bool {
    return any(beams_at(pixel) != vec4<u32>(0u));
}
