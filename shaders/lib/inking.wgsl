// Ink and hatching at one point. Twin: npr_style::inking. The shader declares what its twin's layers hold.

//# use lib/ink_tone
//# use lib/ink_level
//# use lib/cut_tone
//# use lib/paper
//# use lib/four
//# use lib/second_layer

// Drawings to an octave.
const STEPS: f32 = 3.0;
// How much the deep tones of a blend are raised, and its light ones lowered.
const BLEND_LIFT: f32 = 3.4;
// Least S on the ridge of a stroke that is about to go, as a part of what comes in its place.
const RIDGE: f32 = 0.16;
// Change of luminance between two strokes from which the strokes give way to the tone's own edge.
const ABRUPT: f32 = 0.25;

// Chart distortion, 0..1, from which dots are placed on the screen instead.
const LOOSE: f32 = 0.3;

// Share of the hatch, from its lightest part, that full chart distortion fills with ink at once.
const DISTORTION_FILL: f32 = 0.22;

// Part of a pixel that is inked at a time where the crest of a stroke may lie within it.
const THIRD: f32 = 0.33333334;

fn ink_coverage(f: f32, slope: f32, threshold: f32) -> f32 {
    return clamp((threshold - f) / max(slope, 1e-6) + 0.5, 0.0, 1.0);
}

// Luminance S of a hatch, and its change over a pixel to the right and down.
struct Hatching {
    s: f32,
    slope: vec2<f32>,
    // Least change over a pixel with which its edges are smoothed.
    hairline: f32,
}

// Position of a pixel in a hatch, in tiles, and the steps from there to its neighbours.
struct HatchCoord {
    uv: vec2<f32>,
    right: vec2<f32>,
    down: vec2<f32>,
}

// How far strokes give way at a place: chart distortion, how far the tone changes too fast for them, and how far they
// are cut away, 0..1.
struct Calm {
    chart_distortion: f32,
    abrupt: f32,
    cut: f32,
}

// Tiles that a pixel covers across the strokes; if `isotropic`, the mean of both directions.
fn step_of(place: HatchCoord, isotropic: bool) -> f32 {
    if isotropic { return sqrt(abs(cross2(place.right, place.down))); }
    return length(vec2<f32>(place.right.x, place.down.x));
}

// How much of the surface of triangle `id` is inked at a place of the frame, 0..1; bits of `dark` are the lights whose
// shadow falls there.
fn ink_at(id: u32, part: u32, corners: Corners, px: vec2<f32>, dark: u32) -> f32 {
    let flags = parts[part].flags;
    if (flags & (PART_INK | PART_HATCH)) == 0u { return 0.0; }
    let places = places_around(px);
    let weights = weights_around(corners.clip, ndc_at(view, px), pixel_ndc(view));
    let levels = levels_at(id, part, corners, px, weights, dark);
    let l = levels.l;
    // Clamp the change: beyond a silhouette the surface runs on to anywhere.
    let darkens = clamp(2.0 * vec2<f32>(l[1] - l[0], l[2] - l[0]), vec2<f32>(-1.0), vec2<f32>(1.0));
    if (flags & PART_HATCH) == 0u {
        return ink_coverage(tone_value(NO_HATCH, l[0]), length(darkens), parts[part].threshold);
    }
    let ink = ink_of_level(part, l[0]);
    if ink >= 0.0 { return on_paper(part, ink, px); }
    let chart_distortion = pen_at(id, weights[0]).x;
    var calm: Calm;
    calm.chart_distortion = chart_distortion * levels.white;
    calm.abrupt = abruptness(levels.per_px, parts[part].spacing_px);
    if (flags & PART_CUT) != 0u { calm.cut = 1.0 - hatch_left(px); }
    var place = place_in_hatch(id, part, weights, places);
    if (flags & PART_ISOTROPIC) != 0u && chart_distortion >= LOOSE {
        calm.chart_distortion = 0.0;
        place = place_on_screen(part, px);
    }
    return on_paper(part, ink_of_hatch(part, place, l[0], darkens, calm), px);
}

// Coordinates of a pixel and its neighbours in the hatch of a part that is laid on the picture.
fn place_on_screen(part: u32, px: vec2<f32>) -> HatchCoord {
    let header = parts[part].hatch;
    let scale = bitcast<f32>(texels[header + 3u]) / (f32(texels[header]) * parts[part].spacing_px);
    var place: HatchCoord;
    place.uv = px * scale;
    place.right = vec2<f32>(scale, 0.0);
    place.down = vec2<f32>(0.0, scale);
    return place;
}

