// vector.draw_nearest: the number, plus one, of the segment with the nearest visible fragment at every pixel.
//
// Each fragment is a triangle around the middle of one pixel. Of fragments at equal depth the first wins.
//
// Source  Jiang et al. 2022, hard visibility test
// Twin    npr_vector::pixel_strokes::fragment::draw_nearest
//
//# use lib/grid
//# use lib/pixel

@group(0) @binding(0) var<uniform> view: PixelView;
@group(0) @binding(1) var<storage, read> fragments: array<Fragment>;
@group(0) @binding(2) var<storage, read> shown: array<u32>;

const LEAST_Z: f32 = 1e-30;

struct Passed {
    @builtin(position) position: vec4<f32>,
    @location(0) @interpolate(flat, either) element: u32,
}

struct Seen {
    @location(0) owner: u32,
    @builtin(frag_depth) depth: f32,
}

// Three vertices per fragment; fragments that do not show collapse to a point.
@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Passed {
    var passed: Passed;
    passed.element = index / 3u;
    passed.position = vec4<f32>(0.0);
    let here = fragments[passed.element];
    if shown[passed.element] == 0u || here.pixel == NONE { return passed; }
    let corner = index % 3u;
    let reach = vec2<f32>(select(0.1, 1.3, corner == 1u), select(0.1, 1.3, corner == 2u));
    let pixel = vec2<f32>(pixel_of(here.pixel, view.size)) + reach;
    let ndc = pixel / vec2<f32>(view.size) * 2.0 - 1.0;
    passed.position = vec4<f32>(ndc.x, -ndc.y, 0.5, 1.0);
    return passed;
}

@fragment
fn fragment(passed: Passed) -> Seen {
    var seen: Seen;
    seen.owner = fragments[passed.element].segment + 1u;
    seen.depth = max(fragments[passed.element].z, LEAST_Z);
    return seen;
}
