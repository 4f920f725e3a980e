// Lines that follow what lies behind them. Twin: npr_style::compose::composer.
// The shader declares `compose`, `window`, `rules`, `fronts` and `backs`.

//# use lib/adapt

// The colour of a line, adapted to what lies behind it at a pixel.
fn contrasted(line: vec3<f32>, frame_px: vec2<f32>) -> vec3<f32> {
    if (compose.flags & COMPOSE_BACKDROP) == 0u { return line; }
    let pixel = pixel_at(window, frame_px);
    let front = textureLoad(fronts, pixel, 0);
    let back = textureLoad(backs, pixel, 0);
    if front.a == 0.0 { return line; }
    let rule = u32(back.a * 255.0 + 0.5);
    let rim = linear_of(front).rgb;
    var adapted: vec3<f32>;
    if rules.rules[rule].method == RULE_BY_CONTRAST {
        adapted = adapted_light(line, rim, Ground(back.r, back.g, back.b), rule);
    } else {
        adapted = published_light(line, rim, linear_of(back).rgb, rule);
    }
    return line + (adapted - line) * front.a;
}
