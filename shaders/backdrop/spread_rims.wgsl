// backdrop.spread_rims: carries the nearest rim to every pixel, as two pictures.
//
// The first holds the rim's colour with its weight in alpha, the second the rule's number and what lies behind: a
// colour for the published method; for ours, the grounds that the stretch of outline must read before. Weights fall
// with the distance from the outline.
//
// Twin    npr_style::backdrop::spread_rims
//
//# use lib/window

@group(0) @binding(0) var<uniform> window: Window;
@group(0) @binding(1) var<uniform> rules: Rules;
@group(0) @binding(2) var<storage, read> rims: array<Rim>;
@group(0) @binding(3) var<storage, read> columns: array<u32>;
@group(0) @binding(4) var<storage, read> biases: array<ContrastBias>;

//# use lib/backdrop
//# use lib/stretch

struct Sides {
    @location(0) front: vec4<f32>,
    @location(1) back: vec4<f32>,
}

// The bias at a rim's pixel, blended between the four tiles around it that hold the same subject; `whose` is 0 if none
// does.
fn bias_between(whose: u32, pixel: vec2<u32>) -> ContrastBias {
    let across = tiles_across(window.size);
    let down = arrayLength(&biases) / across;
    let place = (vec2<f32>(pixel) + 0.5) / f32(BORDER_TILE) - 0.5;
    var sum: ContrastBias;
    var total = 0.0;
    for (var i = 0u; i < 4u; i++) {
        let tile = floor(place) + vec2<f32>(f32(i & 1u), f32(i >> 1u));
        if any(tile < vec2<f32>(0.0)) || tile.x >= f32(across) || tile.y >= f32(down) { continue; }
        let bias = biases[u32(tile.y) * across + u32(tile.x)];
        if bias.whose != whose { continue; }
        let near = 1.0 - abs(place - tile);
        let weight = near.x * near.y + 1e-4;
        sum = add_bias(sum, bias, weight);
        total += weight;
    }
    return mean_bias(sum, total, whose);
}

fn spread_at(x: u32, y: u32) -> Sides {
    let low = max(y, rules.reach_px) - rules.reach_px;
    let high = min(y + rules.reach_px, window.size.y - 1u);
    var nearest = rules.reach_px * rules.reach_px + 1u;
    var found = 0u;
    for (var row = low; row <= high; row++) {
        let column = columns[row * window.size.x + x];
        if column == 0u { continue; }
        let dx = max(x, column - 1u) - min(x, column - 1u);
        let dy = max(y, row) - min(y, row);
        let square = dx * dx + dy * dy;
        if square < nearest {
            nearest = square;
            found = row * window.size.x + column;
        }
    }
    var sides: Sides;
    if found == 0u { return sides; }
    let rim = rims[found - 1u];
    let color = unpack4x8unorm(rim.rim);
    let distance = sqrt(f32(nearest));
    let kept = 1.0 - smooth_step(rules.whole_px, f32(rules.reach_px), distance);
    sides.front = vec4<f32>(color.rgb, color.a * kept);
    let at = vec2<u32>((found - 1u) % window.size.x, (found - 1u) / window.size.x);
    sides.back = unpack4x8unorm(rim.behind);
    let rule = rim.behind >> 24u;
    if rules.rules[rule].method != RULE_BY_CONTRAST { return sides; }
    let bias = bias_between(rim.subject & RIM_WHOSE, at);
    if bias.whose == 0u {
        sides.back = vec4<f32>(0.0);
        return sides;
    }
    if rules.rules[rule].rim_factor > 0.0 { sides.front = vec4<f32>(rim_of(bias), sides.front.a); }
    sides.back = vec4<f32>(bias.low, bias.high, 0.5 + 0.5 * bias.bias, sides.back.a);
    return sides;
}

// A triangle over the whole picture.
@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    let at = vec2<f32>(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0);
    return vec4<f32>(at, 0.5, 1.0);
}

@fragment
fn fragment(@builtin(position) position: vec4<f32>) -> Sides {
    let pixel = vec2<u32>(position.xy);
    return spread_at(pixel.x, pixel.y);
}
