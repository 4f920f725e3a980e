// vector.draw_surfaces: the depth of the nearest surface at every pixel.
//
// Both sides of every face hide lines.
//
// Source  Jiang et al. 2022, soft visibility test
// Twin    npr_vector::pixel_strokes::surface::draw_surfaces
//
//# use lib/pixel

@group(0) @binding(0) var<uniform> view: PixelView;
@group(0) @binding(1) var<storage, read> positions: array<f32>;

// One vertex for each of the shape; the corners of faces are indices.
@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    let at = 3u * index;
    return view.clip_from_world * vec4<f32>(positions[at], positions[at + 1u], positions[at + 2u], 1.0);
}

// Depth is all that is drawn.
@fragment
fn fragment() {}
