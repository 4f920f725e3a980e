//! The rule by which a line minds the background, as passes read it.

use bytemuck::{Pod, Zeroable};
use npr_core::gpu_layout;

/// Most different rules of a frame, the first of which never applies.
pub const RULES_MAX: usize = 16;

/// The rule by which a line minds the background.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct Rule {
    /// Largest difference at which colours count as alike, of the published method: of any channel of RGB, 0..1; of
    /// V; of S; of hue in turns, 0..0.5. Criteria below 0 are not used.
    pub thresholds: [f32; 4],
    /// [`Rule::OFF`], [`Rule::BY_LIKENESS`] or [`Rule::BY_CONTRAST`].
    pub method: u32,
    /// [`Rule::AUTO`], [`Rule::BRIGHTER`] or [`Rule::DARKER`].
    pub direction: u32,
    /// [`Rule::LIGHTNESS`] or [`Rule::WCAG`].
    pub measure: u32,
    /// Contrast that a line must have: difference of OKLab lightness, 0..1, or the ratio of WCAG, 1..21.
    pub goal: f32,
    /// What the published method multiplies or divides by, from 1.
    pub intensity: f32,
    /// By contrast: what lines start from, as a share of the rim's linear light; 0 for their own colour.
    pub rim_factor: f32,
    /// 1 where lines within the subject follow it too, 0 where those at its border do alone.
    pub within: u32,
    /// Keeps rows of 16 bytes.
    pub unused: u32,
}
gpu_layout!(Rule {
    thresholds,
    method,
    direction,
    measure,
    goal,
    intensity,
    rim_factor,
    within,
    unused,
});

impl Rule {
    /// Leaves every line as it is.
    pub const OFF: u32 = 0;
    /// The published method: where rim and background are alike, the rim's colour times a factor.
    pub const BY_LIKENESS: u32 = 1;
    /// Ours: as much lightness as a target contrast needs.
    pub const BY_CONTRAST: u32 = 2;

    /// Brighter or darker, whichever reaches the target; the smaller step where both do.
    pub const AUTO: u32 = 0;
    /// Brighter alone.
    pub const BRIGHTER: u32 = 1;
    /// Darker alone.
    pub const DARKER: u32 = 2;

    /// Contrast is the difference of OKLab lightness.
    pub const LIGHTNESS: u32 = 0;
    /// Contrast is the ratio of luminances of WCAG 2.
    pub const WCAG: u32 = 1;

    /// By contrast: 0.3 of lightness, brighter or darker.
    pub const CONTRAST: Self = Self {
        thresholds: [-1.0; 4],
        method: Self::BY_CONTRAST,
        direction: Self::AUTO,
        measure: Self::LIGHTNESS,
        goal: 0.3,
        intensity: 1.0,
        rim_factor: 0.0,
        within: 0,
        unused: 0,
    };
}

impl Rule {
    /// The rule with numbers that the arithmetic can bear: a target within its range, a factor of at least 1.
    pub(super) fn sane(&self) -> Self {
        let within = |value: f32, least: f32, most: f32| match value.is_nan() {
            true => least,
            false => value.clamp(least, most),
        };
        Self {
            goal: match self.measure {
                Self::WCAG => within(self.goal, 1.0, 21.0),
                _ => within(self.goal, 0.0, 1.0),
            },
            intensity: within(self.intensity, 1.0, 1e6),
            rim_factor: within(self.rim_factor, 0.0, 1.0),
            ..*self
        }
    }
}

impl Rule {
    /// None: lines stay as they are.
    const NONE: Self = Self {
        method: Self::OFF,
        ..Self::CONTRAST
    };
}

impl Default for Rule {
    fn default() -> Self {
        Self::NONE
    }
}

/// The rules of a frame, and how far they reach.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct Rules {
    /// By number; number 0 is off.
    pub rules: [Rule; RULES_MAX],
    /// Standard deviation of the mean along the outline, in frame pixels; 0 for none.
    pub smooth_px: f32,
    /// Distance from the outline up to which lines follow the rule whole, in frame pixels.
    pub whole_px: f32,
    /// Distance from which they do not follow it at all, in whole pixels.
    pub reach_px: u32,
    /// Samples per pixel along each axis, 1 or 2.
    pub samples: u32,
    /// Where lines within subjects mind the background by any rule: [`Rules::ALWAYS`] with the layers that hold
    /// lines; else 0.
    pub within: u32,
    /// Distance up to which rims decide together which way their lines move, in frame pixels; 0 for each alone.
    pub bias_px: f32,
    /// Votes of each rim that what was decided in the frame before counts as; 0 for frames by themselves.
    pub hold: f32,
    /// How much of the way from darker to brighter a line may change a frame; 1 for all at once.
    pub fade: f32,
}
gpu_layout!(Rules {
    rules,
    smooth_px,
    whole_px,
    reach_px,
    samples,
    within,
    bias_px,
    hold,
    fade,
});

impl Rules {
    /// Rules of frames whose lines mind nothing.
    pub const NONE: Self = Self {
        rules: [Rule::NONE; RULES_MAX],
        smooth_px: 0.0,
        whole_px: 0.0,
        reach_px: 0,
        samples: 0,
        within: 0,
        bias_px: 0.0,
        hold: 0.0,
        fade: 1.0,
    };
}

impl Default for Rules {
    fn default() -> Self {
        Self::NONE
    }
}

impl Rules {
    /// Lines lie in the ribbons.
    pub const RIBBONS: u32 = 1;
    /// Lines lie in the overlay.
    pub const OVERLAY: u32 = 2;
    /// Lines within subjects mind the background.
    pub const ALWAYS: u32 = 4;

    /// These rules for a first frame: nothing is held and nothing fades.
    pub fn of_first_frame(self) -> Self {
        Self {
            hold: 0.0,
            fade: 1.0,
            ..self
        }
    }
}
