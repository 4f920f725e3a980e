// line.color_mask: decides the tint of lines at every pixel of the mask on or beside a line.
//
// Lines look their tint up at their reference coordinate, so a line changes colour along itself and not across.
//
// Twin    npr_style::line_color::decide
//
//# use lib/grid
//# use lib/geometry
//# use lib/surface
//# use lib/window
//# use lib/color
//# use lib/outline
//# use lib/compose

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var<uniform> window: Window;
@group(0) @binding(2) var<uniform> compose: Compose;
@group(0) @binding(3) var<uniform> lights: Lights;
@group(0) @binding(4) var ids: texture_2d<u32>;
@group(0) @binding(5) var<storage, read> posed: array<PosedVertex>;
@group(0) @binding(6) var<storage, read> vertices: array<Vertex>;
@group(0) @binding(7) var<storage, read> triangles: array<Triangle>;
@group(0) @binding(8) var<storage, read> parts: array<Part>;
@group(0) @binding(9) var<storage, read> texels: array<u32>;
@group(0) @binding(10) var<storage, read> mask: array<u32>;
@group(0) @binding(11) var<storage, read_write> tints: array<LineTint>;

//# use lib/line_place

// Width over which the surface's texture is averaged under a line, in pixels of the mask.
const LINE_BLUR_PX: f32 = 2.0;

// Whether any of the 3x3 pixels around one is set in the mask.
fn is_near_line(pixel: vec2<u32>) -> bool {
    let low = max(pixel, vec2<u32>(1u)) - 1u;
    let high = min(pixel + 1u, window.size - 1u);
    for (var y = low.y; y <= high.y; y++) {
        for (var x = low.x; x <= high.x; x++) {
            if (mask[y * window.size.x + x] & MASK_KINDS) != 0u { return true; }
        }
    }
    return false;
}

// One invocation per mask pixel.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&tints) { return; }

    var decided: LineTint;
    decided.part = NONE;
    let pixel = pixel_of(element, window.size);
    let id = textureLoad(ids, pixel, 0).x & ID_MASK;
    if id != 0u && is_near_line(pixel) {
        let triangle = triangles[id - 1u];
        if parts[triangle.part].line_flags != 0u {
            let step_px = window.frame_step * LINE_BLUR_PX;
            let tint = line_tint(triangle, corners_of(triangle), frame_at(window, pixel), step_px, false);
            decided.own = pack_rgba8(tint.own);
            decided.tint_layer = pack_rgba8(tint.tint_layer);
            decided.part = triangle.part;
        }
    }
    tints[element] = decided;
}
