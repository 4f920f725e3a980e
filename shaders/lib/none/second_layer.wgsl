// Hatches of a single layer.

fn share_of_layer(part: u32, s: f32, is_second: bool) -> vec2<f32> {
    return vec2<f32>(s, 1.0);
}

fn ink_of_second(part: u32, place: HatchCoord, ink: vec2<f32>, l: f32, darkens: vec2<f32>, calm: Calm) -> f32 {
    return ink.x;
}
