// The colour of a surface without light where it is the same all over every part.

fn base_color(triangle: Triangle, corners: Corners, frame_px: vec2<f32>) -> vec3<f32> {
    return parts[triangle.part].base_color.rgb;
}
