// Paint under the pen. Twin: npr_style::paint. The shader declares what its twin's layers hold, and has `tint` and
// `uv_at`.

//# use lib/color
//# use lib/compose

// Lightness (root of luminance) up to which paint is solid ink in any light.
const INKY: f32 = 0.12;
// Lightness from which paint counts as white paper.
const PAPERY: f32 = 0.75;
// Most white that light leaves, where 1 ends the last stroke.
const OPEN: f32 = 1.25;

fn paint_white(color: vec3<f32>, strength: f32) -> f32 {
    let lightness = sqrt(max(dot(color, LUMA), 0.0));
    let x = clamp((lightness - INKY) / (PAPERY - INKY), 0.0, 1.0);
    return x / max(x + strength * (1.0 - x), 1e-6);
}

fn painted_level(l: f32, white: f32, threshold: f32) -> f32 {
    let lit = 2.0 * l - threshold;
    if lit <= 0.0 || white >= 1.0 { return l; }
    return 0.5 * (min(lit, OPEN) * white + threshold);
}

// White that the paint of triangle `id` leaves at a pixel and its neighbours to the right and below; 1 if paint does
// not count.
fn paint_at(id: u32, part: u32, weights: array<vec3<f32>, 3>) -> array<f32, 3> {
    if (parts[part].flags & PART_PAINTED) == 0u { return array<f32, 3>(1.0, 1.0, 1.0); }
    let triangle = triangle_of(triangles[(id & ID_MASK) - 1u]);
    let paint = linear_texel(parts[part].paint_color);
    var uvs: array<vec2<f32>, 3>;
    for (var i = 0u; i < 3u; i++) { uvs[i] = uv_at(triangle, weights[i]); }
    let covered = footprint(uvs[0], uvs[1], uvs[2]);
    var white: array<f32, 3>;
    for (var i = 0u; i < 3u; i++) {
        var color = paint.rgb * tint(triangle, weights[i]);
        if parts[part].texture != NONE { color *= sample_texture(parts[part].texture, uvs[i], covered).rgb; }
        white[i] = paint_white(color, paint.a);
    }
    return white;
}
