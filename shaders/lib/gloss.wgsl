// Highlights. Twin: npr_style::gloss.

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

fn streak(across: f32, width: f32) -> f32 {
    let first = abs(across) < 0.5 * width;
    let second = abs(across - width * 1.0) < width / 6.0;
    return select(0.0, 1.0, first || second);
}

// How far a corner is pulled in so that the highlight reaches there as far as a square does.
const SQUARE_PULL: f32 = 0.2928932;

fn sign_or_1(x: f32) -> f32 {
    return select(1.0, -1.0, x < 0.0);
}

// Whether a part's highlight has a shape of its own; turned axes alone do nothing.
fn has_shape(part: u32) -> bool {
    return any(parts[part].highlight_shape != vec4<f32>(0.0)) || any(parts[part].highlight_turn.zw != vec2<f32>(0.0));
}

// The half vector moved so that the highlight takes a shape [Anjyo and Hiramitsu 2003].
fn shaped_half(half: vec3<f32>, normal: vec3<f32>, right: vec3<f32>, part: u32) -> vec3<f32> {
    let shape = parts[part].highlight_shape;
    let turn = parts[part].highlight_turn;
    if !has_shape(part) { return half; }
    let flat_right = unit_or_z(right - normal * dot(right, normal));
    let side = cross(normal, flat_right);
    let u = flat_right * turn.x + side * turn.y;
    let v = side * turn.x - flat_right * turn.y;
    let moved = unit_or_z(half - u * shape.x - v * shape.y);
    let stretched = unit_or_z(moved - u * (shape.z * dot(moved, u)));
    let split = unit_or_z(stretched
        - u * (turn.z * sign_or_1(dot(stretched, u)))
        - v * (turn.w * sign_or_1(dot(stretched, v))));
    if shape.w == 0.0 { return split; }
    let along = dot(split, u);
    let across = dot(split, v);
    let size = max(sqrt(along * along + across * across), 1e-6);
    let corner = 2.0 * along * across / (size * size);
    let pull = shape.w * SQUARE_PULL * corner * corner * corner * corner;
    return unit_or_z(split - u * (pull * along) - v * (pull * across));
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
    if (flags & PART_BACK_LIGHT) != 0u {
        let color = parts[part].back_color;
        let behind = in_world(compose, parts[part].back_direction);
        let rim = smooth_step(parts[part].back.x, parts[part].back.y, ramp_coordinate(dot(normal, behind)));
        sum += color.rgb * (color.a * rim);
    }
    if (flags & PART_STREAK) != 0u && abs(dot(normal, eye)) > parts[part].back.w {
        let aside = in_world(compose, vec3<f32>(parts[part].streak_across, 0.0)) / compose.radius;
        let across = dot(world - compose.center_world, aside);
        let color = parts[part].highlight_color;
        sum += color.rgb * (color.a * streak(across - spot.w, parts[part].back.z));
    }
    return sum;
}
