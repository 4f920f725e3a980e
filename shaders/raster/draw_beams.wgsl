// raster.draw_beams: the number of the nearest triangle of a beam, plus one, at every pixel.
//
// Source  Suzuki 2004, section 3.5
// Twin    npr_core::raster::fill_triangles
//
//# use lib/geometry
//# use lib/surface
//# use lib/window

@group(0) @binding(0) var<uniform> window: Window;
@group(0) @binding(1) var<storage, read> posed: array<PosedVertex>;
@group(0) @binding(2) var<storage, read> triangles: array<Triangle>;
@group(0) @binding(3) var<storage, read> parts: array<Part>;

//# use lib/varying

// Three vertices per triangle; hidden sides and triangles of other parts collapse to a point.
@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Varying {
    let triangle = index / 3u;
    let corners = triangles[triangle].corners;
    let clip = array<vec4<f32>, 3>(posed[corners.x].clip, posed[corners.y].clip, posed[corners.z].clip);
    let flags = parts[triangles[triangle].part].flags;
    let shown = (flags & PART_DOUBLE_SIDED) != 0u || faces_eye(clip);
    return passed_on(triangle, clip[index % 3u], shown && (flags & PART_BEAM) != 0u);
}

@fragment
fn fragment(passed: Varying) -> @location(0) u32 {
    return passed.triangle + 1u;
}
