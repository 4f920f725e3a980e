// A second layer of strokes across the first. Twin: npr_style::inking. The shader declares what its twin's layers hold.

// Whether the second of two layers may ink a place at luminance `l` of the shade ramp.
fn second_may_ink(part: u32, l: f32) -> bool {
    let darkest = sharpen(parts[part].second_from, parts[part].hatch_gain);
    let room = 2.0 * (1.0 - parts[part].second_from) * parts[part].hatch_gain / parts[part].spacing_px;
    return tone_value(darkest, l) - room <= parts[part].threshold;
}

// Luminance of the first of two layers laid over each other, and the factor on its slope.
fn first_of_two(s: f32, start: f32) -> vec2<f32> {
    let rest = max(1.0 - start, 1e-6);
    let white = 1.0 - s;
    let thinned = 1.0 - white * white / rest;
    if thinned > s { return vec2<f32>(thinned, 2.0 * white / rest); }
    return vec2<f32>(s, 1.0);
}

// Luminance of the second layer, and the factor on its slope.
fn second_of_two(s: f32, start: f32) -> vec2<f32> {
    let rest = max(1.0 - start, 1e-6);
    let white = 1.0 - s;
    return vec2<f32>(1.0 - rest * white * white, 2.0 * rest * white);
}

// `first_of_two` or `second_of_two` for parts of two layers; others keep their luminance.
fn share_of_layer(part: u32, s: f32, is_second: bool) -> vec2<f32> {
    if (parts[part].flags & PART_TWO_LAYERS) == 0u { return vec2<f32>(s, 1.0); }
    if is_second { return second_of_two(s, parts[part].second_from); }
    return first_of_two(s, parts[part].second_from);
}

// Ink of both layers where that of the first is `ink.x`, and its luminance `ink.y`.
fn ink_of_second(part: u32, place: HatchCoord, ink: vec2<f32>, l: f32, darkens: vec2<f32>, calm: Calm) -> f32 {
    if (parts[part].flags & PART_TWO_LAYERS) == 0u { return ink.x; }
    // The first layer settles most places, or they are too light for the second.
    if ink.x == 1.0 || !second_may_ink(part, l) { return ink.x; }
    var crossed: HatchCoord;
    crossed.uv = place.uv.yx + 0.5;
    crossed.right = place.right.yx;
    crossed.down = place.down.yx;
    let second = ink_of_layer(part, crossed, true, l, darkens, calm);
    return select(second.x, ink.x, ink.y <= second.y);
}
