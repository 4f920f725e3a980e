// line.stamp_residual: inks the output around every stamp.
//
// Gathered per output pixel, so that no order of writing matters: the stamp that
// covers a pixel most wins, and of equal ones the first.
//
// Twin    npr_vector::screen::residual::stamp
//
//# use lib/grid
//# use lib/geometry
//# use lib/window
//# use lib/outline
//# use lib/ribbon
//# use lib/color
//# use lib/stamp

override WG: u32 = 64u;

@group(0) @binding(0) var<uniform> window: Window;
@group(0) @binding(1) var<uniform> mask_window: Window;
@group(0) @binding(2) var<uniform> outline: Outline;
@group(0) @binding(3) var<storage, read> parts: array<Part>;
@group(0) @binding(4) var<storage, read> stamps: array<Stamp>;
@group(0) @binding(5) var<storage, read> tiles: array<u32>;
@group(0) @binding(6) var<storage, read> tints: array<LineTint>;
@group(0) @binding(7) var<storage, read_write> stamped: array<u32>;

//# use lib/tints

// Whether any tile that meets the box of mask pixels holds a stamp.
fn any_stamp(low: vec2<u32>, high: vec2<u32>) -> bool {
    let across = (mask_window.size.x + TILE - 1u) / TILE;
    var y = low.y / TILE;
    loop {
        var x = low.x / TILE;
        loop {
            if tiles[y * across + x] != 0u { return true; }
            continuing {
                x += 1u;
                break if x > high.x / TILE;
            }
        }
        continuing {
            y += 1u;
            break if y > high.y / TILE;
        }
    }
    return false;
}

// One invocation per output pixel.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&stamped) { return; }

    let px = frame_at(window, pixel_of(element, window.size));
    // Smoothing moves stamps from their pixels.
    let reach = f32(outline.reach_px) + f32(1u + SMOOTHING_REACH) * mask_window.frame_step;
    let low = pixel_at(mask_window, px - reach);
    let high = pixel_at(mask_window, px + reach);
    var best = 0.0;
    var part = NONE;
    var center = vec2<f32>(0.0);
    if any_stamp(low, high) {
        var y = low.y;
        loop {
            var x = low.x;
            loop {
                let stamp = stamps[y * mask_window.size.x + x];
                if !(stamp.half_width > 0.0) { continue; }
                let off = px - stamp.center;
                let coverage = line_coverage(sqrt(off.x * off.x + off.y * off.y), stamp.half_width);
                if coverage > best {
                    best = coverage;
                    part = stamp.part;
                    center = stamp.center;
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
    }
    var packed = 0u;
    if part != NONE {
        let color = line_color_at(part, KIND_INTERSECTION, center);
        packed = pack_rgba8(vec4<f32>(color.rgb, color.a * best));
    }
    stamped[element] = packed;
}
