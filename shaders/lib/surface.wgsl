// The surface point under a pixel. Twin: npr_core::surface.

fn offset_from(clip: vec4<f32>, ndc: vec2<f32>) -> vec2<f32> {
    return vec2<f32>(clip.x - ndc.x * clip.w, clip.y - ndc.y * clip.w);
}

fn cross2(a: vec2<f32>, b: vec2<f32>) -> f32 {
    return a.x * b.y - a.y * b.x;
}

fn weights_at(clip: array<vec4<f32>, 3>, ndc: vec2<f32>) -> vec3<f32> {
    let a = offset_from(clip[0], ndc);
    let b = offset_from(clip[1], ndc);
    let c = offset_from(clip[2], ndc);
    return summing_to_1(vec3<f32>(cross2(b, c), cross2(c, a), cross2(a, b)));
}

fn summing_to_1(weights: vec3<f32>) -> vec3<f32> {
    let sum = weights.x + weights.y + weights.z;
    if sum == 0.0 { return vec3<f32>(1.0, 0.0, 0.0); }
    return weights * (1.0 / sum);
}

// Change of cross2(p, q) over a step to the right and one down, if both move by -w against the point.
fn run_of(p: vec2<f32>, p_w: f32, q: vec2<f32>, q_w: f32, step: vec2<f32>) -> vec2<f32> {
    return step * vec2<f32>(p.y * q_w - q.y * p_w, q.x * p_w - p.x * q_w);
}

// Weights at a point of the picture, a step to its right and a step below.
fn weights_around(clip: array<vec4<f32>, 3>, ndc: vec2<f32>, step: vec2<f32>) -> array<vec3<f32>, 3> {
    let a = offset_from(clip[0], ndc);
    let b = offset_from(clip[1], ndc);
    let c = offset_from(clip[2], ndc);
    let here = vec3<f32>(cross2(b, c), cross2(c, a), cross2(a, b));
    let run_a = run_of(b, clip[1].w, c, clip[2].w, step);
    let run_b = run_of(c, clip[2].w, a, clip[0].w, step);
    let run_c = run_of(a, clip[0].w, b, clip[1].w, step);
    return array<vec3<f32>, 3>(
        summing_to_1(here),
        summing_to_1(here + vec3<f32>(run_a.x, run_b.x, run_c.x)),
        summing_to_1(here + vec3<f32>(run_a.y, run_b.y, run_c.y)),
    );
}

fn faces_eye(clip: array<vec4<f32>, 3>) -> bool {
    let a = clip[0];
    let b = clip[1];
    let c = clip[2];
    let minor_a = b.y * c.w - b.w * c.y;
    let minor_b = b.w * c.x - b.x * c.w;
    let minor_c = b.x * c.y - b.y * c.x;
    return a.x * minor_a + a.y * minor_b + a.w * minor_c > 0.0;
}

fn apply_point(m: mat4x4<f32>, p: vec3<f32>) -> vec4<f32> {
    return m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3];
}

fn blend(weights: vec3<f32>, a: f32, b: f32, c: f32) -> f32 {
    return a * weights.x + b * weights.y + c * weights.z;
}

fn blend3(weights: vec3<f32>, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>) -> vec3<f32> {
    return a * weights.x + b * weights.y + c * weights.z;
}

// The unit normal of a face from its corners in the world; its sign follows their order.
fn face_normal(a: vec3<f32>, b: vec3<f32>, c: vec3<f32>) -> vec3<f32> {
    let p = unit_or_z(b - a);
    let q = unit_or_z(c - a);
    return unit_or_z(vec3<f32>(p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x));
}

fn unit_or_z(v: vec3<f32>) -> vec3<f32> {
    let square = v.x * v.x + v.y * v.y + v.z * v.z;
    if square < 1e-30 { return vec3<f32>(0.0, 0.0, 1.0); }
    let length = sqrt(square);
    return vec3<f32>(v.x / length, v.y / length, v.z / length);
}
