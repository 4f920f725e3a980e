// Tone that is cut out, as the last pass shows it. Twin: npr_style::cut_tone.
// The shader declares `window`, `parts` and `evened`.

//# use lib/tone_word

// Share of the hatch that the knife leaves around the middle of a pixel, by a word of the evened map; 0 where the map
// knows of no tone that is cut.
fn left_by(word: u32) -> f32 {
    if word == 0u || !is_cut(part_in(word)) { return 0.0; }
    return 1.0 - f32(word & (CHANGED - 1u)) / f32(STEP_PARTS);
}

// Share of the hatch that the knife leaves at a place of the frame, 0..1.
fn hatch_left(frame_px: vec2<f32>) -> f32 {
    // Take what the pixel itself shows, unless that is paper.
    let pixel = pixel_at(window, frame_px);
    let word = textureLoad(evened, pixel, 0).x;
    var left = left_by(word);
    if left > 0.0 || (word & CHANGED) != 0u { return left; }

    // Keep the soft edge of what lies beside it.
    let low = max(pixel, vec2<u32>(1u)) - 1u;
    let high = min(pixel + 2u, window.size);
    for (var y = low.y; y < high.y; y++) {
        for (var x = low.x; x < high.x; x++) { left = max(left, left_by(textureLoad(evened, vec2<u32>(x, y), 0).x)); }
    }
    return left;
}
