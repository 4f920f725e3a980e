// Straight streaks that no light moves. Twin: npr_style::gloss. The shader declares `compose` and `parts`.

fn streak(across: f32, width: f32) -> f32 {
    let first = abs(across) < 0.5 * width;
    let second = abs(across - width * 1.0) < width / 6.0;
    return select(0.0, 1.0, first || second);
}

// Light that a streak adds at a place that is seen along `eye`.
fn streak_at(part: u32, world: vec3<f32>, normal: vec3<f32>, eye: vec3<f32>) -> vec3<f32> {
    if (parts[part].flags & PART_STREAK) == 0u || abs(dot(normal, eye)) <= parts[part].back.w { return vec3<f32>(0.0); }
    let aside = in_world(compose, vec3<f32>(parts[part].streak_across, 0.0)) / compose.radius;
    let across = dot(world - compose.center_world, aside);
    let color = parts[part].highlight_color;
    return color.rgb * (color.a * streak(across - parts[part].highlight.w, parts[part].back.z));
}
