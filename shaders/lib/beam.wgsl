// Beams of light. Twin: npr_style::beam.

//# use lib/samples
//# use lib/four
//# use lib/beam_ids

fn beam_color(part: u32, t: f32) -> vec4<f32> {
    let half = parts[part].softness * 0.5;
    var color = vec4<f32>(parts[part].ramp[0].rgb, parts[part].beam_alpha[0]);
    for (var i = 1u; i < 4u; i++) {
        let stop = parts[part].ramp[i];
        if stop.a > 1.5 { break; }
        let next = vec4<f32>(stop.rgb, parts[part].beam_alpha[i]);
        color += (next - color) * smooth_step(stop.a - half, stop.a + half, t);
    }
    return color;
}

// T = E . N of a beam, 0 at its rim and 1 in its middle.
fn beam_place(id: u32, frame_px: vec2<f32>) -> f32 {
    let corners = corners_of(triangle_of(triangles[(id & ID_MASK) - 1u]));
    let weights = weights_at(corners.clip, ndc_at(view, frame_px));
    return clamp(dot(normal_of(corners, weights), to_eye(view, world_of(corners, weights))), 0.0, 1.0);
}

// Whether a beam shows before a surface in sample `i` of a pixel.
fn beam_shows(id: u32, surface: u32, i: u32, frame_px: vec2<f32>) -> bool {
    if surface == 0u { return true; }
    if (parts[triangles[(id & ID_MASK) - 1u].part].flags & PART_BEAM_BEHIND) != 0u { return false; }
    let at = frame_px + sample_offset(i);
    return depth_of(id, at) < depth_of(surface, at);
}

struct Beams {
    // The pixel with beams over it, premultiplied.
    color: vec4<f32>,
    // How much of its lines they cover.
    covered: f32,
}

// Lays the beams over a pixel's surfaces.
fn add_beams(pixel: vec2<u32>, smoke_layer: SmokeLayer, frame_px: vec2<f32>, below: vec4<f32>) -> Beams {
    var result: Beams;
    var sum = vec4<f32>(0.0);
    let behind = ids_at(pixel);
    let here = beams_at(pixel);
    // Every beam once, from the first of its samples on.
    var left = bits_of(here != vec4<u32>(0u));
    while left != 0u {
        let id = number_of(here, firstTrailingBit(left));
        var members = bits_of(here == vec4<u32>(id));
        left &= ~members;
        var shown = 0.0;
        while members != 0u {
            let j = firstTrailingBit(members);
            members &= members - 1u;
            if beam_shows(id, number_of(behind, j), j, frame_px) {
                shown += (1.0 - smoke_layer_over(smoke_layer, id, j, frame_px)) / f32(sample_count());
            }
        }
        let part = triangles[(id & ID_MASK) - 1u].part;
        let glow = beam_color(part, beam_place(id, frame_px));
        sum += vec4<f32>(glow.rgb * glow.a, glow.a) * shown;
        if (parts[part].flags & PART_BEAM_COVERS) != 0u { result.covered += glow.a * shown; }
    }
    result.color = sum + below * (1.0 - sum.a);
    return result;
}
