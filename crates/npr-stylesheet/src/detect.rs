//! The table `detect` of a style: how the line mask is found on the images of depth, normal and id.

use std::fmt;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Thickness of a line in the mask, in mask pixels: a jump marks the pixel on either side.
pub const MASK_LINE_PX: f32 = 2.0;

/// Lines where depth jumps.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct DepthTest {
    /// Whether the test runs; default true.
    pub on: bool,
    /// Depth difference of neighbouring mask pixels that makes a line, as a part of the frame's height
    /// at that distance, 0..10; default 0.012. Smaller finds shallow steps, larger only far backgrounds.
    #[schemars(range(min = 0.0, max = 10.0))]
    pub threshold: f32,
}

impl Default for DepthTest {
    fn default() -> Self {
        Self {
            on: true,
            threshold: 0.012,
        }
    }
}

/// Lines where the normal turns.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct NormalTest {
    /// Whether the test runs; default true.
    pub on: bool,
    /// Angle in degrees between the normals of neighbouring mask pixels that makes a line, 0..180;
    /// default that of creases, `line.crease_angle_deg`. 20 finds soft folds and facets, 60 only sharp corners.
    #[schemars(range(min = 0.0, max = 180.0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub threshold_deg: Option<f32>,
}

impl Default for NormalTest {
    fn default() -> Self {
        Self {
            on: true,
            threshold_deg: None,
        }
    }
}

/// Lines where an id changes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct IdTest {
    /// Whether the test runs; default true.
    pub on: bool,
}

impl Default for IdTest {
    fn default() -> Self {
        Self { on: true }
    }
}

/// How the line mask is found: the union of the tests that are on.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Detect {
    /// Frame pixels along the side of a mask pixel, 1..16; default 1. 1.5 and 3 are quicker and look nearly
    /// the same [Okuya et al. 2016, section 4]; too large for the line width, lines break into noise.
    #[schemars(range(min = 1.0, max = 16.0))]
    pub scale: f32,
    /// Whether depth is compared with the plane through the neighbour; default true. Off compares bare
    /// depths as published, which fills floors seen at a grazing angle with ink.
    pub plane_depth: bool,
    /// Whether the depth threshold grows with `scale`; default true. On, a coarse mask finds the lines
    /// that a fine one finds.
    pub rescale_thresholds: bool,
    /// Lines where depth jumps: one thing before another.
    pub depth: DepthTest,
    /// Lines where the normal turns: creases.
    pub normal: NormalTest,
    /// Lines where one object meets another, touching or not.
    pub object: IdTest,
    /// Lines where one material meets another.
    pub material: IdTest,
}

impl Default for Detect {
    fn default() -> Self {
        Self {
            scale: 1.0,
            plane_depth: true,
            rescale_thresholds: true,
            depth: DepthTest::default(),
            normal: NormalTest::default(),
            object: IdTest::default(),
            material: IdTest::default(),
        }
    }
}

impl Detect {
    /// The depth threshold to compare with at this mask scale.
    ///
    /// The depth of a slope differs `scale` times as much between mask pixels that lie `scale` times as far
    /// apart. The normals on either side of a crease do not, so their threshold stays.
    pub fn depth_threshold(&self) -> f32 {
        let growth = if self.rescale_thresholds {
            self.scale
        } else {
            1.0
        };
        self.depth.threshold * growth
    }
}

/// The warning about lines that are thinner than the lines of the mask.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WidthWarning {
    /// Thickness of a mask line, in frame pixels.
    pub mask_line_px: f32,
    /// Width of the drawn line, in frame pixels.
    pub width_px: f32,
}

impl fmt::Display for WidthWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            mask_line_px,
            width_px,
        } = self;
        write!(
            f,
            "lines {width_px:.1} px wide are thinner than the mask's {mask_line_px:.1} px and may show noise; \
             lower detect.scale or widen line.width"
        )
    }
}

/// Checks that a mask line, two mask pixels thick, is no thicker than the line drawn over it.
///
/// A thicker one lets the line's own edges show through as noise [Okuya et al. 2016, figure 16].
pub fn width_rule(scale: f32, width_px: f32) -> Option<WidthWarning> {
    let mask_line_px = MASK_LINE_PX * scale;
    (mask_line_px > width_px).then_some(WidthWarning {
        mask_line_px,
        width_px,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_published_scales_against_a_line_of_six_pixels() {
        for (scale, noisy) in [(1.0, false), (1.5, false), (3.0, false), (6.0, true)] {
            assert_eq!(width_rule(scale, 6.0).is_some(), noisy, "scale {scale}");
        }
    }

    #[test]
    fn the_warning_names_both_widths_and_the_cure() {
        let text = width_rule(6.0, 4.0).expect("a warning").to_string();
        assert!(
            text.contains("4.0 px") && text.contains("12.0 px") && text.contains("detect.scale"),
            "{text}"
        );
    }

    #[test]
    fn a_coarse_mask_takes_a_larger_depth_step() {
        let mut detect = Detect {
            scale: 3.0,
            ..Detect::default()
        };
        assert!((detect.depth_threshold() - 0.036).abs() < 1e-6);
        detect.rescale_thresholds = false;
        assert_eq!(detect.depth_threshold(), 0.012);
    }
}
