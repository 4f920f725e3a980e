// raster.draw_hull: the backs of the hull, into the same picture as the triangles.
//
// Source  Matsuo et al. 2013; Okuya et al. 2016, figure 11 (b)
// Twin    npr_core::raster::fill_triangles
//
//# use lib/geometry
//# use lib/surface
//# use lib/window

@group(0) @binding(0) var<uniform> window: Window;
@group(0) @binding(1) var<storage, read> hull: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read> triangles: array<Triangle>;
@group(0) @binding(3) var<storage, read> parts: array<Part>;

//# use lib/varying

// Three vertices per triangle; fronts and parts without a hull collapse to a point.
@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Varying {
    let triangle = index / 3u;
    let corners = triangles[triangle].corners;
    let clip = array<vec4<f32>, 3>(hull[corners.x], hull[corners.y], hull[corners.z]);
    let turned = array<vec4<f32>, 3>(clip[0], clip[2], clip[1]);
    let drawn = (parts[triangles[triangle].part].flags & (PART_HULL | PART_BEAM)) == PART_HULL;
    return passed_on(triangle, clip[index % 3u], drawn && faces_eye(turned));
}

@fragment
fn fragment(passed: Varying) -> @location(0) u32 {
    return (passed.triangle + 1u) | HULL_BIT;
}
