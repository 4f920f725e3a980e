// Values that passes which draw triangle numbers hand from vertices to pixels.

struct Varying {
    @builtin(position) position: vec4<f32>,
    @location(0) @interpolate(flat, either) triangle: u32,
}

// A vertex of a triangle to draw, or one of three in the same place if it is not drawn.
fn passed_on(triangle: u32, clip: vec4<f32>, drawn: bool) -> Varying {
    var passed: Varying;
    passed.triangle = triangle;
    passed.position = vec4<f32>(0.0);
    if drawn { passed.position = clip_here(window, clip); }
    return passed;
}
