// The line that a hull or a grazing surface shows. Twin: npr_style::compose::layers.
// The shader declares what lib/line_place asks for.

//# use lib/line_place

// Linear light of the line that a hull or a grazing surface shows at a point of the frame.
fn line_light(triangle: Triangle, corners: Corners, px: vec2<f32>, step_px: vec2<f32>, is_hull: bool) -> vec3<f32> {
    var tint: Tint;
    if (parts[triangle.part].line_flags & LINE_PLACED) != 0u {
        tint = line_tint(triangle, corners, px, step_px, is_hull);
    }
    return linear_texel(pack_rgba8(line_color(triangle.part, KIND_CONTOUR, tint))).rgb;
}
