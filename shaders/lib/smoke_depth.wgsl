// How deep the smoke over a pixel lies. Twin: npr_style::picture_depth. The shader declares `view`, `compose` and
// `smoke_depths`.

//# use lib/smoke_cover
//# use lib/window

// Reversed depth of the smoke over a pixel, 0 without any.
fn smoke_depth_at(pixel: vec2<u32>) -> f32 {
    if !has_smoke(pixel) { return 0.0; }
    let far = bitcast<f32>(textureLoad(smoke_depths, pixel, 0).x & ~SMOKE_LAYER_MASK);
    return clamp(reversed_of(view, far), 0.0, 1.0);
}
