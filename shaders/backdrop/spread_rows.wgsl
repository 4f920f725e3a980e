// backdrop.spread_rows: for every pixel the column of the nearest rim in its row, counted from 1.
//
// Together with backdrop.spread_rims this finds the nearest rim of all, in two short walks.
//
// Twin    npr_style::backdrop::spread_rows
//
//# use lib/grid
//# use lib/window

@group(0) @binding(0) var<uniform> window: Window;
@group(0) @binding(1) var<uniform> rules: Rules;
@group(0) @binding(2) var<storage, read> rims: array<Rim>;
@group(0) @binding(3) var<storage, read_write> columns: array<u32>;

//# use lib/backdrop

fn nearest_column(row: u32, x: u32) -> u32 {
    let start = row * window.size.x;
    for (var off = 0u; off <= rules.reach_px; off++) {
        if x >= off && rims[start + x - off].subject != 0u { return x - off + 1u; }
        if x + off < window.size.x && rims[start + x + off].subject != 0u { return x + off + 1u; }
    }
    return 0u;
}

// One invocation per output pixel.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&columns) { return; }
    let pixel = pixel_of(element, window.size);
    columns[element] = nearest_column(pixel.y, pixel.x);
}
