// Beams where there are none.

fn has_beams(pixel: vec2<u32>) -> bool {
    return false;
}
