// How dark a surface is to the pen: light, faces and paint together. Twin: npr_style::inking.
// The shader declares what its twin's layers hold.

//# use lib/ink_tone
//# use lib/paint
//# use lib/tone_word

// Share of ink from which dots are tone to the knife; of strokes, which taper off, any ink is.
const LEAST_INK: f32 = 0.08;

// Share of ink from which it is black to the knife.
const NEARLY_BLACK: f32 = 0.85;

// Two shares that triangle `id` has for the pen at these weights of its corners, 0..1: the distortion of its stroke
// chart, and how much of its shade is left out.
fn pen_at(id: u32, weights: vec3<f32>) -> vec2<f32> {
    let at = triangles[(id & ID_MASK) - 1u].corners;
    let a = unpack_shares(vertices[at.x].pen);
    let b = unpack_shares(vertices[at.y].pen);
    let c = unpack_shares(vertices[at.z].pen);
    return vec2<f32>(blend(weights, a.x, b.x, c.x), blend(weights, a.y, b.y, c.y));
}

// The shares that npr_core::math::pack_shares packed.
fn unpack_shares(packed: u32) -> vec2<f32> {
    return vec2<f32>(f32(packed & 0xffffu), f32(packed >> 16u)) / 65535.0;
}

// Luminance of a place of which the pen leaves out a share of the shade.
fn spared_level(l: f32, spared: f32) -> f32 {
    return l + spared;
}

// The places of a pixel and of its neighbours to the right and below.
fn places_around(px: vec2<f32>) -> array<vec2<f32>, 3> {
    return array<vec2<f32>, 3>(px, px + vec2<f32>(1.0, 0.0), px + vec2<f32>(0.0, 1.0));
}

// Luminance of the shade ramp at a pixel and its neighbours to the right and below, with the paint under it.
struct InkLevels {
    l: array<f32, 3>,
    // White that paint leaves at the pixel.
    white: f32,
    // How much the light under that paint changes over a pixel.
    per_px: f32,
}

fn levels_at(
    id: u32,
    part: u32,
    corners: Corners,
    px: vec2<f32>,
    weights: array<vec3<f32>, 3>,
    dark: u32,
) -> InkLevels {
    // Look how light it is.
    let places = places_around(px);
    let open = openness(corners, px);
    var lit: array<f32, 3>;
    for (var i = 0u; i < 3u; i++) {
        let seen = open_at(open, places[i] - px);
        let found = coordinate_under(world_of(corners, weights[i]), normal_of(corners, weights[i]), dark, seen);
        lit[i] = level_of(part, found.x);
    }
    if (parts[part].flags & PART_SPARED) != 0u {
        for (var i = 0u; i < 3u; i++) { lit[i] = spared_level(lit[i], pen_at(id, weights[i]).y); }
    }

    // Let the paint darken it. Where the light changes faster than strokes follow one another, they do not show it.
    let white = paint_at(id, part, weights);
    var levels: InkLevels;
    levels.white = white[0];
    levels.per_px = length(vec2<f32>(lit[1] - lit[0], lit[2] - lit[0])) * white[0];
    for (var i = 0u; i < 3u; i++) { levels.l[i] = painted_level(lit[i], white[i], parts[part].threshold); }
    return levels;
}

fn sharpen(s: f32, gain: f32) -> f32 {
    return clamp(0.5 + (s - 0.5) * gain, 0.0, 1.0);
}

// What the knife takes a hatch of luminance `l` of the shade ramp for: tone, paper or black.
fn cut_tone_of(part: u32, l: f32) -> u32 {
    let gain = parts[part].hatch_gain;
    if tone_value(sharpen(NEARLY_BLACK, gain), l) < parts[part].threshold { return CUT_BLACK; }
    let least = select(0.0, LEAST_INK, (parts[part].flags & PART_ISOTROPIC) != 0u);
    return select(CUT_PAPER, CUT_TONE, tone_value(sharpen(least, gain), l) < parts[part].threshold);
}

// What the knife takes a pixel for that shows triangle `id` of a part.
fn cut_tone_at(id: u32, constants: TriangleConstants, px: vec2<f32>) -> u32 {
    if (constants.bits & KNOWN_BARE) != 0u { return CUT_PAPER; }
    if (constants.bits & KNOWN_SOLID) != 0u { return CUT_BLACK; }
    let corners = corners_of(triangle_of(constants));
    let weights = weights_around(corners.clip, ndc_at(view, px), pixel_ndc(view));
    let dark = shadowed(id, corners, weights[0]);
    return cut_tone_of(constants.part, levels_at(id, constants.part, corners, px, weights, dark).l[0]);
}
