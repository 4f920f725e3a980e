// Depth of smoke where there is none.

fn smoke_depth_at(pixel: vec2<u32>) -> f32 {
    return 0.0;
}
