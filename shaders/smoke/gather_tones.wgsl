// smoke.gather_tones: sums every layer's tones in the cells of its grid, as fractions of a whole cell.
//
// Grids lie row by row, in each row layer by layer.
//
// Twin    npr_style::smoke::blur::gather_tones
//
//# use lib/grid
//# use lib/geometry
//# use lib/window
//# use lib/sphere
//# use lib/smoke

@group(0) @binding(0) var<uniform> window: Window;
@group(0) @binding(1) var<uniform> look: SmokeLook;
@group(0) @binding(2) var<storage, read> pixels: array<SmokePixel>;
@group(0) @binding(3) var<storage, read_write> gathered: array<vec2<f32>>;

// One invocation per cell of a layer.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&gathered) { return; }
    if look.shift == 0u { gathered[element] = vec2<f32>(0.0); return; }
    let part = 1.0 / f32((1u << look.shift) * (1u << look.shift));
    let layer = element / look.cells.x % look.layers;
    let top = (element / look.cells.x / look.layers) << look.shift;
    let left = (element % look.cells.x) << look.shift;
    let bottom = min(top + (1u << look.shift), window.size.y);
    let right = min(left + (1u << look.shift), window.size.x);
    var cell = vec2<f32>(0.0);
    for (var y = top; y < bottom; y++) {
        for (var x = left; x < right; x++) {
            let pixel = pixels[y * window.size.x + x];
            let share = share_of(pixel.place, layer);
            cell += vec2<f32>(pixel.tone * share, share);
        }
    }
    gathered[element] = cell * part;
}
