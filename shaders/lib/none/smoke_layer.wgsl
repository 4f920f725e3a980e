// Smoke over the surfaces of a pixel where there is none.

struct SmokeLayer {
    color: vec4<f32>,
    hidden: vec4<f32>,
}

fn smoke_layer_of(pixel: vec2<u32>, frame_px: vec2<f32>) -> SmokeLayer {
    return SmokeLayer(vec4<f32>(0.0), vec4<f32>(0.0));
}

fn smoke_layer_over(smoke_layer: SmokeLayer, id: u32, i: u32, frame_px: vec2<f32>) -> f32 {
    return 0.0;
}

fn smoke_layer_shown(smoke_layer: SmokeLayer) -> f32 {
    return 0.0;
}

fn line_fade(smoke_layer: SmokeLayer, pixel: vec2<u32>, frame_px: vec2<f32>) -> f32 {
    return 0.0;
}
