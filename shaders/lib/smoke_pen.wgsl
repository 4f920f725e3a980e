// The last step of smoke: its tones, and its ink and hatching. Twin: npr_style::smoke::pen.
// The shader declares `compose`, `parts`, `texels`, `window` and the pictures `smoke_*`.

//# use lib/paper

// Points in a pixel's range of tones over which the ramp is averaged.
const TONE_TAPS: u32 = 4u;
// Share of a pixel that its line must leave open so that the tone beside it is known.
const LEAST_OPEN: f32 = 0.05;

// Tone in a colour of unfinished smoke; negative if the outline covers it.
fn tone_of(color: vec4<f32>) -> f32 {
    if color.b < LEAST_OPEN { return -1.0; }
    return 0.5 * (min(color.r / color.b, 1.0) + min(color.g / color.b, 1.0));
}

// Tone of a neighbour, or `tone` if it has none.
fn tone_beside(pixel: vec2<u32>, step: vec2<i32>, tone: f32) -> f32 {
    let at = vec2<i32>(pixel) + step;
    if any(at < vec2<i32>(0)) || any(at >= vec2<i32>(window.size)) { return tone; }
    if (textureLoad(smoke_depths, at, 0).x & SMOKE_LAYER_MASK) == 0u { return tone; }
    let beside = tone_of(linear_of(textureLoad(smoke_colors, at, 0)));
    if beside < 0.0 { return tone; }
    return beside;
}

// The finished colour of a smoke pixel; the pen finishes a picture that holds tone and outline.
fn penned(pixel: vec2<u32>, frame_px: vec2<f32>, color: vec4<f32>) -> vec4<f32> {
    if (compose.flags & COMPOSE_SMOKE_PEN) == 0u { return color; }
    let pen = compose.smoke_part;
    let tone = max(tone_of(color), 0.0);
    let change = 0.5 * vec2<f32>(
        tone_beside(pixel, vec2<i32>(1, 0), tone) - tone_beside(pixel, vec2<i32>(-1, 0), tone),
        tone_beside(pixel, vec2<i32>(0, 1), tone) - tone_beside(pixel, vec2<i32>(0, -1), tone),
    );
    var light = vec3<f32>(0.0);
    for (var i = 0u; i < TONE_TAPS; i++) {
        let step = (f32(i) + 0.5) / f32(TONE_TAPS) - 0.5;
        light += ramp_light(pen, tone + length(change) * step) / f32(TONE_TAPS);
    }
    let on_sheet = ink_on_sheet(pen, frame_px - compose.smoke_anchor_px, compose.smoke_tiles, tone, change);
    let ink = on_paper(pen, on_sheet, frame_px);
    light += (parts[pen].ink_color.rgb - light) * (ink * parts[pen].ink_color.a);
    light = compose.smoke_line.rgb + (light - compose.smoke_line.rgb) * color.b;
    return vec4<f32>(light, color.a);
}
