// shade.find_depths: the reversed depth of what every pixel of a picture shows, 0 where it shows nothing.
//
// A surface or smoke is as deep as the nearest of its samples. Light of beams has the depth of a beam where nothing
// solid lies behind it. Ink beside a surface belongs to the nearest one within reach of a line, and lies a little
// before it.
//
// Source  Okuya et al. 2016, section 4.4, for lines that reach beyond their surface
// Twin    npr_style::picture_depth::find_depths
//
//# use lib/grid
//# use lib/window
//# use lib/compose
//# use lib/outline

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var<uniform> window: Window;
@group(0) @binding(2) var<uniform> compose: Compose;
@group(0) @binding(3) var<uniform> outline: Outline;
@group(0) @binding(4) var depth: texture_depth_2d;
@group(0) @binding(5) var beam_depth: texture_depth_2d;
@group(0) @binding(6) var smoke_depths: texture_2d<u32>;
@group(0) @binding(7) var<storage, read> frame: array<u32>;
@group(0) @binding(8) var<storage, read_write> picture_depths: array<f32>;

//# use lib/smoke_depth

// How much nearer to the eye than its surface ink beside it lies, in pixels for every pixel between them.
const INK_ROOM: f32 = 4.0;

// The depths of the samples of a pixel.
fn depths_at(depths: texture_depth_2d, pixel: vec2<u32>) -> vec4<f32> {
    let at = pixel * compose.samples;
    let first = textureLoad(depths, at, 0);
    if compose.samples == 1u { return vec4<f32>(first); }
    return vec4<f32>(
        first,
        textureLoad(depths, at + vec2<u32>(1u, 0u), 0),
        textureLoad(depths, at + vec2<u32>(0u, 1u), 0),
        textureLoad(depths, at + vec2<u32>(1u, 1u), 0),
    );
}

fn nearest_of(depths: vec4<f32>) -> f32 {
    return max(max(depths.x, depths.y), max(depths.z, depths.w));
}

// Depth of ink that lies some pixels beside a surface.
fn inked(reversed: f32, pixels: f32) -> f32 {
    return brought_nearer(view, reversed, INK_ROOM * pixels * world_per_pixel(view, 1.0));
}

// Depth of the nearest surface in the samples of a pixel; at the edge of a surface there is room for ink.
fn surface_depth(pixel: vec2<u32>) -> f32 {
    let depths = depths_at(depth, pixel);
    let nearest = nearest_of(depths);
    if nearest == 0.0 || all(depths > vec4<f32>(0.0)) { return nearest; }
    return inked(nearest, 1.0);
}

// Depth of the nearest beam in the samples of a pixel.
fn beam_depth_at(pixel: vec2<u32>) -> f32 {
    if (compose.flags & COMPOSE_BEAMS) == 0u { return 0.0; }
    return nearest_of(depths_at(beam_depth, pixel));
}

// Depth of the nearest surface in the first square ring of pixels around one that shows any.
fn depth_around(pixel: vec2<u32>) -> f32 {
    let last = vec2<i32>(window.size) - 1;
    let here = vec2<i32>(pixel);
    for (var r = 1; r <= i32(outline.reach_px); r++) {
        var nearest = 0.0;
        for (var along = 0; along < 2 * r; along++) {
            let step = along - r;
            let corners = vec4<i32>(step, -r, r, step);
            nearest = max(nearest, depth_within(here + corners.xy, last));
            nearest = max(nearest, depth_within(here + corners.zw, last));
            nearest = max(nearest, depth_within(here - corners.xy, last));
            nearest = max(nearest, depth_within(here - corners.zw, last));
        }
        if nearest > 0.0 { return inked(nearest, f32(r + 1)); }
    }
    return 0.0;
}

// Depth of the surface of a pixel, none beyond the picture.
fn depth_within(pixel: vec2<i32>, last: vec2<i32>) -> f32 {
    if any(pixel < vec2<i32>(0)) || any(pixel > last) { return 0.0; }
    return nearest_of(depths_at(depth, vec2<u32>(pixel)));
}

// One invocation per pixel.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&picture_depths) { return; }

    var found = 0.0;
    if (frame[element] >> 24u) != 0u {
        let pixel = pixel_of(element, window.size);
        found = max(surface_depth(pixel), smoke_depth_at(pixel));
        if found == 0.0 { found = beam_depth_at(pixel); }
        if found == 0.0 { found = depth_around(pixel); }
    }
    picture_depths[element] = found;
}
