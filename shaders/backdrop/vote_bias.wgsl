// backdrop.vote_bias: decides which way the lines of every tile move, by the votes around it.
//
// Tiles of other subjects do not count, those before other walls count less. A stretch that could go either way stays
// as it was in the previous frame, and lines that must change fade.
//
// Twin    npr_style::backdrop::vote_bias
//
//# use lib/grid
//# use lib/window

@group(0) @binding(0) var<uniform> window: Window;
@group(0) @binding(1) var<uniform> rules: Rules;
@group(0) @binding(2) var<storage, read> tile_rims: array<TileRims>;
@group(0) @binding(3) var<storage, read> bounds: array<ContrastBias>;
@group(0) @binding(4) var<storage, read> before: array<ContrastBias>;
@group(0) @binding(5) var<storage, read_write> biases: array<ContrastBias>;

//# use lib/backdrop
//# use lib/stretch

// Most tiles in each direction whose votes a tile counts.
const BIAS_REACH_MOST: u32 = 24u;
// Magnitude of the mean vote from which a stretch is decided.
const DECIDED: f32 = 0.01;

// How far bounds may move, from 0 black to 1 white, in the time in which a line fades from darker to brighter.
const FADE_BOUNDS: f32 = 0.4;

// Whether two biases are of the same lines before the same wall.
fn is_same(bias: ContrastBias, here: ContrastBias) -> bool {
    let off = (bias.low + bias.high) - (here.low + here.high);
    return bias.whose == here.whose && abs(off) < 2.0 * UNLIKE_WALLS;
}

// The previous decision for the same lines before the same wall: that of the tile itself, or else the mean of the tiles
// that touch it; `whose` is 0 if there was none.
fn held(here: ContrastBias, x: u32, y: u32, across: u32) -> ContrastBias {
    let own = before[y * across + x];
    if is_same(own, here) { return own; }
    let low = first_around(x, y, 1u);
    let high = last_around(x, y, 1u, across, arrayLength(&before));
    var sum: ContrastBias;
    var count = 0.0;
    for (var row = low.y; row <= high.y; row++) {
        for (var column = low.x; column <= high.x; column++) {
            let bias = before[row * across + column];
            if !is_same(bias, here) { continue; }
            sum = add_bias(sum, bias, 1.0);
            count += 1.0;
        }
    }
    return mean_bias(sum, count, here.whose);
}

// A value moved towards another one by at most a step.
fn nearer(start: f32, end: f32, step: f32) -> f32 {
    return start + clamp(end - start, -step, step);
}

fn bias_at(x: u32, y: u32, across: u32) -> ContrastBias {
    let here = tile_rims[y * across + x];
    var decided: ContrastBias;
    if here.whose == 0u { return decided; }
    let tiles = rules.bias_px / f32(BORDER_TILE);
    let reach = min(u32(ceil(max(tiles, 0.0))), BIAS_REACH_MOST);
    let low = first_around(x, y, reach);
    let high = last_around(x, y, reach, across, arrayLength(&tile_rims));
    let falloff = -2.0 / max(tiles * tiles, 1.0);
    var sum = 0.0;
    var count = 0.0;
    for (var row = low.y; row <= high.y; row++) {
        for (var column = low.x; column <= high.x; column++) {
            let there = tile_rims[row * across + column];
            if there.whose != here.whose { continue; }
            let off = vec2<f32>(f32(column) - f32(x), f32(row) - f32(y));
            let near = exp((off.x * off.x + off.y * off.y) * falloff);
            let alike = 1.0 - abs(there.behind - here.behind) / (2.0 * UNLIKE_WALLS);
            let weight = near * max(alike, 0.0) * there.count;
            sum += bounds[row * across + column].bias * weight;
            count += weight;
        }
    }
    decided = bounds[y * across + x];
    let was = held(decided, x, y, across);
    let vote = sum / max(count, 1e-6) + rules.hold * was.bias;
    decided.bias = clamp(vote / DECIDED, -1.0, 1.0);
    if was.whose != 0u && rules.fade < 1.0 {
        decided.low = nearer(was.low, decided.low, FADE_BOUNDS * rules.fade);
        decided.high = nearer(was.high, decided.high, FADE_BOUNDS * rules.fade);
        decided.bias = nearer(was.bias, decided.bias, 2.0 * rules.fade);
        for (var i = 0u; i < 3u; i++) {
            decided.rim[i] = nearer(was.rim[i], decided.rim[i], FADE_BOUNDS * rules.fade);
        }
    }
    return decided;
}

// One invocation per tile.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&biases) { return; }
    let across = tiles_across(window.size);
    biases[element] = bias_at(element % across, element / across, across);
}
