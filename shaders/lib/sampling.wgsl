// Samples of packed textures. Twin: npr_core::texture.

//# use lib/texture

const WRAP_CLAMP: u32 = 1u;
const WRAP_MIRROR: u32 = 2u;

fn wrapped(index: i32, size: u32, wrap: u32) -> u32 {
    let n = i32(size);
    if wrap == WRAP_CLAMP { return u32(clamp(index, 0, n - 1)); }
    let period = select(n, 2 * n, wrap == WRAP_MIRROR);
    let within = ((index % period) + period) % period;
    return u32(select(period - 1 - within, within, within < n));
}

struct TexelPair {
    first: u32,
    second: u32,
    share: f32,
}

fn texel_pair(coordinate: f32, size: u32, wrap: u32) -> TexelPair {
    var scaled = coordinate * f32(size) - 0.5;
    if !(abs(scaled) < 4194304.0) { scaled = 0.0; }
    let index = i32(floor(scaled));
    var pair: TexelPair;
    pair.first = wrapped(index, size, wrap);
    pair.second = wrapped(index + 1, size, wrap);
    pair.share = scaled - floor(scaled);
    return pair;
}

fn sample_level(start: u32, level: u32, uv: vec2<f32>) -> vec4<f32> {
    var size = vec2<u32>(texels[start], texels[start + 1u]);
    var first = start + HEADER_WORDS;
    for (var i = 0u; i < level; i++) {
        first += size.x * size.y;
        size = max(size / 2u, vec2<u32>(1u));
    }
    let x = texel_pair(uv.x, size.x, texels[start + 3u]);
    let y = texel_pair(uv.y, size.y, texels[start + 4u]);
    let a = linear_texel(texels[first + y.first * size.x + x.first]);
    let b = linear_texel(texels[first + y.first * size.x + x.second]);
    let c = linear_texel(texels[first + y.second * size.x + x.first]);
    let d = linear_texel(texels[first + y.second * size.x + x.second]);
    let top = a + (b - a) * x.share;
    let bottom = c + (d - c) * x.share;
    return top + (bottom - top) * y.share;
}

fn sample_texture(start: u32, uv: vec2<f32>, footprint_uv: f32) -> vec4<f32> {
    let levels = texels[start + 2u];
    let span = footprint_uv * f32(max(texels[start], texels[start + 1u]));
    let lod = clamp(log2(max(span, 1.0)), 0.0, f32(levels - 1u));
    // Clamp again: NaN would be a level far away, and the search for it a loop without end.
    let fine = min(u32(lod), levels - 1u);
    let t = lod - f32(fine);
    let near = sample_level(start, fine, uv);
    if t == 0.0 { return near; }
    let far = sample_level(start, min(fine + 1u, levels - 1u), uv);
    return near + (far - near) * t;
}
