// smoke.smooth_tones: the smoothed tone of every pixel, from the grids of its layers or from all pixels in reach.
//
// Source  Hoshino 2004, section 3.3
// Twin    npr_style::smoke::blur::smooth_tones
//
//# use lib/grid
//# use lib/geometry
//# use lib/window
//# use lib/sphere
//# use lib/smoke

@group(0) @binding(0) var<uniform> window: Window;
@group(0) @binding(1) var<uniform> look: SmokeLook;
@group(0) @binding(2) var<storage, read> pixels: array<SmokePixel>;
@group(0) @binding(3) var<storage, read> cells: array<vec2<f32>>;
@group(0) @binding(4) var<storage, read_write> tones: array<f32>;

fn weight_of(i: u32) -> f32 {
    return look.kernel[i / 4u][i % 4u];
}

// The sums of the published method, over all pixels in reach.
fn window_sum(x: u32, y: u32, layer: u32) -> vec2<f32> {
    let taps = look.taps;
    let left = max(x, taps) - taps;
    let right = min(x + taps, window.size.x - 1u);
    let top = max(y, taps) - taps;
    let bottom = min(y + taps, window.size.y - 1u);
    var sum = vec2<f32>(0.0);
    for (var row = top; row <= bottom; row++) {
        for (var column = left; column <= right; column++) {
            let pixel = pixels[row * window.size.x + column];
            let weight = weight_of(max(row, y) - min(row, y))
                * weight_of(max(column, x) - min(column, x))
                * share_of(pixel.place, layer);
            sum += vec2<f32>(pixel.tone * weight, weight);
        }
    }
    return sum;
}

// Weights of four cells for a place `t` of the way from the second to the third, by the cubic B-spline.
fn spline(t: f32) -> vec4<f32> {
    let s = 1.0 - t;
    return vec4<f32>(
        s * s * s / 6.0,
        (4.0 - 6.0 * t * t + 3.0 * t * t * t) / 6.0,
        (4.0 - 6.0 * s * s + 3.0 * s * s * s) / 6.0,
        t * t * t / 6.0,
    );
}

// The sums between the sixteen cells around a pixel.
fn grid_sum(x: u32, y: u32, layer: u32) -> vec2<f32> {
    let cell = f32(1u << look.shift);
    let at = (vec2<f32>(f32(x), f32(y)) + 0.5) / cell - 0.5;
    let low = floor(at);
    let columns = spline(at.x - low.x);
    let rows = spline(at.y - low.y);
    let last = vec2<f32>(look.cells) - 1.0;
    var sum = vec2<f32>(0.0);
    for (var j = 0u; j < 4u; j++) {
        let start = row_start(look, u32(clamp(low.y + f32(j) - 1.0, 0.0, last.y)), layer);
        for (var i = 0u; i < 4u; i++) {
            let weight = rows[j] * columns[i];
            sum += cells[start + u32(clamp(low.x + f32(i) - 1.0, 0.0, last.x))] * weight;
        }
    }
    return sum;
}

// The mean tone of a layer around a pixel; `own` if nothing of the layer is near.
fn mean_of(x: u32, y: u32, layer: u32, own: f32) -> f32 {
    var sum: vec2<f32>;
    if look.shift == 0u { sum = window_sum(x, y, layer); } else { sum = grid_sum(x, y, layer); }
    if sum.y > 1e-12 { return sum.x / sum.y; }
    return own;
}

// One invocation per pixel.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&tones) { return; }
    let pixel = pixel_of(element, window.size);
    let own = pixels[element];
    var tone = 0.0;
    if own.place >= 0.0 {
        tone = own.tone;
        if look.taps != 0u || look.shift != 0u {
            let layer = u32(own.place);
            let passed = own.place - f32(layer);
            tone = mean_of(pixel.x, pixel.y, layer, own.tone);
            if passed > 0.0 { tone += (mean_of(pixel.x, pixel.y, layer + 1u, own.tone) - tone) * passed; }
        }
    }
    tones[element] = tone;
}
