// stroke.see_samples: how far in front of each sample of a line lies what hides it, in sizes of a pixel; 0 if nothing.
//
// The triangles of the nine pixels around are tested where the spine runs: one that covers the sample decides. Where
// none does, as they are too small, it is hidden if all of them lie clearly in front.
//
// Source  Cole & Finkelstein 2010
// Twin    npr_vector::sampled::see_samples
//
//# use lib/grid
//# use lib/geometry
//# use lib/unit
//# use lib/surface
//# use lib/window
//# use lib/spine

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var<uniform> window: Window;
@group(0) @binding(2) var ids: texture_2d<u32>;
@group(0) @binding(3) var<storage, read> posed: array<PosedVertex>;
@group(0) @binding(4) var<storage, read> triangles: array<Triangle>;
@group(0) @binding(5) var<storage, read> samples: array<SpineSample>;
@group(0) @binding(6) var<storage, read_write> gaps: array<f32>;

const DEPTH_ROUNDING: f32 = 1.0 / 32768.0;
const PLACE_ROUNDING: f32 = 0.02;
const LEAST_WEIGHT: f32 = -1e-5;
const CLEARLY_PX: f32 = 0.5;
const STEEPEST: f32 = 8.0;
const LEAST_GAP: f32 = 1e-6;

// A triangle at a place of the picture.
struct Met {
    covers: bool,
    depth: f32,
    // By how much it lies in front, in plane coordinates.
    before: f32,
    // Change of its plane coordinate over a pixel of the grid.
    slope: f32,
}

fn met_by(sample: SpineSample, corners: vec3<u32>, at_px: vec2<f32>) -> Met {
    let a = posed[corners.x];
    let b = posed[corners.y];
    let c = posed[corners.z];
    let step = pixel_ndc(view) * window.frame_step;
    let weights = weights_around(array<vec4<f32>, 3>(a.clip, b.clip, c.clip), ndc_at(view, at_px), step);
    let depth = blend(weights[0], a.depth, b.depth, c.depth);
    let here = plane_coordinate(view, depth);
    let over = plane_coordinate(view, blend(weights[1], a.depth, b.depth, c.depth)) - here;
    let under = plane_coordinate(view, blend(weights[2], a.depth, b.depth, c.depth)) - here;
    let own = plane_coordinate(view, sample.depth);
    let least = min(min(weights[0].x, weights[0].y), weights[0].z);

    var met: Met;
    met.covers = least >= LEAST_WEIGHT;
    met.depth = depth;
    met.before = select(own - here, here - own, view.perspective > 0.5);
    met.slope = sqrt(over * over + under * under);
    return met;
}

// The size of a grid pixel at a depth, as a difference of plane coordinates.
fn pixel_coordinate(depth: f32) -> f32 {
    let pixel = world_per_pixel(view, depth) * window.frame_step.y;
    return select(pixel, pixel / (depth * depth), view.perspective > 0.5);
}

// Whether an id is that of a triangle, not of a hull or nothing.
fn is_triangle(id: u32) -> bool {
    return (id & HULL_BIT) == 0u && (id & ID_MASK) != 0u;
}

// The depth of what hides a sample, or FAR_DEPTH if nothing does.
fn hider_of(sample: SpineSample) -> f32 {
    if sample.half_width <= 0.0 || window.size.x * window.size.y == 0u { return FAR_DEPTH; }
    let middle = pixel_at(window, sample.spine_px);
    let low = max(middle, vec2<u32>(1u)) - vec2<u32>(1u);
    let high = min(middle + vec2<u32>(1u), window.size - vec2<u32>(1u));
    let rounding = abs(plane_coordinate(view, sample.depth)) * DEPTH_ROUNDING;

    // Of the triangles that cover the sample take the nearest in front of it.
    var is_covered = false;
    var hider = FAR_DEPTH;
    var last = 0u;
    for (var y = low.y; y <= high.y; y++) {
        for (var x = low.x; x <= high.x; x++) {
            // Neighbours mostly show the same one.
            let id = textureLoad(ids, vec2<u32>(x, y), 0).x;
            if id == last || !is_triangle(id) { continue; }
            last = id;
            let met = met_by(sample, triangles[(id & ID_MASK) - 1u].corners, sample.spine_px);
            if met.covers {
                is_covered = true;
                if met.before > rounding + PLACE_ROUNDING * met.slope { hider = min(hider, met.depth); }
            }
        }
    }
    if is_covered { return hider; }

    // Where none covers it, see whether all around lie clearly in front.
    for (var y = low.y; y <= high.y; y++) {
        for (var x = low.x; x <= high.x; x++) {
            let id = textureLoad(ids, vec2<u32>(x, y), 0).x;
            if !is_triangle(id) { return FAR_DEPTH; }
            let at_px = frame_at(window, vec2<u32>(x, y));
            let met = met_by(sample, triangles[(id & ID_MASK) - 1u].corners, at_px);
            let size = pixel_coordinate(met.depth);
            let clearly = CLEARLY_PX * max(min(met.slope, STEEPEST * size), size);
            if !(met.before > clearly) { return FAR_DEPTH; }
            hider = min(hider, met.depth);
        }
    }
    return hider;
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
    let hider = hider_of(sample);
    let pixel = max(world_per_pixel(view, max(hider, view.near)), 1e-20);
    gaps[element] = select(0.0, max((sample.depth - hider) / pixel, LEAST_GAP), hider < FAR_DEPTH);
}
