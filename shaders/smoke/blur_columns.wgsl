// smoke.blur_columns: the Gaussian along the columns of every layer's grid.
//
// Source  Hoshino 2004, section 3.3
// Twin    npr_style::smoke::blur::blur_columns
//
//# use lib/grid
//# use lib/smoke

@group(0) @binding(0) var<uniform> look: SmokeLook;
@group(0) @binding(1) var<storage, read> blurred: array<vec2<f32>>;
@group(0) @binding(2) var<storage, read_write> cells: array<vec2<f32>>;

// One invocation per cell of a layer.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&cells) { return; }
    if look.shift == 0u { cells[element] = vec2<f32>(0.0); return; }
    let x = element % look.cells.x;
    let layer = element / look.cells.x % look.layers;
    let y = i32(element / look.cells.x / look.layers);
    var sum = vec2<f32>(0.0);
    for (var i = -i32(look.taps); i <= i32(look.taps); i++) {
        let at = y + i;
        if at >= 0 && at < i32(look.cells.y) {
            let weight = look.kernel[abs(i) / 4][abs(i) % 4];
            sum += blurred[row_start(look, u32(at), layer) + x] * weight;
        }
    }
    cells[element] = sum;
}