// Ink of a hatched surface at luminance `l` if no stroke is thin or wide enough to matter: 1 or 0; -1 if the hatch
// decides.
fn ink_of_level(part: u32, l: f32) -> f32 {
    let room = 1.0 / parts[part].spacing_px;
    if tone_value(sharpen(0.0, parts[part].hatch_gain), l) - room > parts[part].threshold { return 0.0; }
    if tone_value(sharpen(1.0, parts[part].hatch_gain), l) + room < parts[part].threshold { return 1.0; }
    return -1.0;
}

// Ink of hatched surface at the luminance `l` of its shade ramp, which changes F by `darkens` over a pixel.
fn ink_of_hatch(part: u32, place: HatchCoord, l: f32, darkens: vec2<f32>, calm: Calm) -> f32 {
    let ink = ink_of_layer(part, place, false, l, darkens, calm);
    return ink_of_second(part, place, ink, l, darkens, calm);
}

// One of the layers of a hatch at a place of its sheet.
fn layer_at(part: u32, sheet: HatchSheet, place: HatchCoord, is_second: bool, calm: Calm) -> Hatching {
    let raw = hatch_at_place(part, sheet, place);
    let layer = sharpened(part, scaled(raw, share_of_layer(part, raw.s, is_second)));
    return toned_hatch(untied(layer, calm.chart_distortion), max(calm.abrupt, calm.cut));
}

// Ink of one layer of a hatch over a pixel, 0..1, and the luminance S at its middle. Where the crest of a stroke or of
// a gap may lie within the pixel, its thirds across the strokes are inked one by one.
fn ink_of_layer(
    part: u32,
    place: HatchCoord,
    is_second: bool,
    l: f32,
    darkens: vec2<f32>,
    calm: Calm,
) -> vec2<f32> {
    let sheet = hatch_sheet(part, place);
    let middle = layer_at(part, sheet, place, is_second, calm);
    let threshold = parts[part].threshold;
    let value = tone_value(middle.s, l);
    let is_plain = (parts[part].flags & PART_ISOTROPIC) != 0u
        || abs(value - threshold) > parts[part].hatch_gain / parts[part].spacing_px;
    if is_plain { return vec2<f32>(ink_coverage(value, layer_slope(middle, darkens), threshold), middle.s); }
    let across = across_strokes(place);
    var sum = ink_coverage(value, layer_slope(middle, darkens) * THIRD, threshold);
    for (var i = 0u; i < 2u; i++) {
        let off = select(-THIRD, THIRD, i == 1u);
        let layer = layer_at(part, sheet, place_beside(place, across, off), is_second, calm);
        let darker = (across.x * darkens.x + across.y * darkens.y) * off;
        sum += ink_coverage(tone_value(layer.s, l) + darker, layer_slope(layer, darkens) * THIRD, threshold);
    }
    return vec2<f32>(sum * THIRD, middle.s);
}

// Change of F over a pixel with which the edges of a layer are smoothed.
fn layer_slope(layer: Hatching, darkens: vec2<f32>) -> f32 {
    return max(length(layer.slope + darkens), layer.hairline);
}

// Direction in the picture, to the right and down, in which places leave a stroke the fastest.
fn across_strokes(place: HatchCoord) -> vec2<f32> {
    let leaving = vec2<f32>(place.right.x, place.down.x);
    return leaving / max(length(leaving), 1e-9);
}

// The place `px` pixels further on in a direction of the picture.
fn place_beside(place: HatchCoord, direction: vec2<f32>, px: f32) -> HatchCoord {
    var further = place;
    further.uv += (place.right * direction.x + place.down * direction.y) * px;
    return further;
}

// One of the three corners of a triangle in its chart.
fn chart_corner(triangle: u32, corner: u32) -> vec2<f32> {
    let at = vec2<u32>(triangle % CHART_ACROSS * CHART_TEXELS + 2u * corner, triangle / CHART_ACROSS);
    let bits = vec2<u32>(textureLoad(charts, at, 0).x, textureLoad(charts, at + vec2<u32>(1u, 0u), 0).x);
    return bitcast<vec2<f32>>(bits);
}

// The chart of a triangle.
fn chart_of(triangle: u32) -> ChartCorners {
    var chart: ChartCorners;
    chart.a = chart_corner(triangle, 0u);
    chart.b = chart_corner(triangle, 1u);
    chart.c = chart_corner(triangle, 2u);
    return chart;
}

