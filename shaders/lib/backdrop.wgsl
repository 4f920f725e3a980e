// Lines that adapt to the background. Twin: npr_style::backdrop. The shader declares `rules`.

//# use lib/color
//# use lib/step

const RULE_OFF: u32 = 0u;
const RULE_BY_LIKENESS: u32 = 1u;
const RULE_BY_CONTRAST: u32 = 2u;
const RULE_AUTO: u32 = 0u;
const RULE_BRIGHTER: u32 = 1u;
const RULE_DARKER: u32 = 2u;
const RULE_WCAG: u32 = 1u;
const RULES_RIBBONS: u32 = 1u;
const RULES_OVERLAY: u32 = 2u;
const RIM_OUTSIDE: u32 = 0x80000000u;
const RIM_WITHIN: u32 = 0x40000000u;
const RIM_WHOSE: u32 = 0x7fffffffu;
// Side of the tiles in which borders are looked for, in output pixels.
const BORDER_TILE: u32 = 4u;

struct Rule {
    thresholds: vec4<f32>,
    method: u32,
    direction: u32,
    measure: u32,
    goal: f32,
    intensity: f32,
    rim_factor: f32,
    within: u32,
    unused: u32,
}

struct Rules {
    rules: array<Rule, 16>,
    smooth_px: f32,
    whole_px: f32,
    reach_px: u32,
    samples: u32,
    within: u32,
    bias_px: f32,
    hold: f32,
    fade: f32,
}

struct PartSubject {
    subject: u32,
    rule: u32,
}

struct Rim {
    rim: u32,
    behind: u32,
    subject: u32,
    part: u32,
}
