// Tones of hard ramps without slivers, as the last passes show them. Twin: npr_style::even_tones.
// The shader declares `window`, `parts` and `evened`.

//# use lib/tone_word
//# use lib/ink_step

// Whether the tones of a part are evened.
fn is_evened(part: u32) -> bool {
    return parts[part].tone_reach_px > 0.0 && !is_cut(part);
}

// Evened tones of a part in and around a pixel.
struct Around {
    // The darkest and the brightest tone that a pixel has most of.
    least: u32,
    most: u32,
    // Whether one of them is changed.
    is_changed: bool,
    // Whether the pixel itself shows the part, and its steps.
    is_own: bool,
    own: u32,
    // The sum of all steps, and the number of pixels.
    sum: u32,
    count: u32,
}

fn evened_around(pixel: vec2<u32>, part: u32) -> Around {
    var around: Around;
    around.least = TONES;
    let low = max(pixel, vec2<u32>(1u)) - 1u;
    let high = min(pixel + 2u, window.size);
    for (var y = low.y; y < high.y; y++) {
        for (var x = low.x; x < high.x; x++) {
            let word = textureLoad(evened, vec2<u32>(x, y), 0).x;
            if (word & ~(2u * CHANGED - 1u)) != tag_of(part) { continue; }
            let steps = word & (CHANGED - 1u);
            around.least = min(around.least, median_of(word));
            around.most = max(around.most, median_of(word));
            around.is_changed = around.is_changed || (word & CHANGED) != 0u;
            around.sum += steps;
            around.count += 1u;
            if all(vec2<u32>(x, y) == pixel) {
                around.is_own = true;
                around.own = steps;
            }
        }
    }
    return around;
}

// Tone of a part at a pixel, where it is evened: light from its ramp, and the share of ink; below 0 if light alone does
// not decide it.
struct Evened {
    is_so: bool,
    light: vec3<f32>,
    ink: f32,
}

fn evened_tone(part: u32, frame_px: vec2<f32>) -> Evened {
    // Take the tone that all around have, or the edge that was blended.
    var tone: Evened;
    tone.ink = -1.0;
    if !is_evened(part) { return tone; }
    let around = evened_around(pixel_at(window, frame_px), part);
    var steps = around.sum / max(around.count, 1u);
    if around.is_own { steps = around.own; }
    if around.least == around.most { steps = around.least * STEP_PARTS; }
    tone.is_so = around.least == around.most || around.is_changed;
    if !tone.is_so { return tone; }

    // Take the step at the end of the ink out of them.
    let end = ink_step(part);
    let passed = f32(steps) / f32(STEP_PARTS);
    var bare = 0.0;
    if end < NO_STEP {
        bare = clamp(passed - f32(ramp_steps(part, end)), 0.0, 1.0);
        tone.ink = 1.0 - bare;
    }

    // Blend the tones before and behind the step.
    let whole = min(u32(passed - bare), TONES - 2u);
    let share = passed - bare - f32(whole);
    let before = parts[part].ramp[whole].rgb;
    tone.light = before + (parts[part].ramp[whole + 1u].rgb - before) * share;
    return tone;
}
