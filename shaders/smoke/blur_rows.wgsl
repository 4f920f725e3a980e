// smoke.blur_rows: the Gaussian along the rows of every layer's grid.
//
// Source  Hoshino 2004, section 3.3
// Twin    npr_style::smoke::blur::blur_rows
//
//# use lib/grid
//# use lib/smoke

@group(0) @binding(0) var<uniform> look: SmokeLook;
@group(0) @binding(1) var<storage, read> gathered: array<vec2<f32>>;
@group(0) @binding(2) var<storage, read_write> blurred: array<vec2<f32>>;

// One invocation per cell of a layer.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&blurred) { return; }
    if look.shift == 0u { blurred[element] = vec2<f32>(0.0); return; }
    let x = i32(element % look.cells.x);
    let start = element - u32(x);
    var sum = vec2<f32>(0.0);
    for (var i = -i32(look.taps); i <= i32(look.taps); i++) {
        let at = x + i;
        if at >= 0 && at < i32(look.cells.x) {
            let weight = look.kernel[abs(i) / 4][abs(i) % 4];
            sum += gathered[start + u32(at)] * weight;
        }
    }
    blurred[element] = sum;
}
