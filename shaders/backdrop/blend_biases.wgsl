// backdrop.blend_biases: keeps the biases for the next frame, and blends them along the outline for this one.
//
// Where a stretch that turns brighter meets one that turns darker, the line passes slowly from one to the other. Bounds
// stay as they are; tiles of other subjects do not count, those before other walls or of another paint count less.
//
// Twin    npr_style::backdrop::blend_biases
//
//# use lib/grid
//# use lib/window

@group(0) @binding(0) var<uniform> window: Window;
@group(0) @binding(1) var<uniform> rules: Rules;
@group(0) @binding(2) var<storage, read> biases: array<ContrastBias>;
@group(0) @binding(3) var<storage, read_write> kept: array<ContrastBias>;
@group(0) @binding(4) var<storage, read_write> blended: array<ContrastBias>;

//# use lib/backdrop
//# use lib/stretch

// Tiles in each direction over which decisions are blended.
const BLEND_TILES: u32 = 6u;
// Difference of a channel from which rims count as two paints, not as one with a texture.
const UNLIKE_RIMS: f32 = 0.5;

fn blended_at(x: u32, y: u32, across: u32) -> ContrastBias {
    let here = biases[y * across + x];
    if here.whose == 0u || rules.bias_px <= 0.0 { return here; }
    let low = first_around(x, y, BLEND_TILES);
    let high = last_around(x, y, BLEND_TILES, across, arrayLength(&biases));
    let falloff = -2.0 / f32(BLEND_TILES * BLEND_TILES);
    var bias = 0.0;
    var rim = vec3<f32>(0.0);
    var total = 0.0;
    var coloring = 0.0;
    for (var row = low.y; row <= high.y; row++) {
        for (var column = low.x; column <= high.x; column++) {
            let there = biases[row * across + column];
            if there.whose != here.whose { continue; }
            let off = vec2<f32>(f32(column) - f32(x), f32(row) - f32(y));
            let near = exp((off.x * off.x + off.y * off.y) * falloff);
            let wall = 0.5 * ((there.low + there.high) - (here.low + here.high));
            let off_rim = abs(rim_of(here) - rim_of(there));
            let most = max(max(off_rim.r, off_rim.g), off_rim.b);
            let paint = near * max(1.0 - most / UNLIKE_RIMS, 0.0);
            let weight = paint * max(1.0 - abs(wall) / UNLIKE_WALLS, 0.0);
            bias += there.bias * weight;
            total += weight;
            rim += rim_of(there) * paint;
            coloring += paint;
        }
    }
    rim /= coloring;
    var mean = here;
    mean.bias = bias / total;
    mean.rim = array<f32, 3>(rim.r, rim.g, rim.b);
    return mean;
}

// One invocation per tile.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&blended) { return; }
    let across = tiles_across(window.size);
    kept[element] = biases[element];
    blended[element] = blended_at(element % across, element / across, across);
}
