// backdrop.bound_tiles: gives every tile the bounds of what lies behind its lines, and its own vote.
//
// Bounds are envelopes that fall with the distance, so a line that follows them changes slowly. Another wall, much
// darker or brighter, does not count.
//
// Twin    npr_style::backdrop::bound_tiles
//
//# use lib/grid
//# use lib/window

@group(0) @binding(0) var<uniform> window: Window;
@group(0) @binding(1) var<uniform> rules: Rules;
@group(0) @binding(2) var<storage, read> tile_rims: array<TileRims>;
@group(0) @binding(3) var<storage, read_write> bounds: array<ContrastBias>;

//# use lib/adapt
//# use lib/stretch

// Tiles in each direction that an envelope takes in.
const ENVELOPE_TILES: u32 = 4u;
// Tiles around a tile up to which its bounds hold in full.
const WHOLE_TILES: f32 = 1.0;
// How far an envelope falls from tile to tile.
const SLOPE: f32 = 0.08;
// How fast the bounds of another wall lose weight, as a multiple of how much more it differs.
const UNLIKE_SLOPE: f32 = 4.0;

fn bound_at(x: u32, y: u32, across: u32) -> ContrastBias {
    let here = tile_rims[y * across + x];
    var bound: ContrastBias;
    if here.whose == 0u { return bound; }
    bound.low = here.low;
    bound.high = here.high;
    bound.whose = here.whose;
    let rim = unpack4x8unorm(here.rim);
    bound.rim = array<f32, 3>(rim.r, rim.g, rim.b);
    let reach = select(0u, ENVELOPE_TILES, rules.bias_px > 0.0);
    let low = first_around(x, y, reach);
    let high = last_around(x, y, reach, across, arrayLength(&tile_rims));
    for (var row = low.y; row <= high.y; row++) {
        for (var column = low.x; column <= high.x; column++) {
            let there = tile_rims[row * across + column];
            if there.whose != here.whose { continue; }
            let off = vec2<f32>(f32(column) - f32(x), f32(row) - f32(y));
            let loss = max(sqrt(off.x * off.x + off.y * off.y) - WHOLE_TILES, 0.0) * SLOPE;
            let unlike = max(abs(there.behind - here.behind) - UNLIKE_WALLS, 0.0) * UNLIKE_SLOPE;
            bound.low = min(bound.low, there.low + loss + unlike);
            bound.high = max(bound.high, there.high - loss - unlike);
        }
    }
    bound.bias = preference(here.line, vec2<f32>(bound.low, bound.high), here.rule);
    return bound;
}

// One invocation per tile.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&bounds) { return; }
    let across = tiles_across(window.size);
    bounds[element] = bound_at(element % across, element / across, across);
}
