// Linear blend skinning. Twin: npr_mesh::pose. The shader declares `palette: array<mat4x4<f32>>`.

// The blended matrix of an influence, column by column.
fn blended_matrix(influence: Influence) -> mat4x4<f32> {
    let w = influence.weights;
    let a = palette[influence.joints.x];
    var m = mat4x4<f32>(a[0] * w.x, a[1] * w.x, a[2] * w.x, a[3] * w.x);
    let b = palette[influence.joints.y];
    m = mat4x4<f32>(m[0] + b[0] * w.y, m[1] + b[1] * w.y, m[2] + b[2] * w.y, m[3] + b[3] * w.y);
    let c = palette[influence.joints.z];
    m = mat4x4<f32>(m[0] + c[0] * w.z, m[1] + c[1] * w.z, m[2] + c[2] * w.z, m[3] + c[3] * w.z);
    let d = palette[influence.joints.w];
    return mat4x4<f32>(m[0] + d[0] * w.w, m[1] + d[1] * w.w, m[2] + d[2] * w.w, m[3] + d[3] * w.w);
}

fn apply_direction(m: mat4x4<f32>, v: vec3<f32>) -> vec3<f32> {
    return (m[0] * v.x + m[1] * v.y + m[2] * v.z).xyz;
}

// Normals are transformed by the cofactors, which stay finite if the matrix is singular.
fn apply_normal(m: mat4x4<f32>, n: vec3<f32>) -> vec3<f32> {
    let yz = cross(m[1].xyz, m[2].xyz);
    let zx = cross(m[2].xyz, m[0].xyz);
    let xy = cross(m[0].xyz, m[1].xyz);
    let turned = yz * n.x + zx * n.y + xy * n.z;
    return unit_or_z(select(turned, -turned, dot(m[0].xyz, yz) < 0.0));
}
