// Highlights with a shape of their own. Twin: npr_style::gloss. The shader declares `parts`.

// How far a corner is pulled in so that the highlight reaches there as far as a square does.
const SQUARE_PULL: f32 = 0.2928932;

fn sign_or_1(x: f32) -> f32 {
    return select(1.0, -1.0, x < 0.0);
}

// Whether a part's highlight has a shape of its own; turned axes alone do nothing.
fn has_shape(part: u32) -> bool {
    return any(parts[part].highlight_shape != vec4<f32>(0.0)) || any(parts[part].highlight_turn.zw != vec2<f32>(0.0));
}

// The half vector moved so that the highlight takes a shape [Anjyo and Hiramitsu 2003].
fn shaped_half(half: vec3<f32>, normal: vec3<f32>, right: vec3<f32>, part: u32) -> vec3<f32> {
    let shape = parts[part].highlight_shape;
    let turn = parts[part].highlight_turn;
    if !has_shape(part) { return half; }
    let flat_right = unit_or_z(right - normal * dot(right, normal));
    let side = cross(normal, flat_right);
    let u = flat_right * turn.x + side * turn.y;
    let v = side * turn.x - flat_right * turn.y;
    let moved = unit_or_z(half - u * shape.x - v * shape.y);
    let stretched = unit_or_z(moved - u * (shape.z * dot(moved, u)));
    let split = unit_or_z(stretched
        - u * (turn.z * sign_or_1(dot(stretched, u)))
        - v * (turn.w * sign_or_1(dot(stretched, v))));
    if shape.w == 0.0 { return split; }
    let along = dot(split, u);
    let across = dot(split, v);
    let size = max(sqrt(along * along + across * across), 1e-6);
    let corner = 2.0 * along * across / (size * size);
    let pull = shape.w * SQUARE_PULL * corner * corner * corner * corner;
    return unit_or_z(split - u * (pull * along) - v * (pull * across));
}
