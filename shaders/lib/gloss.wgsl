// Highlights. Twin: npr_style::gloss.

//# use lib/shaped_gloss
//# use lib/back_light
//# use lib/streak

fn positive_power(base: f32, exponent: f32) -> f32 {
    if base <= 0.0 { return 0.0; }
    return pow(min(base, 1.0), exponent);
}

fn phong(normal: vec3<f32>, light: vec3<f32>, eye: vec3<f32>, exponent: f32) -> f32 {
    let mirrored = 2.0 * dot(normal, eye) * normal - eye;
    if dot(normal, light) <= 0.0 { return 0.0; }
    return positive_power(dot(light, mirrored), exponent);
}

fn soft_highlight(term: f32, threshold: f32, m: f32) -> f32 {
    if term <= threshold { return 0.0; }
    return clamp((term - threshold) * pow(2.5 * threshold + term, m) * 0.5, 0.0, 1.0);
}

// Exponent up to which a soft spot is so wide that one place of a pixel stands for all.
const GENTLE_EXPONENT: f32 = 100.0;

// Whether a part's highlights change so gently that one place of a pixel stands for all.
fn shines_gently(part: u32) -> bool {
    return (parts[part].flags & PART_HIGHLIGHTS) == PART_SOFT
        && parts[part].highlight.x <= GENTLE_EXPONENT
        && all(parts[part].highlight_turn.zw == vec2<f32>(0.0));
}

// Whether a part has highlights.
fn has_highlights(part: u32) -> bool {
    return (parts[part].flags & PART_HIGHLIGHTS) != 0u;
}

// Light that a part's highlights add at a place; bits of `dark` are the lights that do not reach it.
fn highlights_at(part: u32, world: vec3<f32>, normal: vec3<f32>, dark: u32) -> vec3<f32> {
    let flags = parts[part].flags;
    if (flags & PART_HIGHLIGHTS) == 0u { return vec3<f32>(0.0); }
    let eye = to_eye(view, world);
    let spot = parts[part].highlight;
    var sum = vec3<f32>(0.0);
    if (flags & (PART_CRISP | PART_SOFT)) != 0u {
        var term = 0.0;
        for (var i = 0u; i < lights.count; i++) {
            if ((dark >> i) & 1u) != 0u || lights.sources[i].kind == LIGHT_SKY { continue; }
            let reach = reach_at(lights.sources[i], world);
            let light = reach.towards;
            var here = 0.0;
            if (flags & PART_PHONG) != 0u {
                here = phong(normal, light, eye, spot.x);
            } else if dot(normal, light) > 0.0 {
                let half = shaped_half(unit_or_z(light + eye), normal, compose.right_world, part);
                here = positive_power(dot(normal, half), spot.x);
            }
            term = max(term, here * min(reach.strength, 1.0));
        }
        let crisp = select(0.0, 1.0, term > spot.y);
        let amount = select(soft_highlight(term, spot.y, spot.z), crisp, (flags & PART_CRISP) != 0u);
        sum += parts[part].highlight_color.rgb * (parts[part].highlight_color.a * amount);
    }
    sum += back_light_at(part, normal);
    sum += streak_at(part, world, normal, eye);
    return sum;
}
