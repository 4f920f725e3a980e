// shade.even_tones: the median of the tones of a part over a disc round every pixel.
//
// Source  Merriman, Bence & Osher 1992, for edges that are blurred and cut
// Twin    npr_style::even_tones::even_tones
//
//# use lib/geometry
//# use lib/window

@group(0) @binding(0) var<uniform> window: Window;
@group(0) @binding(1) var<storage, read> parts: array<Part>;
@group(0) @binding(2) var<storage, read> tone_map: array<u32>;
@group(0) @binding(3) var tone_flags: texture_2d<u32>;

//# use lib/tone_word

// Half of pi: pixels over which the share of a disc on one side of a line goes from none to all, in radii.
const EDGE_OF_RADIUS: f32 = 1.57;

// Pixels below which a disc stays where it is.
const LEAST_SHIFT_PX: f32 = 0.05;

// Tones of a part over a disc.
struct Disc {
    // Weight of every tone.
    weights: array<f32, 8>,
    // Sum of them.
    sum: f32,
    // Sum of weights times distances from the middle, in pixels.
    moment: vec2<f32>,
}

// Bits of a word that stands for a pixel that no disc counts.
const UNCOUNTED: u32 = 0xffffffffu;

// The word with the tones of a pixel in a disc of a part: those of the part itself. To the knife all hatches that are
// cut out are one sheet of tone, and all else but black is paper.
fn counted(other: u32, part: u32) -> u32 {
    if !is_cut(part) { return select(UNCOUNTED, other, other >> ALL_TONE_BITS == part + 1u); }
    if other == 0u || !is_cut(part_in(other)) { return CUT_PAPER * FOUR_TONES; }
    return select(other, UNCOUNTED, (other & (TONES - 1u)) == CUT_BLACK);
}

// Tones over a disc round a pixel that shows a part; its middle is moved from there by `shift` pixels.
fn disc_at(pixel: vec2<u32>, shift: vec2<f32>, part: u32) -> Disc {
    var disc: Disc;
    let reach_px = parts[part].tone_reach_px;
    let stride = stride_px(reach_px);
    let far = u32(ceil(reach_px + 0.5 + max(abs(shift.x), abs(shift.y))));
    let most = (reach_px + 0.5) * (reach_px + 0.5);
    let steps = vec2<u32>((far + stride - 1u) / stride);
    let low = pixel - min(steps, pixel / stride) * stride;
    let high = min(pixel + steps * stride + 1u, window.size);
    for (var y = low.y; y < high.y; y += stride) {
        for (var x = low.x; x < high.x; x += stride) {
            let away = vec2<f32>(vec2<u32>(x, y)) - vec2<f32>(pixel) - shift;
            let square = away.x * away.x + away.y * away.y;
            if square > most { continue; }
            let other = counted(tone_map[y * window.size.x + x], part);
            if other == UNCOUNTED { continue; }
            let weight = min(reach_px + 0.5 - sqrt(square), 1.0);
            let first = other & (TONES - 1u);
            if (other & ((1u << ALL_TONE_BITS) - 1u)) == first * FOUR_TONES {
                disc.weights[first] += weight;
            } else {
                for (var sample = 0u; sample < 4u; sample++) {
                    disc.weights[(other >> (sample * TONE_BITS)) & (TONES - 1u)] += weight * 0.25;
                }
            }
            disc.sum += weight;
            disc.moment += weight * away;
        }
    }
    return disc;
}

// Word of the evened map of a pixel.
fn evened_word(pixel: vec2<u32>, word: u32) -> u32 {
    // Keep the tone where all around are alike.
    if word == 0u { return 0u; }
    let part = part_in(word);
    let tone = word & (TONES - 1u);
    if is_cut(part) && tone != CUT_TONE { return tag_of(part) | select(0u, STEP_PARTS, tone == CUT_PAPER); }
    if textureLoad(tone_flags, pixel / TONE_TILE, 0).x == 0u { return tag_of(part) | (tone * STEP_PARTS); }

    // Weigh the tones of the part around it, away from other parts.
    var disc = disc_at(pixel, vec2<f32>(0.0), part);
    let most = vec2<f32>(SHIFT_OF_RADIUS * parts[part].tone_reach_px);
    let shift = clamp(disc.moment * (SHIFT_OF_CENTROID / disc.sum), -most, most);
    if any(abs(shift) > vec2<f32>(LEAST_SHIFT_PX)) { disc = disc_at(pixel, shift, part); }

    // Sum the steps that most of them have passed, the last one in part.
    let per_px = EDGE_OF_RADIUS * parts[part].tone_reach_px;
    var passed = 0.0;
    var above = 0.0;
    for (var i = TONES - 1u; i > 0u; i--) {
        above += disc.weights[i];
        passed += clamp((above / disc.sum - 0.5) * per_px + 0.5, 0.0, 1.0);
    }
    let steps = u32(passed * f32(STEP_PARTS) + 0.5);
    return tag_of(part) | select(CHANGED, 0u, median_of(steps) == tone) | steps;
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    let corner = vec2<f32>(f32(index & 1u), f32(index >> 1u)) * 4.0 - 1.0;
    return vec4<f32>(corner, 0.0, 1.0);
}

@fragment
fn fragment(@builtin(position) at: vec4<f32>) -> @location(0) u32 {
    let pixel = vec2<u32>(at.xy);
    return evened_word(pixel, tone_map[pixel.y * window.size.x + pixel.x]);
}
