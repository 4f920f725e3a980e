//! The rule by which a line adapts to the background, as passes read it.

use bytemuck::{Pod, Zeroable};
use npr_core::gpu_layout;

/// Most rules of a frame; the first of them is off.
pub const RULES_MAX: usize = 16;

/// The rule by which a line adapts to the background.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct Rule {
    /// Published method: largest differences at which colours count as alike, of any channel of RGB, 0..1; of V; of S;
    /// of hue in turns, 0..0.5. Criteria below 0 are not used.
    pub thresholds: [f32; 4],
    /// [`Rule::OFF`], [`Rule::BY_LIKENESS`] or [`Rule::BY_CONTRAST`].
    pub method: u32,
    /// [`Rule::AUTO`], [`Rule::BRIGHTER`] or [`Rule::DARKER`].
    pub direction: u32,
    /// [`Rule::LIGHTNESS`] or [`Rule::WCAG`].
    pub measure: u32,
    /// Contrast that a line must have: difference of OKLab lightness, 0..1, or the ratio of WCAG, 1..21.
    pub goal: f32,
    /// Published method: the factor to multiply or divide the rim's colour by, at least 1.
    pub intensity: f32,
    /// By contrast: share of the rim's linear light that lines start from; 0 if they start from their own colour.
    pub rim_factor: f32,
    /// 1 if lines within the subject follow the rule too, 0 if only those at its border do.
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
    /// The published method: where rim and background are alike, the line is the rim's colour times a factor.
    pub const BY_LIKENESS: u32 = 1;
    /// Our method: lightness changes by as much as a target contrast needs.
    pub const BY_CONTRAST: u32 = 2;

    /// Direction: whichever of brighter and darker reaches the target; the smaller step if both do.
    pub const AUTO: u32 = 0;
    /// Direction: only brighter.
    pub const BRIGHTER: u32 = 1;
    /// Direction: only darker.
    pub const DARKER: u32 = 2;

    /// Measure: contrast is the difference of OKLab lightness.
    pub const LIGHTNESS: u32 = 0;
    /// Measure: contrast is the ratio of luminances of WCAG 2.
    pub const WCAG: u32 = 1;

    /// A rule by contrast: 0.3 of lightness, brighter or darker.
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
    /// The rule with its numbers clamped to valid ranges: a target within its scale, a factor of at least 1.
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
    /// No rule: lines stay as they are.
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
    /// The rules by number; number 0 is off.
    pub rules: [Rule; RULES_MAX],
    /// Standard deviation of the Gaussian that blends rims along the outline, in frame pixels; 0 for none.
    pub smooth_px: f32,
    /// Distance from the outline up to which lines follow the rule in full, in frame pixels.
    pub whole_px: f32,
    /// Distance from which lines do not follow it at all, in whole pixels.
    pub reach_px: u32,
    /// Samples per pixel along each axis, 1 or 2.
    pub samples: u32,
    /// If any rule adapts lines within subjects: [`Rules::ALWAYS`] with the bits of the layers that hold lines; else 0.
    pub within: u32,
    /// Distance up to which rims decide together which way their lines move, in frame pixels; 0 if each decides alone.
    pub bias_px: f32,
    /// Weight of the previous frame's decision against the mean vote of the rims; 0 if frames are independent.
    pub hold: f32,
    /// How far a line may change from darker to brighter in one frame, as a share; 1 for all at once.
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
    /// The rules of a frame whose lines do not adapt.
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
    /// Bit: lines lie in the ribbons.
    pub const RIBBONS: u32 = 1;
    /// Bit: lines lie in the overlay.
    pub const OVERLAY: u32 = 2;
    /// Bit: lines within subjects adapt to the background.
    pub const ALWAYS: u32 = 4;

    /// These rules for the first frame of a series: nothing is held and nothing fades.
    pub fn of_first_frame(self) -> Self {
        Self {
            hold: 0.0,
            fade: 1.0,
            ..self
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn goals_are_kept_within_the_scale_of_their_measure() {
        let goal = |measure, goal| {
            let rule = Rule {
                measure,
                goal,
                ..Rule::CONTRAST
            };
            rule.sane().goal
        };
        assert_eq!(
            [0.0, 4.5, 99.0].map(|ratio| goal(Rule::WCAG, ratio)),
            [1.0, 4.5, 21.0]
        );
        let lightness = |value| goal(Rule::LIGHTNESS, value);
        assert_eq!([-1.0, 0.3, 4.5].map(lightness), [0.0, 0.3, 1.0]);
        assert_eq!(goal(Rule::WCAG, f32::NAN), 1.0);
    }
}