// Coordinates of a pixel and its neighbours to the right and below in the hatch of a part.
fn place_in_hatch(id: u32, part: u32, weights: array<vec3<f32>, 3>, places: array<vec2<f32>, 3>) -> HatchCoord {
    let index = (id & ID_MASK) - 1u;
    let flags = parts[part].flags;
    var chart: ChartCorners;
    if (flags & PART_ON_SURFACE) != 0u {
        chart = chart_of(index);
    } else if (flags & PART_ON_SCREEN) == 0u {
        let at = triangles[index].corners;
        chart = ChartCorners(vertices[at.x].uv, vertices[at.y].uv, vertices[at.z].uv);
    }
    let turn = parts[part].turn;
    var uvs: array<vec2<f32>, 3>;
    for (var i = 0u; i < 3u; i++) {
        let w = weights[i];
        let is_laid = (flags & PART_ON_SCREEN) != 0u;
        let raw = select(chart.a * w.x + chart.b * w.y + chart.c * w.z, places[i], is_laid);
        uvs[i] = vec2<f32>(raw.x * turn.x + raw.y * turn.y, raw.y * turn.x - raw.x * turn.y) * parts[part].tile_scale;
    }
    var place: HatchCoord;
    place.uv = uvs[0];
    place.right = uvs[1] - uvs[0];
    place.down = uvs[2] - uvs[0];
    return place;
}

// How far a tone changes from dark to light too fast for strokes to show, 0..1.
fn abruptness(per_px: f32, spacing_px: f32) -> f32 {
    return clamp((per_px * spacing_px - ABRUPT) / ABRUPT, 0.0, 1.0);
}

// A hatch that gives way to the edge of the tone itself, as far as `share` says.
fn toned_hatch(full: Hatching, share: f32) -> Hatching {
    var hatching = full;
    hatching.s += (NO_HATCH - hatching.s) * share;
    hatching.slope *= 1.0 - share;
    hatching.hairline *= 1.0 - share;
    return hatching;
}

// A hatch whose white is filled where the chart is distorted: the last strokes merge up to a fifth earlier than they
// would.
fn untied(tied: Hatching, chart_distortion: f32) -> Hatching {
    var hatching = tied;
    let most = 1.0 - DISTORTION_FILL * clamp(chart_distortion, 0.0, 1.0);
    if hatching.s <= most { return hatching; }
    // Only the edge of the tone is left, which is crisp.
    hatching.s = most;
    hatching.slope = vec2<f32>(0.0);
    hatching.hairline = 0.0;
    return hatching;
}

// A layer with luminance `by.x` and its slope times `by.y`.
fn scaled(layer: Hatching, by: vec2<f32>) -> Hatching {
    var hatching: Hatching;
    hatching.s = by.x;
    hatching.slope = layer.slope * by.y;
    hatching.hairline = layer.hairline;
    return hatching;
}

fn sharpened(part: u32, layer: Hatching) -> Hatching {
    let gain = parts[part].hatch_gain;
    return scaled(layer, vec2<f32>(sharpen(layer.s, gain), gain));
}

// A level of the tile of a hatch: its first texel, texels per side, and how far towards the next level, 0..1.
struct HatchSheet {
    first: u32,
    side: u32,
    fraction: f32,
}

// The level of the tile of a hatch on which strokes lie as far apart on screen as the part asks.
fn hatch_sheet(part: u32, place: HatchCoord) -> HatchSheet {
    let header = parts[part].hatch;
    let side = texels[header];
    let step = max(step_of(place, (parts[part].flags & PART_ISOTROPIC) != 0u), 1e-9);
    let spacing_texels = bitcast<f32>(texels[header + 3u]);
    let detail = log2(step * f32(side) * parts[part].spacing_px / spacing_texels);
    let coarsest = f32(max(texels[header + 2u], 1u) - 1u);
    let held = min(max(detail, 0.0), coarsest);
    var sheet: HatchSheet;
    let level = u32(held);
    sheet.fraction = held - floor(held);
    sheet.side = side >> level;
    // Skip the levels before it, each four times as large as the next.
    sheet.first = header + HEADER_WORDS + 4u * (side * side - sheet.side * sheet.side) / 3u;
    return sheet;
}

// One layer of a hatch at a place.
fn hatch_at_place(part: u32, sheet: HatchSheet, place: HatchCoord) -> Hatching {
    let found = sample_hatch(sheet.first, sheet.side, place.uv, sheet.fraction);
    var hatching: Hatching;
    hatching.s = found.x;
    hatching.slope = vec2<f32>(dot(found.yz, place.right), dot(found.yz, place.down)) * f32(sheet.side);
    // On the ridge of a stroke S is flat, and a hairline would be all ink in one pixel and none in the next.
    hatching.hairline = 1.0 / parts[part].spacing_px;
    return hatching;
}

