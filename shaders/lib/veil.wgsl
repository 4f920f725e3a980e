// Smoke over the surfaces of a pixel, and its shadow on them. Twin: npr_style::smoke::veil.
// The shader declares `view`, `window`, `compose`, `lights`, `ids` and the pictures `smoke_*`.

const VEIL_MASK: u32 = 15u;

// Smoke over a pixel.
struct Veil {
    color: vec4<f32>,
    depth: f32,
    // Which samples it covers.
    mask: u32,
    // How much it hides in each sample.
    hidden: array<f32, 4>,
}

fn veil_of(pixel: vec2<u32>, frame_px: vec2<f32>) -> Veil {
    var veil: Veil;
    if (compose.flags & COMPOSE_SMOKE) == 0u { return veil; }
    let bits = textureLoad(smoke_depths, pixel, 0).x;
    veil.mask = bits & VEIL_MASK;
    if veil.mask == 0u { return veil; }
    veil.depth = min(bitcast<f32>(bits & ~VEIL_MASK), FAR_DEPTH);
    veil.color = linear_of(textureLoad(smoke_colors, pixel, 0));
    if (compose.flags & COMPOSE_SMOKE_PEN) != 0u { veil.color = penned(pixel, frame_px, veil.color); }
    for (var i = 0u; i < compose.samples * compose.samples; i++) {
        let at = pixel * compose.samples + vec2<u32>(i & 1u, i >> 1u);
        veil.hidden[i] = veil_over(veil, textureLoad(ids, at, 0).x, i, frame_px);
    }
    return veil;
}

// How much the smoke hides of triangle `id` in sample `i`.
fn veil_over(veil: Veil, id: u32, i: u32, frame_px: vec2<f32>) -> f32 {
    if (veil.mask & (1u << i)) == 0u { return 0.0; }
    if id != 0u && depth_of(id, frame_px + sample_offset(i)) < veil.depth { return 0.0; }
    return veil.color.a;
}

// How much smoke shows in a pixel.
fn veil_shown(veil: Veil) -> f32 {
    var shown = 0.0;
    let count = compose.samples * compose.samples;
    for (var i = 0u; i < count; i++) { shown += veil.hidden[i]; }
    return shown / f32(count);
}

// Whether a surface some pixels away lies before the smoke.
fn is_before_veil(veil: Veil, pixel: vec2<u32>, frame_px: vec2<f32>, step: vec2<f32>) -> bool {
    let px = floor(vec2<f32>(pixel) + step + 0.5);
    let at = vec2<u32>(clamp(px, vec2<f32>(0.0), vec2<f32>(window.size) - 1.0));
    let id = textureLoad(ids, at * compose.samples, 0).x;
    let there = frame_px + (vec2<f32>(at) - vec2<f32>(pixel)) * window.frame_step + sample_offset(0u);
    return id != 0u && depth_of(id, there) < veil.depth;
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

// How much of the lines of a pixel the smoke hides: nothing where a surface near by lies before it.
fn line_fade(veil: Veil, pixel: vec2<u32>, frame_px: vec2<f32>) -> f32 {
    if veil.mask == 0u { return 0.0; }
    let shown = veil.color.a * f32(countOneBits(veil.mask)) / f32(compose.samples * compose.samples);
    if is_before_veil(veil, pixel, frame_px, vec2<f32>(0.0)) { return 0.0; }
    let rings = vec3<f32>(1.0, 2.5, 5.0);
    for (var k = 0u; k < 24u; k++) {
        if is_before_veil(veil, pixel, frame_px, line_direction(k % 8u) * rings[k / 8u]) { return 0.0; }
    }
    return shown;
}

fn smoke_texel(map: u32, at: vec2<u32>) -> f32 {
    switch map {
        case 0u: { return textureLoad(smoke_shadow_0, at, 0); }
        case 1u: { return textureLoad(smoke_shadow_1, at, 0); }
        case 2u: { return textureLoad(smoke_shadow_2, at, 0); }
        default: { return textureLoad(smoke_shadow_3, at, 0); }
    }
}

// Whether smoke stands between a place and the light of a shadow picture.
fn is_behind_smoke(map: u32, world: vec3<f32>) -> bool {
    let side = compose.smoke_shadow_side;
    if side == 0u { return false; }
    let texels = texels_around(lights.shadows[map], side, world);
    if !texels.is_seen { return false; }
    let low = texels.low;
    return are_nearer(texels, vec4<f32>(
        smoke_texel(map, low),
        smoke_texel(map, low + vec2<u32>(1u, 0u)),
        smoke_texel(map, low + vec2<u32>(0u, 1u)),
        smoke_texel(map, low + vec2<u32>(1u, 1u)),
    ));
}
