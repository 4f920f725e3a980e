// raster.draw_ids: the number of the nearest triangle, plus one, at every pixel.
//
// Nothing else is stored: later passes find the surface again from the number
// [Burns & Hunt 2013], with the same arithmetic on both engines.
//
// Source  Okuya et al. 2016, section 4.2
// Twin    npr_core::raster::fill_triangles
// Differs: the paper writes its G-buffers here, into several targets.
//
//# use lib/geometry
//# use lib/surface
//# use lib/window

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var<uniform> window: Window;
@group(0) @binding(2) var<storage, read> posed: array<PosedVertex>;
@group(0) @binding(3) var<storage, read> vertices: array<Vertex>;
@group(0) @binding(4) var<storage, read> triangles: array<Triangle>;
@group(0) @binding(5) var<storage, read> parts: array<Part>;
@group(0) @binding(6) var<storage, read> texels: array<u32>;

//# use lib/texture
//# use lib/cutout
//# use lib/varying

// Whether a triangle of a cut-out part is transparent at a point of the picture.
fn is_hole(triangle: u32, ndc: vec2<f32>) -> bool {
    if (parts[triangles[triangle].part].flags & PART_CUTOUT) == 0u { return false; }
    let corners = triangles[triangle].corners;
    let clip = array<vec4<f32>, 3>(posed[corners.x].clip, posed[corners.y].clip, posed[corners.z].clip);
    return is_hole_at(triangle, weights_at(clip, ndc));
}

// Three vertices per triangle; hidden sides and beams collapse to a point.
@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Varying {
    let triangle = index / 3u;
    let corners = triangles[triangle].corners;
    let clip = array<vec4<f32>, 3>(posed[corners.x].clip, posed[corners.y].clip, posed[corners.z].clip);
    let flags = parts[triangles[triangle].part].flags;
    let shown = (flags & PART_DOUBLE_SIDED) != 0u || faces_eye(clip);
    return passed_on(triangle, clip[index % 3u], shown && (flags & PART_BEAM) == 0u);
}

@fragment
fn fragment(passed: Varying) -> @location(0) u32 {
    let frame_px = frame_at(window, vec2<u32>(passed.position.xy));
    if is_hole(passed.triangle, ndc_at(view, frame_px)) { discard; }
    return passed.triangle + 1u;
}
