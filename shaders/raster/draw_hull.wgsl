// raster.draw_hull: the backs of the hull, into the same picture as the triangles.
//
// Source  Matsuo et al. 2013; Okuya et al. 2016, figure 11 (b)
// Twin    npr_core::raster::fill_triangles
//
//# use lib/geometry
//# use lib/surface
//# use lib/window

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var<uniform> window: Window;
@group(0) @binding(2) var<storage, read> hull: array<vec4<f32>>;
@group(0) @binding(3) var<storage, read> vertices: array<Vertex>;
@group(0) @binding(4) var<storage, read> triangles: array<Triangle>;
@group(0) @binding(5) var<storage, read> parts: array<Part>;
@group(0) @binding(6) var<storage, read> texels: array<u32>;

//# use lib/texture
//# use lib/cutout
//# use lib/varying

// Clip positions of a triangle's corners, pushed out.
fn pushed_out(triangle: u32) -> array<vec4<f32>, 3> {
    let corners = triangles[triangle].corners;
    return array<vec4<f32>, 3>(hull[corners.x], hull[corners.y], hull[corners.z]);
}

// Whether the hull of a triangle of a cut-out part is transparent at a point of the picture.
fn is_hole(triangle: u32, ndc: vec2<f32>) -> bool {
    if (parts[triangles[triangle].part].flags & PART_CUTOUT) == 0u { return false; }
    return is_hole_at(triangle, weights_at(pushed_out(triangle), ndc));
}

// Three vertices per triangle; fronts and parts without a hull collapse to a point.
@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Varying {
    let triangle = index / 3u;
    let clip = pushed_out(triangle);
    let turned = array<vec4<f32>, 3>(clip[0], clip[2], clip[1]);
    let drawn = (parts[triangles[triangle].part].flags & (PART_HULL | PART_BEAM)) == PART_HULL;
    return passed_on(triangle, clip[index % 3u], drawn && faces_eye(turned));
}

@fragment
fn fragment(passed: Varying) -> @location(0) u32 {
    let frame_px = frame_at(window, vec2<u32>(passed.position.xy));
    if is_hole(passed.triangle, ndc_at(view, frame_px)) { discard; }
    return (passed.triangle + 1u) | HULL_BIT;
}