// Hatch luminance of a texel's four drawings at `f` between its level and the next: harmonic means of strokes and of
// white.
fn hatch_luminance(texel: vec4<f32>, f: f32) -> f32 {
    let place = f * STEPS;
    let step = min(u32(place), 2u);
    let t = place - f32(step);
    let near = max(texel[step], RIDGE * t * texel[step + 1u]);
    let far = max(texel[step + 1u], RIDGE * (1.0 - t) * texel[step]);
    let mean = mix(far, near, t);
    // Both harmonic means share one division.
    let over = 1.0 / (mean * (1.0 - mean));
    let strokes = near * far * (1.0 - mean) * over;
    let white = (1.0 - near) * (1.0 - far) * mean * over;
    let s = mix(strokes, 1.0 - white, strokes);
    return s + BLEND_LIFT * t * (1.0 - t) * s * s * (1.0 - s) * (s - 0.45);
}

fn hatch_at(first: u32, side: u32, x: i32, y: i32, f: f32) -> f32 {
    let at = first + (u32(y) & (side - 1u)) * side + (u32(x) & (side - 1u));
    return hatch_luminance(unpack4x8unorm(texels[at]), f);
}

// Hatch luminance at `uv` of a level whose texels start at `first`, and its change per texel along u and v.
fn sample_hatch(first: u32, side: u32, uv: vec2<f32>, f: f32) -> vec3<f32> {
    let at = (uv - floor(uv)) * f32(side) - 0.5;
    let low = floor(at);
    let t = at - low;
    let x = i32(low.x);
    let y = i32(low.y);
    let s00 = hatch_at(first, side, x, y, f);
    let s10 = hatch_at(first, side, x + 1, y, f);
    let s01 = hatch_at(first, side, x, y + 1, f);
    let s11 = hatch_at(first, side, x + 1, y + 1, f);
    return vec3<f32>(
        mix(mix(s00, s10, t.x), mix(s01, s11, t.x), t.y),
        mix(s10 - s00, s11 - s01, t.y),
        mix(s01 - s00, s11 - s10, t.x),
    );
}

// Ink of a tone that changes by `change` to the right and down, on a flat sheet; `at` is the position on it in pixels,
// and a pixel covers `scale` tiles.
fn ink_on_sheet(part: u32, at: vec2<f32>, scale: f32, tone: f32, change: vec2<f32>) -> f32 {
    if (parts[part].flags & (PART_INK | PART_HATCH)) == 0u { return 0.0; }
    let l = level_of(part, tone);
    let darker = vec2<f32>(level_of(part, tone + change.x) - l, level_of(part, tone + change.y) - l);
    let darkens = clamp(2.0 * darker, vec2<f32>(-1.0), vec2<f32>(1.0));
    if (parts[part].flags & PART_HATCH) == 0u {
        return ink_coverage(tone_value(NO_HATCH, l), length(darkens), parts[part].threshold);
    }
    let ink = ink_of_level(part, l);
    if ink >= 0.0 { return ink; }
    let turn = parts[part].turn;
    var place: HatchCoord;
    place.uv = vec2<f32>(at.x * turn.x + at.y * turn.y, at.y * turn.x - at.x * turn.y) * scale;
    place.right = vec2<f32>(turn.x, -turn.y) * scale;
    place.down = vec2<f32>(turn.y, turn.x) * scale;
    var calm: Calm;
    calm.abrupt = abruptness(length(darker), parts[part].spacing_px);
    return ink_of_hatch(part, place, l, darkens, calm);
}

// Ink of a triangle, the mean over the samples in `counted`, which lie in the shadows of the lights in `darks`; samples
// in the same shadows share one value. Ink that is the same all over the triangle is `known`, else it is -1.
fn mean_ink(id: u32, corners: Corners, known: f32, px: vec2<f32>, counted: u32, darks: vec4<u32>) -> f32 {
    let part = triangles[id - 1u].part;
    var values = vec4<f32>(0.0);
    var left = counted;
    loop {
        let dark = number_of(darks, firstTrailingBit(left));
        let alike = left & bits_of(darks == vec4<u32>(dark));
        left &= ~alike;
        var ink = known;
        if ink < 0.0 { ink = even_ink_in_shadow(part, corners, dark); }
        if ink < 0.0 {
            ink = ink_at(id, part, corners, px, dark);
        }
        values = select(values, vec4<f32>(ink), samples_in(alike));
        continuing { break if left == 0u; }
    }
    let first = value_at(values, firstTrailingBit(counted));
    let beyond = (values - first) / f32(countOneBits(counted));
    let added = select(vec4<f32>(0.0), beyond, samples_in(counted));
    return (((first + added.x) + added.y) + added.z) + added.w;
}
