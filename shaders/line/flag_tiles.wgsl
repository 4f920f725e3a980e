// line.flag_tiles: which tiles of the mask hold a stamp.
//
// Most hold none, and the pass that inks stamps skips them whole.
//
// Twin    npr_vector::screen::residual::flag_tiles
//
//# use lib/grid
//# use lib/window
//# use lib/stamp

override WG: u32 = 64u;

@group(0) @binding(0) var<uniform> mask_window: Window;
@group(0) @binding(1) var<storage, read> stamps: array<Stamp>;
@group(0) @binding(2) var<storage, read_write> tiles: array<u32>;

// One invocation per tile.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&tiles) { return; }

    let across = (mask_window.size.x + TILE - 1u) / TILE;
    let first = pixel_of(element, vec2<u32>(across, 1u)) * TILE;
    let last = min(first + TILE, mask_window.size);
    var found = 0u;
    for (var y = first.y; y < last.y; y++) {
        for (var x = first.x; x < last.x; x++) {
            if stamps[y * mask_window.size.x + x].half_width > 0.0 { found = 1u; }
        }
    }
    tiles[element] = found;
}
