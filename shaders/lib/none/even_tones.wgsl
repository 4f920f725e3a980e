// Tones as light leaves them.

fn is_evened(part: u32) -> bool {
    return false;
}

struct Evened {
    is_so: bool,
    light: vec3<f32>,
    ink: f32,
}

fn evened_tone(part: u32, frame_px: vec2<f32>) -> Evened {
    return Evened(false, vec3<f32>(0.0), -1.0);
}
