// line.smooth_stamps: moves every stamp across its line to the middle of the stamps around it.
//
// Stamps lie on the borders of pixels; averaged along the line, they no longer show the steps of the grid. They do not
// move along the line, or its ends would draw back.
//
// Twin    npr_vector::screen::residual::smooth
//
//# use lib/grid
//# use lib/window
//# use lib/outline
//# use lib/stamp

@group(0) @binding(0) var<uniform> mask_window: Window;
@group(0) @binding(1) var<storage, read> mask: array<u32>;
@group(0) @binding(2) var<storage, read> found: array<u32>;
@group(0) @binding(3) var<storage, read> stamps: array<Stamp>;
@group(0) @binding(4) var<storage, read_write> smoothed: array<Stamp>;

// The stamps around one of them: their number, and sums of their places relative to it.
struct Cloud {
    count: f32,
    sum: vec2<f32>,
    // Sums of xx, xy and yy.
    squares: vec3<f32>,
}

// The stamps of the same part around a stamp.
fn cloud_around(at: vec2<u32>, middle: Stamp) -> Cloud {
    let low = max(at, vec2<u32>(SMOOTHING_REACH)) - SMOOTHING_REACH;
    let high = min(at + SMOOTHING_REACH, mask_window.size - 1u);
    var cloud: Cloud;
    var y = low.y;
    loop {
        var x = low.x;
        loop {
            let element = y * mask_window.size.x + x;
            // Other pixels have no stamp that means anything.
            if (mask[element] & MASK_OWNER) == 0u { continue; }
            let stamp = stamps[element];
            if stamp.half_width > 0.0 && stamp.part == middle.part {
                let off = stamp.center - middle.center;
                cloud.count += 1.0;
                cloud.sum += off;
                cloud.squares += vec3<f32>(off.x * off.x, off.x * off.y, off.y * off.y);
            }
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
    return cloud;
}

// The vector to the middle of a cloud, without its part along the line that the cloud forms.
fn move_across(cloud: Cloud) -> vec2<f32> {
    let mean = cloud.sum / cloud.count;
    let squares = cloud.squares / cloud.count;
    let a = squares.x - mean.x * mean.x;
    let b = squares.y - mean.x * mean.y;
    let c = squares.z - mean.y * mean.y;
    let spread = a + c;
    if spread < 1e-6 {
        return mean;
    }
    let half_gap = 0.5 * (a - c);
    let extent = sqrt(half_gap * half_gap + b * b);
    let along_x = ((extent + half_gap) * mean.x + b * mean.y) / spread;
    let along_y = (b * mean.x + (extent - half_gap) * mean.y) / spread;
    return mean - vec2<f32>(along_x, along_y);
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
    var stamp = stamps[element];
    stamp.center += move_across(cloud_around(pixel_of(element, mask_window.size), stamp));
    smoothed[element] = stamp;
}
