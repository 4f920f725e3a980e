// Light from behind on rims. Twin: npr_style::gloss. The shader declares `compose` and `parts`.

// Light that a place facing along `normal` shows at its rim.
fn back_light_at(part: u32, normal: vec3<f32>) -> vec3<f32> {
    if (parts[part].flags & PART_BACK_LIGHT) == 0u { return vec3<f32>(0.0); }
    let color = parts[part].back_color;
    let behind = in_world(compose, parts[part].back_direction);
    let rim = smooth_step(parts[part].back.x, parts[part].back.y, ramp_coordinate(dot(normal, behind)));
    return color.rgb * (color.a * rim);
}
