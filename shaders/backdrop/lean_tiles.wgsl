// backdrop.lean_tiles: decides which way the lines of every tile move, by the votes around it.
//
// Tiles of other subjects do not count, those before other walls less. A stretch that could go
// either way stays as it was in the frame before, and lines that must change fade.
//
// Twin    npr_style::backdrop::lean_tiles
//
//# use lib/grid
//# use lib/window

override WG: u32 = 64u;

@group(0) @binding(0) var<uniform> window: Window;
@group(0) @binding(1) var<uniform> rules: Rules;
@group(0) @binding(2) var<storage, read> tile_rims: array<TileRims>;
@group(0) @binding(3) var<storage, read> bounds: array<Lean>;
@group(0) @binding(4) var<storage, read> before: array<Lean>;
@group(0) @binding(5) var<storage, read_write> leans: array<Lean>;

//# use lib/backdrop
//# use lib/stretch

// Most tiles in each direction whose votes a tile counts.
const LEAN_MOST: u32 = 24u;
// Mean of votes from which a stretch is decided.
const DECIDED: f32 = 0.01;

// How much of the scale bounds may change in the time in which a line fades from darker to brighter.
const FADE_BOUNDS: f32 = 0.4;

// Whether two leans are of the same lines before the same wall.
fn is_same(lean: Lean, here: Lean) -> bool {
    let off = (lean.low + lean.high) - (here.low + here.high);
    return lean.whose == here.whose && abs(off) < 2.0 * UNLIKE_WALLS;
}

// What was decided before for the same lines before the same wall: in the tile itself, or else the mean of those that
// touch it. Of nobody where there was none.
fn held(here: Lean, x: u32, y: u32, across: u32) -> Lean {
    let own = before[y * across + x];
    if is_same(own, here) { return own; }
    let low = first_around(x, y, 1u);
    let high = last_around(x, y, 1u, across, arrayLength(&before));
    var sum: Lean;
    var count = 0.0;
    for (var row = low.y; row <= high.y; row++) {
        for (var column = low.x; column <= high.x; column++) {
            let lean = before[row * across + column];
            if !is_same(lean, here) { continue; }
            sum = add_lean(sum, lean, 1.0);
            count += 1.0;
        }
    }
    return mean_lean(sum, count, here.whose);
}

// A value moved towards another by no more than a step.
fn nearer(start: f32, end: f32, step: f32) -> f32 {
    return start + clamp(end - start, -step, step);
}

fn lean_at(x: u32, y: u32, across: u32) -> Lean {
    let here = tile_rims[y * across + x];
    var decided: Lean;
    if here.whose == 0u { return decided; }
    let tiles = rules.lean_px / f32(BORDER_TILE);
    let reach = min(u32(ceil(max(tiles, 0.0))), LEAN_MOST);
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
            sum += bounds[row * across + column].lean * weight;
            count += weight;
        }
    }
    decided = bounds[y * across + x];
    let was = held(decided, x, y, across);
    let vote = sum / max(count, 1e-6) + rules.hold * was.lean;
    decided.lean = clamp(vote / DECIDED, -1.0, 1.0);
    if was.whose != 0u && rules.fade < 1.0 {
        decided.low = nearer(was.low, decided.low, FADE_BOUNDS * rules.fade);
        decided.high = nearer(was.high, decided.high, FADE_BOUNDS * rules.fade);
        decided.lean = nearer(was.lean, decided.lean, 2.0 * rules.fade);
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
    if element >= arrayLength(&leans) { return; }
    let across = tiles_across(window.size);
    leans[element] = lean_at(element % across, element / across, across);
}
