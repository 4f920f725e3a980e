// raster.draw_shadow: the number of the triangle nearest to a light, plus one, at every texel.
//
// Both sides of everything but beams throw shadows. Numbers suffice: the look-up tests the triangles themselves.
//
// Twin    npr_core::raster::fill_triangles
//
//# use lib/geometry
//# use lib/surface
//# use lib/window

@group(0) @binding(0) var<uniform> window: Window;
@group(0) @binding(1) var<storage, read> projected: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read> vertices: array<Vertex>;
@group(0) @binding(3) var<storage, read> triangles: array<Triangle>;
@group(0) @binding(4) var<storage, read> parts: array<Part>;
@group(0) @binding(5) var<storage, read> texels: array<u32>;

//# use lib/texture
//# use lib/cutout
//# use lib/varying

fn clip_of(triangle: u32) -> array<vec4<f32>, 3> {
    let corners = triangles[triangle].corners;
    return array<vec4<f32>, 3>(projected[corners.x], projected[corners.y], projected[corners.z]);
}

// Three vertices per triangle; beams collapse to a point.
@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Varying {
    let triangle = index / 3u;
    let clip = clip_of(triangle);
    let is_beam = (parts[triangles[triangle].part].flags & PART_BEAM) != 0u;
    return passed_on(triangle, clip[index % 3u], !is_beam);
}

@fragment
fn fragment(passed: Varying) -> @location(0) u32 {
    if (parts[triangles[passed.triangle].part].flags & PART_CUTOUT) != 0u {
        let weights = weights_at(clip_of(passed.triangle), ndc_of(window, vec2<u32>(passed.position.xy)));
        if is_hole_at(passed.triangle, weights) { discard; }
    }
    return passed.triangle + 1u;
}
