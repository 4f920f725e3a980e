// The colour of a line before a background. Twin: npr_style::backdrop::adapted_light. The shader declares `rules`.

//# use lib/backdrop

// Weight of missing contrast in a vote, as a multiple of a step in lightness.
const LACK_WORTH: f32 = 50.0;
// Vote in favour of the direction that a rule forces.
const FORCED: f32 = 0.05;
// Share of the goal after which a moved line has taken all of its hue from the rim.
const HUE_AT: f32 = 0.5;
const FIT_ROUNDS: u32 = 14u;
// How far a channel may lie outside 0..1 and still count as in gamut, as a share of a grey of that lightness.
const GAMUT_ROOM: f32 = 1e-3;
// Least red while chroma is first fitted into the gamut, as a share of blue: the tip of blue overhangs.
const BLUE_TIP: f32 = 0.015625;
// Largest factor by which chroma then grows up to the gamut's own border.
const TIP_REACH: f32 = 1.6;
const WCAG_LARGEST: f32 = 21.0;

fn cube_root(x: f32) -> f32 {
    if x <= 0.0 { return 0.0; }
    return pow(x, 1.0 / 3.0);
}

fn oklab_of_light(light: vec3<f32>) -> vec3<f32> {
    let l = cube_root(0.41222146 * light.r + 0.53633255 * light.g + 0.051445995 * light.b);
    let m = cube_root(0.2119035 * light.r + 0.6806995 * light.g + 0.10739696 * light.b);
    let s = cube_root(0.08830246 * light.r + 0.28171885 * light.g + 0.6299787 * light.b);
    return vec3<f32>(
        0.21045426 * l + 0.7936178 * m - 0.004072047 * s,
        1.9779985 * l - 2.4285922 * m + 0.4505937 * s,
        0.025904037 * l + 0.78277177 * m - 0.80867577 * s,
    );
}

fn light_of_oklab(lab: vec3<f32>) -> vec3<f32> {
    var l = lab.x + 0.39633778 * lab.y + 0.21580376 * lab.z;
    var m = lab.x - 0.105561346 * lab.y - 0.06385417 * lab.z;
    var s = lab.x - 0.08948418 * lab.y - 1.2914855 * lab.z;
    l = l * l * l;
    m = m * m * m;
    s = s * s * s;
    return vec3<f32>(
        4.0767417 * l - 3.3077116 * m + 0.23096994 * s,
        -1.268438 * l + 2.6097574 * m - 0.34131938 * s,
        -0.004196086 * l - 0.7034186 * m + 1.7076147 * s,
    );
}

fn value_of(color: vec3<f32>) -> f32 {
    return max(max(color.r, color.g), color.b);
}

fn saturation_of(color: vec3<f32>) -> f32 {
    let most = value_of(color);
    if most <= 0.0 { return 0.0; }
    return (most - min(min(color.r, color.g), color.b)) / most;
}

fn hue_of(color: vec3<f32>) -> f32 {
    let most = value_of(color);
    let span = most - min(min(color.r, color.g), color.b);
    if span <= 1e-6 { return -1.0; }
    var sixths = (color.r - color.g) / span + 4.0;
    if most == color.r {
        sixths = (color.g - color.b) / span;
    } else if most == color.g {
        sixths = (color.b - color.r) / span + 2.0;
    }
    if sixths < 0.0 { return (sixths + 6.0) / 6.0; }
    return sixths / 6.0;
}

fn hue_difference(a: vec3<f32>, b: vec3<f32>) -> f32 {
    let first = hue_of(a);
    let second = hue_of(b);
    if first < 0.0 || second < 0.0 { return 0.0; }
    let way = abs(first - second);
    return min(way, 1.0 - way);
}

fn are_alike(a: vec3<f32>, b: vec3<f32>, thresholds: vec4<f32>) -> bool {
    let step = abs(a - b);
    let differences = vec4<f32>(
        value_of(step),
        abs(value_of(a) - value_of(b)),
        abs(saturation_of(a) - saturation_of(b)),
        hue_difference(a, b),
    );
    var any = false;
    for (var i = 0u; i < 4u; i++) {
        if thresholds[i] >= 0.0 {
            any = true;
            if differences[i] > thresholds[i] { return false; }
        }
    }
    return any;
}

