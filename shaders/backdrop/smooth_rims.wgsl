// backdrop.smooth_rims: blends every rim with those of the same subject around it.
//
// Colours then change over a few pixels of outline, and do not flicker from frame to frame.
//
// Twin    npr_style::backdrop::smooth_rims
//
//# use lib/grid
//# use lib/window

@group(0) @binding(0) var<uniform> window: Window;
@group(0) @binding(1) var<uniform> rules: Rules;
@group(0) @binding(2) var<storage, read> rims: array<Rim>;
@group(0) @binding(3) var<storage, read_write> smoothed: array<Rim>;

//# use lib/backdrop

// Greatest length over which rims are blended, in pixels.
const SMOOTH_MOST: u32 = 24u;
// Difference of a channel from which two rims are not blended any more.
const UNLIKE: f32 = 0.2;

fn apart(a: u32, b: u32) -> f32 {
    let off = abs(unpack4x8unorm(a) - unpack4x8unorm(b));
    return max(max(off.r, off.g), off.b);
}

// Likeness of what lies behind two rims: 1 for the same colour, 0 if any channel differs by UNLIKE.
fn likeness(a: Rim, b: Rim) -> f32 {
    let left = max(1.0 - apart(a.behind, b.behind) / UNLIKE, 0.0);
    return left * left;
}

fn smoothed_rim(x: u32, y: u32) -> Rim {
    let here = rims[y * window.size.x + x];
    let reach = min(u32(rules.smooth_px), SMOOTH_MOST);
    let low = max(vec2<u32>(x, y), vec2<u32>(reach)) - reach;
    let high = min(vec2<u32>(x, y) + reach, window.size - 1u);
    let falloff = -2.0 / (rules.smooth_px * rules.smooth_px);
    var total = 0.0;
    var counted = 0.0;
    var front = vec3<f32>(0.0);
    var back = vec3<f32>(0.0);
    var rule = here.behind & 0xff000000u;
    for (var row = low.y; row <= high.y; row++) {
        for (var column = low.x; column <= high.x; column++) {
            let rim = rims[row * window.size.x + column];
            if (rim.subject & RIM_WHOSE) != (here.subject & RIM_WHOSE) { continue; }
            let off = vec2<f32>(f32(column) - f32(x), f32(row) - f32(y));
            let near = exp((off.x * off.x + off.y * off.y) * falloff) * likeness(here, rim);
            let own = unpack4x8unorm(rim.rim);
            let beyond = unpack4x8unorm(rim.behind);
            let weight = near * own.a;
            total += near;
            counted += weight;
            front += own.rgb * weight;
            back += beyond.rgb * weight;
            if rule == 0u { rule = rim.behind & 0xff000000u; }
        }
    }
    if counted <= 0.0 { return here; }
    var blended = here;
    blended.rim = pack_rgba8(vec4<f32>(front / counted, counted / total));
    blended.behind = pack_rgba8(vec4<f32>(back / counted, 0.0)) | rule;
    return blended;
}

// One invocation per output pixel.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&smoothed) { return; }
    let pixel = pixel_of(element, window.size);
    var rim = rims[element];
    let method = rules.rules[rim.behind >> 24u].method;
    if rim.subject != 0u && method != RULE_BY_LIKENESS && rules.smooth_px > 0.0 {
        rim = smoothed_rim(pixel.x, pixel.y);
    }
    smoothed[element] = rim;
}
