// line.smooth_stamps: moves every stamp to the middle of the stamps around it.
//
// Stamps lie on the borders of pixels; averaged along the line, the steps of the grid
// no longer show.
//
// Twin    npr_vector::residual::smooth
//
//# use lib/grid
//# use lib/window
//# use lib/stamp

override WG: u32 = 64u;

@group(0) @binding(0) var<uniform> mask_window: Window;
@group(0) @binding(1) var<storage, read> stamps: array<Stamp>;
@group(0) @binding(2) var<storage, read_write> smoothed: array<Stamp>;

// Mean centre of the stamps of a part around a pixel.
fn middle_around(at: vec2<u32>, part: u32) -> vec2<f32> {
    let low = max(at, vec2<u32>(SMOOTHING_REACH)) - SMOOTHING_REACH;
    let high = min(at + SMOOTHING_REACH, mask_window.size - 1u);
    var sum = vec2<f32>(0.0);
    var count = 0.0;
    for (var y = low.y; y <= high.y; y++) {
        for (var x = low.x; x <= high.x; x++) {
            let stamp = stamps[y * mask_window.size.x + x];
            if stamp.half_width > 0.0 && stamp.part == part {
                sum += stamp.center;
                count += 1.0;
            }
        }
    }
    return sum / count;
}

// One invocation per mask pixel.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&smoothed) { return; }

    var stamp = stamps[element];
    if stamp.half_width > 0.0 {
        stamp.center = middle_around(pixel_of(element, mask_window.size), stamp.part);
    }
    smoothed[element] = stamp;
}
