// line.stamp_residual: inks the claimed pixels of the output.
//
// Twin    npr_vector::screen::residual::stamp
//
//# use lib/grid
//# use lib/geometry
//# use lib/window
//# use lib/outline
//# use lib/color
//# use lib/stamp

@group(0) @binding(0) var<uniform> window: Window;
@group(0) @binding(1) var<uniform> mask_window: Window;
@group(0) @binding(2) var<storage, read> parts: array<Part>;
@group(0) @binding(3) var<storage, read> smoothed: array<Stamp>;
@group(0) @binding(4) var<storage, read> tints: array<LineTint>;
@group(0) @binding(5) var<storage, read> covered: array<u32>;
@group(0) @binding(6) var<storage, read_write> stamped: array<u32>;

//# use lib/tints

// One invocation per claimed pixel, which holds the element of its stamp plus 1.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let listed = element_index(wid, nwg, lid, WG);
    if listed >= min(covered[0], arrayLength(&covered) - 1u) { return; }

    let element = covered[listed + 1u];
    let stamp = smoothed[stamped[element] - 1u];
    let coverage = stamp_coverage(stamp, frame_at(window, pixel_of(element, window.size)));
    let color = line_color_at(stamp.part, KIND_INTERSECTION, stamp.center);
    stamped[element] = pack_rgba8(vec4<f32>(color.rgb, color.a * coverage));
}
