// Half-edges, curve nodes and the side from which faces are seen. Twins: npr_vector::mesh_lines::graph,
// npr_vector::mesh_lines::contour.

//# use lib/geometry
//# use lib/line_kind
//# use lib/edge_flags

struct HalfEdge {
    tail: u32,
    twin: u32,
    edge: u32,
    traits: u32,
}

struct CurveNode {
    edge: u32,
    t: f32,
    next: u32,
    prev: u32,
    flags: u32,
    face: u32,
}

struct Viewer {
    position: vec4<f32>,
    scale: f32,
    zero: u32,
    unused: vec2<u32>,
}

fn following(half_edge: u32) -> u32 {
    return select(half_edge + 1u, half_edge - 2u, half_edge % 3u == 2u);
}

// The vector itself, rounded. A compiler cannot know that zero is 0, so it neither fuses the sums before and after this
// nor reorders them, and signs are those of the twin.
fn settle(viewer: Viewer, v: vec3<f32>) -> vec3<f32> {
    return bitcast<vec3<f32>>(bitcast<vec3<u32>>(v) ^ vec3<u32>(viewer.zero));
}

fn settled_cross(viewer: Viewer, a: vec3<f32>, b: vec3<f32>) -> vec3<f32> {
    return settle(viewer, a.yzx * b.zxy) - settle(viewer, a.zxy * b.yzx);
}

fn settled_dot(viewer: Viewer, a: vec3<f32>, b: vec3<f32>) -> f32 {
    let p = settle(viewer, a * b);
    let sum = settle(viewer, vec3<f32>(p.x + p.y, 0.0, 0.0)).x;
    return sum + p.z;
}

// The scale is a power of two: products with it round nothing.
fn scaled_difference(viewer: Viewer, to: vec3<f32>, from_: vec3<f32>) -> vec3<f32> {
    return settle(viewer, to - from_) * viewer.scale;
}

fn toward_eye(viewer: Viewer, at: vec3<f32>) -> vec3<f32> {
    let w = viewer.position.w;
    let d = settle(viewer, viewer.position.xyz - at * w);
    return d * select(viewer.scale, 1.0, w == 0.0);
}

// Positive if the face is turned to the eye.
fn height_over(viewer: Viewer, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>) -> f32 {
    let u = scaled_difference(viewer, b, a);
    let v = scaled_difference(viewer, c, a);
    return settled_dot(viewer, settle(viewer, settled_cross(viewer, u, v)), toward_eye(viewer, a));
}
