// Lines of hulls and grazing surfaces where there are none.

fn line_light(triangle: Triangle, corners: Corners, px: vec2<f32>, step_px: vec2<f32>, is_hull: bool) -> vec3<f32> {
    return vec3<f32>(0.0);
}
