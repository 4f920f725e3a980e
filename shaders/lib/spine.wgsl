// Samples of lines. Twin: npr_vector::mesh_lines::sample.

struct SpineSample {
    place_px: vec2<f32>,
    outward: vec2<f32>,
    depth: f32,
    part: u32,
    line: u32,
    unused: u32,
}