// The published method, on sRGB-encoded colours.
fn published_color(line: vec3<f32>, rim: vec3<f32>, behind: vec3<f32>, rule: u32) -> vec3<f32> {
    if !are_alike(rim, behind, rules.rules[rule].thresholds) { return line; }
    let direction = rules.rules[rule].direction;
    let is_brighter = direction == RULE_BRIGHTER || (direction != RULE_DARKER && value_of(behind) <= 0.5);
    let intensity = rules.rules[rule].intensity;
    let factor = select(1.0 / max(intensity, 1.0), intensity, is_brighter);
    return min(rim * factor, vec3<f32>(1.0));
}

fn encoded_color(light: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(srgb_from_linear(light.r), srgb_from_linear(light.g), srgb_from_linear(light.b));
}

fn decoded_color(color: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(linear_from_srgb(color.r), linear_from_srgb(color.g), linear_from_srgb(color.b));
}

// Place of a colour of known lightness on the scale of the rule's measure, 0 black to 1 white.
fn place_of(light: vec3<f32>, lightness: f32, rule: u32) -> f32 {
    if rules.rules[rule].measure == RULE_WCAG {
        return log(dot(LUMA, light) * 20.0 + 1.0) / log(WCAG_LARGEST);
    }
    return lightness;
}

// The same place, from a colour's linear light alone.
fn place_of_light(light: vec3<f32>, rule: u32) -> f32 {
    return place_of(light, oklab_of_light(light).x, rule);
}

fn luminance_at(place: f32) -> f32 {
    return (exp(place * log(WCAG_LARGEST)) - 1.0) / 20.0;
}

fn target_of(rule: u32) -> f32 {
    let goal = rules.rules[rule].goal;
    if rules.rules[rule].measure == RULE_WCAG {
        return log(clamp(goal, 1.0, WCAG_LARGEST)) / log(WCAG_LARGEST);
    }
    return clamp(goal, 0.0, 1.0);
}

// What lies behind a line: the darkest and the brightest ground that it must read before, and the share of the brighter
// candidate.
struct Ground {
    low: f32,
    high: f32,
    brighter: f32,
}

// The two places that a line may move to, and how much each falls short of the target.
struct Candidates {
    darker: f32,
    brighter: f32,
    lack_darker: f32,
    lack_brighter: f32,
    // How much longer the step to the darker candidate is than that to the brighter one.
    longer: f32,
}

fn candidates_of(line: f32, low: f32, high: f32, distance: f32, direction: u32) -> Candidates {
    var both: Candidates;
    both.darker = max(min(line, low - distance), 0.0);
    both.brighter = min(max(line, high + distance), 1.0);
    if direction == RULE_BRIGHTER { both.darker = min(line, low); }
    if direction == RULE_DARKER { both.brighter = max(line, high); }
    both.lack_darker = max(distance - (low - both.darker), 0.0);
    both.lack_brighter = max(distance - (both.brighter - high), 0.0);
    both.longer = (line - both.darker) - (both.brighter - line);
    return both;
}

// The place to which a line at `line` moves before a ground, both on a scale of 0 to 1.
fn moved(line: f32, ground: Ground, distance: f32, direction: u32) -> f32 {
    let both = candidates_of(line, ground.low, ground.high, distance, direction);
    return both.darker * (1.0 - ground.brighter) + both.brighter * ground.brighter;
}

// Preferred direction of a line before grounds from `grounds.x` to `grounds.y`: -1 darker to 1 brighter.
fn preference(line: f32, grounds: vec2<f32>, rule: u32) -> f32 {
    let direction = rules.rules[rule].direction;
    let both = candidates_of(line, grounds.x, grounds.y, target_of(rule), direction);
    var forced = 0.0;
    if direction == RULE_BRIGHTER { forced = -FORCED; }
    if direction == RULE_DARKER { forced = FORCED; }
    return clamp(both.longer + LACK_WORTH * (both.lack_darker - both.lack_brighter) + forced, -1.0, 1.0);
}

fn is_in_gamut(light: vec3<f32>, room: f32) -> bool {
    return all(light >= vec3<f32>(-room)) && all(light <= vec3<f32>(1.0 + room));
}

