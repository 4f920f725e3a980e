// A light's view as depths, looked up for a place. Twin: npr_style::smoke::depth_map.

// The four texels around a place in the picture that a light sees.
struct DepthTexels {
    // The texel to the upper left.
    low: vec2<u32>,
    // How far the place lies from that texel towards the one diagonally below it to the right, 0..1 along each axis.
    part: vec2<f32>,
    // Reversed depth of the place.
    nearness: f32,
    // Whether the light sees the place at all.
    is_seen: bool,
}

fn texels_around(m: mat4x4<f32>, side: u32, world: vec3<f32>) -> DepthTexels {
    var texels: DepthTexels;
    let clip = apply_point(m, world);
    let length = f32(side);
    let at = vec2<f32>((clip.x / clip.w + 1.0) * 0.5 * length - 0.5, (1.0 - clip.y / clip.w) * 0.5 * length - 0.5);
    if !(clip.w > 0.0 && all(at >= vec2<f32>(0.0)) && all(at < vec2<f32>(length - 1.0))) { return texels; }
    texels.low = vec2<u32>(at);
    texels.part = at - vec2<f32>(texels.low);
    texels.nearness = clip.z / clip.w;
    texels.is_seen = true;
    return texels;
}

// Whether the depths of the four texels, row by row, lie before the place: a vote, weighted by nearness.
fn are_nearer(texels: DepthTexels, depths: vec4<f32>) -> bool {
    let dark = select(vec4<f32>(0.0), vec4<f32>(1.0), depths > vec4<f32>(texels.nearness));
    let upper = dark.x + (dark.y - dark.x) * texels.part.x;
    let lower = dark.z + (dark.w - dark.z) * texels.part.x;
    return upper + (lower - upper) * texels.part.y > 0.5;
}
