// Samples that smoke covers where there is none.

fn has_smoke(pixel: vec2<u32>) -> bool {
    return false;
}
