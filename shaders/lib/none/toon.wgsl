// Toon materials where there are none.

struct ToonPaint {
    shift: f32,
}

fn is_toon(part: u32) -> bool {
    return false;
}

fn has_toon_line(part: u32) -> bool {
    return false;
}

fn toon_paint(triangle: Triangle, corners: Corners, px: vec2<f32>, is_hull: bool) -> ToonPaint {
    return ToonPaint(0.0);
}

fn toon_light(
    part: u32,
    paint: ToonPaint,
    world: vec3<f32>,
    normal: vec3<f32>,
    dark: u32,
    open: Openness,
) -> vec3<f32> {
    return vec3<f32>(0.0);
}

fn toon_weights(corners: Corners, px: vec2<f32>, is_hull: bool) -> vec3<f32> {
    return weights_at(corners.clip, ndc_at(view, px));
}

fn is_toon_line_lit(part: u32) -> bool {
    return false;
}

fn toon_outline(part: u32, light: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(0.0);
}
