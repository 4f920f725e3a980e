// Hatching on paper. Twin: npr_style::inking. The shader declares `parts`.

//# use lib/grain

// Height of the paper below which it takes less ink of a hatch, on paper of grain 1.
const LEVEL: f32 = 0.3;

// Height over which its ink goes from all to none below that.
const SOFT: f32 = 0.25;

// What the grain of the paper leaves of the ink of a hatch at a place of the picture, in pixels.
fn on_paper(part: u32, ink: f32, px: vec2<f32>) -> f32 {
    if ink <= 0.0 || parts[part].hatch_grain <= 0.0 { return ink; }
    let above = paper_height(px, parts[part].spots_per_px) - parts[part].hatch_grain * LEVEL;
    return ink * clamp(1.0 + above / SOFT, 0.0, 1.0);
}
