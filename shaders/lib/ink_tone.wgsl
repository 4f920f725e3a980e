// Tones and their ink. Twin: npr_style::inking. The shader declares `lights` and `parts`.

//# use lib/tone_range
//# use lib/ink_step

// Least luminance of the shade ramp on a surface with hatch but no ink, above half the threshold.
const OPEN_PAPER: f32 = 0.08;

fn shade_level(x: f32, dark_at: f32, light_at: f32) -> f32 {
    if light_at <= dark_at { return select(1.0, 0.0, x < light_at); }
    return clamp((x - dark_at) / (light_at - dark_at), 0.0, 1.0);
}

// F = S + 2 (L - 0.5) [Suzuki 2004, eq. 3.3].
fn tone_value(s: f32, l: f32) -> f32 {
    return s + 2.0 * (l - 0.5);
}

fn level_of(part: u32, x: f32) -> f32 {
    let l = shade_level(x, parts[part].dark_at, parts[part].light_at);
    if (parts[part].flags & PART_INK) == 0u { return max(l, parts[part].threshold * 0.5 + OPEN_PAPER); }
    return l;
}

// Ink of a surface whose ramp coordinates all lie in `range`: 1 or 0 if it is the same all over, else -1.
fn ink_over(part: u32, range: vec2<f32>) -> f32 {
    if (parts[part].flags & (PART_INK | PART_HATCH)) == 0u { return 0.0; }
    let hatched = (parts[part].flags & PART_HATCH) != 0u;
    let lightest = select(NO_HATCH, 0.0, hatched);
    let darkest = select(NO_HATCH, 1.0, hatched);
    // Paint is looked up at each place, but it only darkens.
    let painted = (parts[part].flags & PART_PAINTED) != 0u;
    if !painted && tone_value(lightest, level_of(part, range.x)) > parts[part].threshold { return 0.0; }
    // The grain of the paper leaves white in a hatch however dark it is, and so does a face.
    let grained = hatched && parts[part].hatch_grain > 0.0;
    let spared = (parts[part].flags & PART_SPARED) != 0u;
    if !grained && !spared && tone_value(darkest, level_of(part, range.y)) < parts[part].threshold { return 1.0; }
    return -1.0;
}

// Ink of a triangle where it is the same all over, inside the shadow of the lights in `dark` or outside of it; else -1.
fn even_ink(part: u32, corners: Corners, dark: u32) -> f32 {
    if (parts[part].flags & (PART_INK | PART_HATCH)) == 0u { return 0.0; }
    if !only_distant() { return -1.0; }
    let most = select(1.0, lights.shadow_at, dark != 0u);
    let range = range_towards(corners, lights.sources[0].direction);
    return ink_over(part, min(range, vec2<f32>(most)));
}

// A lit surface with the share `share` of ink over it, 0..1.
fn inked(part: u32, lit: vec3<f32>, share: f32) -> vec3<f32> {
    let ink = parts[part].ink_color;
    return lit + (ink.rgb - lit) * (share * ink.a);
}
