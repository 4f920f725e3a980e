// line.draw_mask: draws the mask itself, a texel of one colour for every pixel that is set, as the image filters do.
//
// Source  Saito & Takahashi 1990
// Twin    npr_style::draw_mask::draw_mask
//
//# use lib/grid
//# use lib/window
//# use lib/color
//# use lib/compose
//# use lib/outline
//# use lib/geometry

@group(0) @binding(0) var<uniform> window: Window;
@group(0) @binding(1) var<uniform> mask_window: Window;
@group(0) @binding(2) var<uniform> compose: Compose;
@group(0) @binding(3) var<storage, read> parts: array<Part>;
@group(0) @binding(4) var<storage, read> mask: array<u32>;
@group(0) @binding(5) var<storage, read> tints: array<LineTint>;
@group(0) @binding(6) var<storage, read_write> overlay: array<u32>;

//# use lib/tints

// The part that the line at a mask pixel belongs to: its own, or that of a pixel beside it; NONE if nothing is decided
// for a part.
fn owner_at(at: vec2<u32>) -> u32 {
    let element = at.y * mask_window.size.x + at.x;
    if (mask[element] & MASK_OWNER) != 0u { return tints[element].part; }
    let low = max(at, vec2<u32>(1u)) - 1u;
    let high = min(at + 1u, mask_window.size - 1u);
    for (var y = low.y; y <= high.y; y++) {
        for (var x = low.x; x <= high.x; x++) {
            let beside = y * mask_window.size.x + x;
            if (mask[beside] & MASK_OWNER) != 0u && tints[beside].part != NONE { return tints[beside].part; }
        }
    }
    return tints[element].part;
}

// One invocation per output pixel.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&overlay) { return; }

    let frame_px = frame_at(window, pixel_of(element, window.size));
    let at = pixel_at(mask_window, frame_px);
    let found = mask[at.y * mask_window.size.x + at.x];
    var packed = 0u;
    if (found & MASK_KINDS) != 0u {
        var color = compose.line_color;
        if !has_no_tints() {
            let part = owner_at(at);
            if part != NONE { color = line_color_at(part, kind_of_mask(found), frame_at(mask_window, at)); }
        }
        packed = pack_rgba8(color);
    }
    overlay[element] = packed;
}
