// Steps between tones: where the ink of a part ends at once, and those of its ramp. Twin: npr_style::ink_step.
// The shader declares `parts`.

// Hatch luminance that stands for the hatch where there is none.
const NO_HATCH: f32 = 0.5;

// A step that light never passes.
const NO_STEP: f32 = 2.0;

// Coordinate of the ramp where the ink of a part ends, if there is nothing but the light that decides; else NO_STEP.
fn ink_step(part: u32) -> f32 {
    let all = PART_INK | PART_HATCH | PART_PAINTED | PART_SPARED;
    let level = 0.5 + 0.5 * (parts[part].threshold - NO_HATCH);
    if (parts[part].flags & all) != PART_INK || level <= 0.0 || level >= 1.0 { return NO_STEP; }
    let low = min(parts[part].light_at, parts[part].dark_at);
    return low + level * max(parts[part].light_at - parts[part].dark_at, 0.0);
}

// Steps of a part's ramp that light passes at coordinate `x`.
fn ramp_steps(part: u32, x: f32) -> u32 {
    var passed = 0u;
    for (var i = 1u; i < 8u; i++) {
        if parts[part].ramp[i].a <= x { passed += 1u; }
    }
    return passed;
}
