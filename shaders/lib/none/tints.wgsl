// The tints of lines where none depends on its place.

//# use lib/geometry
//# use lib/window
//# use lib/line_tint

fn has_no_tints() -> bool {
    return true;
}

fn line_color_at(part: u32, kind: u32, px: vec2<f32>) -> vec4<f32> {
    return line_color(part, kind, Tint());
}
