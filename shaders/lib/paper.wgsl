// Hatching on paper. Twin: npr_style::inking. The shader declares `parts`.

//# use lib/grain

// Pressure, as a share of the full one, over which the ink of a hatch grows from none to all.
const SOFT: f32 = 0.4;

// What the grain of the paper leaves of the ink of a hatch at a place of the picture, in pixels.
fn on_paper(part: u32, ink: f32, px: vec2<f32>) -> f32 {
    if ink <= 0.0 || parts[part].hatch_grain <= 0.0 { return ink; }
    let valley = 1.0 - paper_height(px, parts[part].spots_per_px);
    return ink * clamp((1.0 - parts[part].hatch_grain * valley) / SOFT + 0.5, 0.0, 1.0);
}
