// backdrop.gather_tiles: the rims of every tile and what lies behind them, summed up.
//
// Twin    npr_style::backdrop::gather_tiles
//
//# use lib/grid
//# use lib/geometry
//# use lib/surface
//# use lib/window

@group(0) @binding(0) var<uniform> window: Window;
@group(0) @binding(1) var<uniform> rules: Rules;
@group(0) @binding(2) var<storage, read> parts: array<Part>;
@group(0) @binding(3) var<storage, read> rims: array<Rim>;
@group(0) @binding(4) var<storage, read_write> tile_rims: array<TileRims>;

//# use lib/adapt
//# use lib/stretch

// Places, on the rule's scale, of the line that a rim's part is expected to have and of what lies behind it.
fn places_of(rim: Rim, rule: u32) -> vec2<f32> {
    let edge = decoded_color(unpack4x8unorm(rim.rim).rgb);
    var own = decoded_color(parts[rim.part].line_color.rgb);
    if (parts[rim.part].line_flags & LINE_SURFACE) != 0u {
        own = clamp(edge * parts[rim.part].line_factor, vec3<f32>(0.0), vec3<f32>(1.0));
    }
    let behind = decoded_color(unpack4x8unorm(rim.behind).rgb);
    return vec2<f32>(place_of_light(started(own, edge, rule), rule), place_of_light(behind, rule));
}

// The rims of a tile before grounds between two places on the scale.
fn summed(tile: vec2<u32>, within: vec2<f32>) -> TileRims {
    var sum: TileRims;
    sum.low = 1.0;
    var color = vec3<f32>(0.0);
    let low = tile * BORDER_TILE;
    let high = min(low + BORDER_TILE, window.size);
    for (var y = low.y; y < high.y; y++) {
        for (var x = low.x; x < high.x; x++) {
            let rim = rims[y * window.size.x + x];
            let rule = rim.behind >> 24u;
            let whose = rim.subject & RIM_WHOSE;
            if whose == 0u || rules.rules[rule].method != RULE_BY_CONTRAST { continue; }
            if sum.whose == 0u {
                sum.whose = whose;
                sum.rule = rule;
            }
            if sum.whose != whose || sum.rule != rule { continue; }
            let places = places_of(rim, rule);
            if places.y < within.x || places.y > within.y { continue; }
            sum.line += places.x;
            sum.behind += places.y;
            sum.low = min(sum.low, places.y);
            sum.high = max(sum.high, places.y);
            color += unpack4x8unorm(rim.rim).rgb;
            sum.count += 1.0;
        }
    }
    let count = max(sum.count, 1.0);
    sum.line /= count;
    sum.behind /= count;
    sum.rim = pack_rgba8(vec4<f32>(color / count, 0.0));
    return sum;
}

fn gathered_at(tile: vec2<u32>) -> TileRims {
    let all = summed(tile, vec2<f32>(0.0, 1.0));
    if all.high - all.low <= UNLIKE_WALLS { return all; }
    // If a tile holds two walls, keep the rims before the one that more of them lie before.
    let middle = 0.5 * (all.low + all.high);
    let dark = summed(tile, vec2<f32>(0.0, middle));
    let bright = summed(tile, vec2<f32>(middle, 1.0));
    if dark.count >= bright.count { return dark; }
    return bright;
}

// One invocation per tile.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&tile_rims) { return; }
    let across = tiles_across(window.size);
    tile_rims[element] = gathered_at(vec2<u32>(element % across, element / across));
}
