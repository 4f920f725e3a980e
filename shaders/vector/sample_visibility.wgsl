// vector.sample_visibility: the share of places beside each sample at which no surface lies in front of it.
//
// Source  Cole & Finkelstein 2010
// Twin    npr_vector::mesh_lines::sample::sample_visibility
//
//# use lib/grid
//# use lib/geometry
//# use lib/window
//# use lib/spine

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var<uniform> window: Window;
@group(0) @binding(2) var<storage, read> gbuffer: array<GPixel>;
@group(0) @binding(3) var<storage, read> samples: array<SpineSample>;
@group(0) @binding(4) var<storage, read_write> shares: array<f32>;

const TAP_COUNT: u32 = 4u;
// Distance from one of these places to the next, in grid pixels.
const TAP_STEP_PX: f32 = 0.75;
const SLOPE_PIXELS: f32 = 0.5;
const LARGEST_SLOPE: f32 = 2.0;
const DEPTH_ROUNDING: f32 = 1.0 / 65536.0;

// Depth of a pixel's plane at a place beside the pixel's centre.
fn depth_at(pixel: GPixel, at: vec2<u32>, at_px: vec2<f32>) -> f32 {
    let centre_px = frame_at(window, at);
    // Beyond the pixel, as outside the grid, its plane does not hold.
    let off = clamp((at_px - centre_px) / window.frame_step, vec2<f32>(-0.5), vec2<f32>(0.5));
    let change = off.x * pixel.plane_step.x + off.y * pixel.plane_step.y;
    let coordinate = plane_coordinate(view, pixel.depth) + change;
    return depth_of_coordinate(view, coordinate);
}

// Whether the surface seen at a place of the frame lies in front of the sample.
fn hides(sample: SpineSample, at_px: vec2<f32>) -> bool {
    if window.size.x * window.size.y == 0u { return false; }
    let at = pixel_at(window, at_px);
    let pixel = gbuffer[at.y * window.size.x + at.x];
    if pixel.part == NONE { return false; }
    let own = pixel.part == sample.part;
    var tolerance = sample.depth * DEPTH_ROUNDING;
    if own {
        let slope = slope_of(view, window, pixel.depth, pixel.plane_step);
        let footprint = world_per_pixel(view, pixel.depth) * window.frame_step.y;
        tolerance = max(tolerance, SLOPE_PIXELS * footprint * clamp(slope, 1.0, LARGEST_SLOPE));
    }
    return depth_at(pixel, at, at_px) < sample.depth - tolerance;
}

// One invocation per sample.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&samples) { return; }

    let sample = samples[element];
    var open = 0.0;
    for (var tap = 0u; tap < TAP_COUNT; tap++) {
        let at_px = sample.place_px + f32(tap) * TAP_STEP_PX * window.frame_step * sample.outward;
        if !hides(sample, at_px) { open += 1.0; }
    }
    shares[element] = open / f32(TAP_COUNT);
}
