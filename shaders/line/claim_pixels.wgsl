// line.claim_pixels: claims pixels of the output for the stamps that cover them.
//
// The stamp that covers a pixel most wins, and of equal ones the first, in whatever order they come.
//
// Twin    npr_vector::screen::residual::claim
//
//# use lib/grid
//# use lib/window
//# use lib/ribbon
//# use lib/stamp

@group(0) @binding(0) var<uniform> window: Window;
@group(0) @binding(1) var<storage, read> found: array<u32>;
@group(0) @binding(2) var<storage, read> smoothed: array<Stamp>;
@group(0) @binding(3) var<storage, read_write> claims: array<atomic<u32>>;
@group(0) @binding(4) var<storage, read_write> covered: array<atomic<u32>>;

// The largest radius of a stamp's ink, in frame pixels.
const LARGEST_PX: f32 = 64.0;

// Whether the stamp of `holder`, which is an element plus 1, keeps a pixel against another of coverage `own`.
fn keeps(holder: u32, element: u32, own: f32, px: vec2<f32>) -> bool {
    if holder == 0u { return false; }
    let held = stamp_coverage(smoothed[holder - 1u], px);
    return held > own || (held == own && holder - 1u <= element);
}

// Claims the pixel around a point of the frame for the stamp of an element, and lists it when it is the first to do so.
fn claim(pixel: u32, px: vec2<f32>, element: u32, own: f32) {
    var holder = atomicLoad(&claims[pixel]);
    loop {
        if keeps(holder, element, own, px) { return; }
        let result = atomicCompareExchangeWeak(&claims[pixel], holder, element + 1u);
        if result.exchanged {
            if holder == 0u { atomicStore(&covered[atomicAdd(&covered[0], 1u) + 1u], pixel); }
            return;
        }
        holder = result.old_value;
    }
}

// One invocation per stamp.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let listed = element_index(wid, nwg, lid, WG);
    if listed >= min(found[0], arrayLength(&found) - 1u) { return; }

    let element = found[listed + 1u];
    let stamp = smoothed[element];
    let reach = vec2<f32>(min(stamp.half_width, LARGEST_PX) + 1.0);
    let low = pixel_at(window, stamp.center - reach);
    let high = pixel_at(window, stamp.center + reach);
    var y = low.y;
    loop {
        var x = low.x;
        loop {
            let px = frame_at(window, vec2<u32>(x, y));
            let own = stamp_coverage(stamp, px);
            if own > 0.0 { claim(y * window.size.x + x, px, element, own); }
            continuing {
                x += 1u;
                break if x > high.x;
            }
        }
        continuing {
            y += 1u;
            break if y > high.y;
        }
    }
}