// How much of the straight way from a colour in the gamut to another one lies in the gamut.
fn share_in_gamut(from_light: vec3<f32>, to_light: vec3<f32>, room: f32) -> f32 {
    let border = clamp(to_light, vec3<f32>(-room), vec3<f32>(1.0 + room));
    var share = 1.0;
    for (var i = 0u; i < 3u; i++) {
        if border[i] != to_light[i] {
            share = min(share, (border[i] - from_light[i]) / (to_light[i] - from_light[i]));
        }
    }
    return max(share, 0.0);
}

// The colour of a given lightness with a chroma between those of line and rim, as far as sRGB has it.
fn at_lightness(lightness: f32, own: vec3<f32>, edge: vec3<f32>, share: f32) -> vec3<f32> {
    let paler = clamp((lightness + 0.1) / (edge.x + 0.1), 0.5, 2.0);
    let a = own.y * (1.0 - share) + edge.y * paler * share;
    let b = own.z * (1.0 - share) + edge.z * paler * share;
    let room = GAMUT_ROOM * lightness * lightness * lightness;
    let whole = light_of_oklab(vec3<f32>(lightness, a, b));
    if is_in_gamut(whole, room) { return clamp(whole, vec3<f32>(0.0), vec3<f32>(1.0)); }
    var fits = 0.0;
    var spills = 1.0;
    for (var i = 0u; i < FIT_ROUNDS; i++) {
        let middle = 0.5 * (fits + spills);
        let light = light_of_oklab(vec3<f32>(lightness, a * middle, b * middle));
        if is_in_gamut(light, room) && light.r >= BLUE_TIP * light.b {
            fits = middle;
        } else {
            spills = middle;
        }
    }
    let far = min(fits * TIP_REACH, 1.0);
    let inner = light_of_oklab(vec3<f32>(lightness, a * fits, b * fits));
    let outer = light_of_oklab(vec3<f32>(lightness, a * far, b * far));
    let inside = share_in_gamut(inner, outer, room);
    return clamp(inner * (1.0 - inside) + outer * inside, vec3<f32>(0.0), vec3<f32>(1.0));
}

// `at_lightness` for a place on the scale of the rule's measure: for WCAG, the lightness at which the fitted colour has
// the luminance of that place.
fn at_place(place: f32, brighter: bool, own: vec3<f32>, edge: vec3<f32>, share: f32, rule: u32) -> vec3<f32> {
    let by_luminance = rules.rules[rule].measure == RULE_WCAG;
    let luminance = luminance_at(place);
    let rounds = select(0u, FIT_ROUNDS, by_luminance);
    var low = 0.0;
    var high = 1.0;
    var light = vec3<f32>(0.0);
    var dark = vec3<f32>(0.0);
    var bright = vec3<f32>(1.0);
    for (var i = 0u; i <= rounds; i++) {
        let lightness = select(place, 0.5 * (low + high), by_luminance);
        light = at_lightness(lightness, own, edge, share);
        if dot(LUMA, light) < luminance {
            low = lightness;
            dark = light;
        } else {
            high = lightness;
            bright = light;
        }
    }
    if !by_luminance { return light; }
    return select(dark, bright, brighter);
}

// The colour that a line starts from: its own, or a share of its rim's.
fn started(line: vec3<f32>, rim: vec3<f32>, rule: u32) -> vec3<f32> {
    let factor = rules.rules[rule].rim_factor;
    if factor > 0.0 { return rim * factor; }
    return line;
}

// The colour of a line by the published method, where its surface ends before `behind`; linear light.
fn published_light(line: vec3<f32>, rim: vec3<f32>, behind: vec3<f32>, rule: u32) -> vec3<f32> {
    if rules.rules[rule].method == RULE_OFF { return line; }
    return decoded_color(published_color(encoded_color(line), encoded_color(rim), encoded_color(behind), rule));
}

// The colour of a line where its surface ends before a ground; linear light.
fn adapted_light(own_light: vec3<f32>, rim: vec3<f32>, ground: Ground, rule: u32) -> vec3<f32> {
    let line = started(own_light, rim, rule);
    let own = oklab_of_light(line);
    let distance = target_of(rule);
    let start = place_of(line, own.x, rule);
    let end = moved(start, ground, distance, rules.rules[rule].direction);
    let step = abs(end - start);
    if step == 0.0 { return line; }
    let edge = oklab_of_light(rim);
    let share = smooth_step(0.0, distance * HUE_AT, step);
    return at_place(end, end > start, own, edge, share, rule);
}
