// Smoke over the surfaces of a pixel, and its shadow on them. Twin: npr_style::smoke::smoke_layer.
// The shader declares `view`, `window`, `compose`, `lights`, `ids` and the pictures `smoke_*`.

//# use lib/samples
//# use lib/four
//# use lib/smoke_cover
//# use lib/smoke_pen

// Smoke over a pixel.
struct SmokeLayer {
    color: vec4<f32>,
    depth: f32,
    // Which samples it covers.
    mask: u32,
    // Share of the surface or background that it hides in each sample.
    hidden: vec4<f32>,
}

fn smoke_layer_of(pixel: vec2<u32>, frame_px: vec2<f32>) -> SmokeLayer {
    var smoke_layer: SmokeLayer;
    if (compose.flags & COMPOSE_SMOKE) == 0u { return smoke_layer; }
    let bits = textureLoad(smoke_depths, pixel, 0).x;
    smoke_layer.mask = bits & SMOKE_LAYER_MASK;
    if smoke_layer.mask == 0u { return smoke_layer; }
    smoke_layer.depth = min(bitcast<f32>(bits & ~SMOKE_LAYER_MASK), FAR_DEPTH);
    smoke_layer.color = linear_of(textureLoad(smoke_colors, pixel, 0));
    smoke_layer.color = penned(pixel, frame_px, smoke_layer.color);
    let seen = ids_at(pixel);
    for (var i = 0u; i < sample_count(); i++) {
        let share = smoke_layer_over(smoke_layer, number_of(seen, i), i, frame_px);
        smoke_layer.hidden = with_sample(smoke_layer.hidden, i, share);
    }
    return smoke_layer;
}

// Share of triangle `id` that the smoke hides in sample `i`.
fn smoke_layer_over(smoke_layer: SmokeLayer, id: u32, i: u32, frame_px: vec2<f32>) -> f32 {
    if (smoke_layer.mask & (1u << i)) == 0u { return 0.0; }
    if id != 0u && depth_of(id, frame_px + sample_offset(i)) < smoke_layer.depth { return 0.0; }
    return smoke_layer.color.a;
}

// Mean share of a pixel that the smoke hides.
fn smoke_layer_shown(smoke_layer: SmokeLayer) -> f32 {
    return sum_over(smoke_layer.hidden, vec4<bool>(true)) / f32(sample_count());
}

// Whether a surface some pixels away lies before the smoke.
fn is_before_smoke_layer(smoke_layer: SmokeLayer, pixel: vec2<u32>, frame_px: vec2<f32>, step: vec2<f32>) -> bool {
    let px = floor(vec2<f32>(pixel) + step + 0.5);
    let at = vec2<u32>(clamp(px, vec2<f32>(0.0), vec2<f32>(window.size) - 1.0));
    let id = textureLoad(ids, at * compose.samples, 0).x;
    let there = frame_px + (vec2<f32>(at) - vec2<f32>(pixel)) * window.frame_step + sample_offset(0u);
    return id != 0u && depth_of(id, there) < smoke_layer.depth;
}

fn line_direction(k: u32) -> vec2<f32> {
    switch k {
        case 0u: { return vec2<f32>(1.0, 0.0); }
        case 1u: { return vec2<f32>(0.7, 0.7); }
        case 2u: { return vec2<f32>(0.0, 1.0); }
        case 3u: { return vec2<f32>(-0.7, 0.7); }
        case 4u: { return vec2<f32>(-1.0, 0.0); }
        case 5u: { return vec2<f32>(-0.7, -0.7); }
        case 6u: { return vec2<f32>(0.0, -1.0); }
        default: { return vec2<f32>(0.7, -0.7); }
    }
}

// Share of a pixel's lines that the smoke hides: 0 if a surface nearby lies before it.
fn line_fade(smoke_layer: SmokeLayer, pixel: vec2<u32>, frame_px: vec2<f32>) -> f32 {
    if smoke_layer.mask == 0u { return 0.0; }
    let shown = smoke_layer.color.a * f32(countOneBits(smoke_layer.mask)) / f32(sample_count());
    if is_before_smoke_layer(smoke_layer, pixel, frame_px, vec2<f32>(0.0)) { return 0.0; }
    let rings = vec3<f32>(1.0, 2.5, 5.0);
    for (var k = 0u; k < 24u; k++) {
        if is_before_smoke_layer(smoke_layer, pixel, frame_px, line_direction(k % 8u) * rings[k / 8u]) { return 0.0; }
    }
    return shown;
}
