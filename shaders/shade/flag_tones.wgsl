// shade.flag_tones: 1 for every tile of pixels around which a part may show more than one tone.
//
// Twin    npr_style::even_tones::flag_tones
//
//# use lib/geometry

@group(0) @binding(0) var<uniform> window: Window;
@group(0) @binding(1) var<storage, read> parts: array<Part>;
@group(0) @binding(2) var<storage, read> tone_map: array<u32>;

//# use lib/window
//# use lib/tone_word

// The first tone in a tile; 0 if there is none.
fn first_tone(start: vec2<u32>, end: vec2<u32>) -> u32 {
    for (var y = start.y; y < end.y; y++) {
        for (var x = start.x; x < end.x; x++) {
            let word = tone_map[y * window.size.x + x];
            if word != 0u { return word; }
        }
    }
    return 0u;
}

// Pixels to each side of a tile within which a hatch that it shows may be cut; 0 if it shows none.
fn cut_far_px(start: vec2<u32>, end: vec2<u32>) -> u32 {
    var far = 0u;
    for (var y = start.y; y < end.y; y++) {
        for (var x = start.x; x < end.x; x++) {
            let word = tone_map[y * window.size.x + x];
            if is_cut_tone(word) { far = max(far, far_px(parts[part_in(word)].tone_reach_px)); }
        }
    }
    return far;
}

// Whether a pixel shows the hatch of a part that is cut out.
fn is_cut_tone(word: u32) -> bool {
    return word != 0u && (word & (TONES - 1u)) == CUT_TONE && is_cut(part_in(word));
}

// Whether a tile shows a hatch that is cut out, and anything else lies within its reach.
fn is_cut_around(tile: vec2<u32>) -> bool {
    let start = tile * TONE_TILE;
    let end = min(start + TONE_TILE, window.size);
    let far = cut_far_px(start, end);
    if far == 0u { return false; }
    let low = max(start, vec2<u32>(far)) - far;
    let high = min(end + far, window.size);
    for (var y = low.y; y < high.y; y++) {
        for (var x = low.x; x < high.x; x++) {
            if !is_cut_tone(tone_map[y * window.size.x + x]) { return true; }
        }
    }
    return false;
}

// Whether tones within reach of a tile may change.
fn has_steps_around(tile: vec2<u32>) -> bool {
    // Find how far the parts of the tile reach.
    let start = tile * TONE_TILE;
    let end = min(start + TONE_TILE, window.size);
    let first = first_tone(start, end);
    if first == 0u { return false; }
    let far = far_px(parts[part_in(first)].tone_reach_px);
    let low = max(start, vec2<u32>(far)) - far;
    let high = min(end + far, window.size);

    // Look for a third word, or a second of one part.
    var other = 0u;
    for (var y = low.y; y < high.y; y++) {
        for (var x = low.x; x < high.x; x++) {
            let word = tone_map[y * window.size.x + x];
            if word == 0u || word == first || word == other { continue; }
            if other != 0u || word >> ALL_TONE_BITS == first >> ALL_TONE_BITS { return true; }
            other = word;
        }
    }
    return false;
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    let corner = vec2<f32>(f32(index & 1u), f32(index >> 1u)) * 4.0 - 1.0;
    return vec4<f32>(corner, 0.0, 1.0);
}

@fragment
fn fragment(@builtin(position) at: vec4<f32>) -> @location(0) u32 {
    let tile = vec2<u32>(at.xy);
    return select(0u, 1u, has_steps_around(tile) || is_cut_around(tile));
}
