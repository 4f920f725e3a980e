// line.draw_mask: draws the mask itself in one colour, as the image filters do.
//
// Source  Saito & Takahashi 1990
// Twin    npr_style::compose::draw_mask
//
//# use lib/grid
//# use lib/window
//# use lib/color
//# use lib/compose
//# use lib/outline

override WG: u32 = 64u;

@group(0) @binding(0) var<uniform> window: Window;
@group(0) @binding(1) var<uniform> mask_window: Window;
@group(0) @binding(2) var<uniform> compose: Compose;
@group(0) @binding(3) var<storage, read> mask: array<u32>;
@group(0) @binding(4) var<storage, read_write> overlay: array<u32>;

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
    let found = (mask[at.y * mask_window.size.x + at.x] & MASK_KINDS) != 0u;
    overlay[element] = select(0u, pack_rgba8(compose.line_color), found);
}
