//! Constants of strokes from pixels.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The constants of method `potrace` and of `npr lines --method potrace` [Jiang et al. 2022]. Sides are those of pixels.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Potrace {
    /// Leaves out contours in valleys; default true. Off shows those of open surfaces from behind.
    pub convex_only: bool,
    /// Steps of the grid that lines are drawn on to a pixel, 1..8; default 2.
    #[schemars(range(min = 1, max = 8))]
    pub oversampling: u32,
    /// How far behind a surface a line still shows, as a share of the scene's radius, 0..1; default 0.02.
    /// Larger lets hidden lines through thin parts, smaller breaks lines on steep slopes.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub depth_tolerance: f32,
    /// Of a pixel and the eight around it, how many have to show a line, 0..9; default 2.
    #[schemars(range(min = 0, max = 9))]
    pub least_visible: u32,
    /// Rounds of pointer jumping, 0..32; default 0, as many as it takes. Where they are too few the picture fails.
    #[schemars(range(min = 0, max = 32))]
    pub rounds: u32,
    /// Pixels under which a loop is a speck, 0..1000000; default 32. Lines shorter than that vanish.
    #[schemars(range(min = 0.0, max = 1_000_000.0))]
    pub speck_area: f32,
    /// Pixels under which a thin loop is a speck, 0..1000000; default 64.
    #[schemars(range(min = 0.0, max = 1_000_000.0))]
    pub thin_speck_area: f32,
    /// Area for each side up to which a loop is thin, in pixels, 0..1000; default 1.
    #[schemars(range(min = 0.0, max = 1000.0))]
    pub thinness: f32,
    /// Reach of smoothing, in sides, 0..64; default 16.
    #[schemars(range(min = 0, max = 64))]
    pub smooth_radius: u32,
    /// Standard deviation of smoothing, in sides, 0..64; default 5. 1 keeps the steps of pixels, 12 rounds every corner.
    #[schemars(range(min = 0.0, max = 64.0))]
    pub smooth_sigma: f32,
    /// How often places and tangents are smoothed, 0..16; default 2.
    #[schemars(range(min = 0, max = 16))]
    pub smooth_passes: u32,
    /// Sides on each side that a tangent is fitted to, 0..64; default 12.
    #[schemars(range(min = 0, max = 64))]
    pub fit_radius: u32,
    /// Reach of the mean of contours' directions, in sides, 0..64; default 16.
    #[schemars(range(min = 0, max = 64))]
    pub direction_radius: u32,
    /// Standard deviation of that mean, in sides, 0..64; default 6.5.
    #[schemars(range(min = 0.0, max = 64.0))]
    pub direction_sigma: f32,
    /// Cosine between loop and contour over which a side is kept, 0..1; default 0.1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub least_cos: f32,
    /// Sides on each side that vote on whether one is kept, 0..64; default 7.
    #[schemars(range(min = 0, max = 64))]
    pub vote_radius: u32,
    /// By how many votes a side has to win, 0..129; default 2.
    #[schemars(range(min = 0, max = 129))]
    pub vote_margin: u32,
    /// Strokes of at most as many sides are dropped, 0..1000000; default 8.
    #[schemars(range(min = 0, max = 1_000_000))]
    pub short: u32,
}

impl Default for Potrace {
    fn default() -> Self {
        Self {
            convex_only: true,
            oversampling: 2,
            depth_tolerance: 0.02,
            least_visible: 2,
            rounds: 0,
            speck_area: 32.0,
            thin_speck_area: 64.0,
            thinness: 1.0,
            smooth_radius: 16,
            smooth_sigma: 5.0,
            smooth_passes: 2,
            fit_radius: 12,
            direction_radius: 16,
            direction_sigma: 6.5,
            least_cos: 0.1,
            vote_radius: 7,
            vote_margin: 2,
            short: 8,
        }
    }
}
