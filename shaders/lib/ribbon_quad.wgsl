// The rectangle that a ribbon is drawn in.
//
//# use lib/window
//# use lib/ribbon

// Position of a vertex, 0 to 5, of the two triangles around a ribbon.
fn ribbon_corner(window: Window, ribbon: Ribbon, corner: u32) -> vec4<f32> {
    var along = ribbon.b - ribbon.a;
    let length = sqrt(along.x * along.x + along.y * along.y);
    along = select(vec2<f32>(1.0, 0.0), along / length, length > 1e-6);
    let at_b = corner == 1u || corner == 2u || corner == 4u;
    let at_left = corner == 2u || corner == 4u || corner == 5u;
    let reach = max(ribbon.half_a, ribbon.half_b) + 1.5;
    let end = select(ribbon.a - along * reach, ribbon.b + along * reach, at_b);
    let px = end + vec2<f32>(-along.y, along.x) * select(-reach, reach, at_left);
    let in_window = (px - window.frame_origin) / (window.frame_step * vec2<f32>(window.size));
    return vec4<f32>(in_window.x * 2.0 - 1.0, 1.0 - in_window.y * 2.0, 0.5, 1.0);
}
