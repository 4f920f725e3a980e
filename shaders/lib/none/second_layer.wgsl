// Hatches of a single layer.

fn share_of_first(part: u32, s: f32) -> vec2<f32> {
    return vec2<f32>(s, 1.0);
}

fn ink_of_second(
    part: u32,
    place: HatchCoord,
    first: f32,
    ink: f32,
    l: f32,
    darkens: vec2<f32>,
    calm: Calm,
) -> f32 {
    return ink;
}
