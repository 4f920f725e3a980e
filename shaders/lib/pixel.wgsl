// Lines drawn into a picture pixel by pixel. Twins: npr_vector::pixel_strokes::edge, segment, fragment.

//# use lib/geometry
//# use lib/edge_flags

struct DrawnEdge {
    tail: u32,
    head: u32,
    face: u32,
    across: u32,
    beyond: u32,
    beside: u32,
    bits: u32,
}

struct PixelView {
    clip_from_world: mat4x4<f32>,
    size: vec2<u32>,
    fine: f32,
    wanted: u32,
    perspective: f32,
    depth_scale: f32,
    depth_offset: f32,
    tolerance: f32,
    least_visible: u32,
    is_convex_only: u32,
    zero: u32,
    unused: u32,
}

struct Segment {
    start: vec2<f32>,
    end: vec2<f32>,
    start_z: f32,
    end_z: f32,
    edge: u32,
    mark: u32,
}

struct Fragment {
    pixel: u32,
    z: f32,
    segment: u32,
}

// The number itself, rounded. A compiler cannot know that zero is 0, so it neither fuses the operations before and
// after this nor reorders sums.
fn rounded(view: PixelView, number: f32) -> f32 {
    return bitcast<f32>(bitcast<u32>(number) ^ view.zero);
}

// The reciprocal, with the same bits wherever division is good to four units in the last place.
fn reciprocal(view: PixelView, b: f32) -> f32 {
    let size = clamp(abs(b), 1e-30, 1e30);
    var bits = bitcast<u32>(1.0 / size) - 4u;
    for (var round = 0; round < 8; round++) {
        let next = bitcast<f32>(bits + 1u);
        if rounded(view, next * size) <= 1.0 { bits += 1u; }
    }
    let found = bitcast<f32>(bits);
    return select(found, -found, b < 0.0);
}

// View depth of a reversed depth.
fn depth_of(view: PixelView, z: f32) -> f32 {
    if view.perspective > 0.5 { return rounded(view, view.depth_scale * reciprocal(view, z)); }
    return rounded(view, rounded(view, view.depth_scale * z) + view.depth_offset);
}
