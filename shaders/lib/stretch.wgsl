// Decisions for stretches of outline. Twin: npr_style::backdrop::stretch.

// The grounds that the lines of a tile must read before, and their direction: -1 darker, 1 brighter.
struct ContrastBias {
    low: f32,
    high: f32,
    bias: f32,
    whose: u32,
    // Colour of the rims, sRGB-encoded.
    rim: array<f32, 3>,
    unused: u32,
}

// The rims of one subject in a tile: where their lines start, and what lies behind.
struct TileRims {
    line: f32,
    behind: f32,
    low: f32,
    high: f32,
    count: f32,
    whose: u32,
    rule: u32,
    rim: u32,
}

fn rim_of(bias: ContrastBias) -> vec3<f32> {
    return vec3<f32>(bias.rim[0], bias.rim[1], bias.rim[2]);
}

// Difference of two backgrounds from which they count as two walls, not as one with a pattern.
const UNLIKE_WALLS: f32 = 0.42;

// Adds a weighted bias to a sum.
fn add_bias(sum: ContrastBias, bias: ContrastBias, weight: f32) -> ContrastBias {
    var more = sum;
    more.low += bias.low * weight;
    more.high += bias.high * weight;
    more.bias += bias.bias * weight;
    for (var i = 0u; i < 3u; i++) { more.rim[i] += bias.rim[i] * weight; }
    return more;
}

// The mean of such a sum; `whose` is 0 if nothing was added.
fn mean_bias(sum: ContrastBias, weight: f32, whose: u32) -> ContrastBias {
    var mean: ContrastBias;
    if weight <= 0.0 { return mean; }
    mean.low = sum.low / weight;
    mean.high = sum.high / weight;
    mean.bias = sum.bias / weight;
    for (var i = 0u; i < 3u; i++) { mean.rim[i] = sum.rim[i] / weight; }
    mean.whose = whose;
    return mean;
}

fn tiles_across(size: vec2<u32>) -> u32 {
    return (size.x + BORDER_TILE - 1u) / BORDER_TILE;
}

// The first of the tiles up to `reach` each way around one.
fn first_around(x: u32, y: u32, reach: u32) -> vec2<u32> {
    return max(vec2<u32>(x, y), vec2<u32>(reach)) - reach;
}

// The last of these tiles.
fn last_around(x: u32, y: u32, reach: u32, across: u32, tile_count: u32) -> vec2<u32> {
    return min(vec2<u32>(x, y) + reach, vec2<u32>(across, tile_count / across) - 1u);
}
