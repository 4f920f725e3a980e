// Beams of light where there are none.

struct Beams {
    // The pixel with beams over it, premultiplied.
    color: vec4<f32>,
    // How much of its lines they cover.
    covered: f32,
}

fn add_beams(pixel: vec2<u32>, smoke_layer: SmokeLayer, frame_px: vec2<f32>, below: vec4<f32>) -> Beams {
    return Beams(below, 0.0);
}
