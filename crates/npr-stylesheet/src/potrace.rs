//! Constants of strokes from pixels.

use npr_core::published_path::PublishedPath;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The constants of method `potrace` and of `npr lines --method potrace` [Jiang et al. 2022]. Sides are those of
/// pixels; defaults are those of [`PublishedPath`].
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
    /// Reach of smoothing places, in sides, 0..64; default 16.
    #[schemars(range(min = 0, max = 64))]
    pub smooth_radius: u32,
    /// Standard deviation of smoothing, in sides, 0..64; default 5. 1 keeps the steps of pixels, 12 rounds every
    /// corner.
    #[schemars(range(min = 0.0, max = 64.0))]
    pub smooth_sigma: f32,
    /// How often places are smoothed, 0..16; default 2.
    #[schemars(range(min = 0, max = 16))]
    pub smooth_passes: u32,
    /// Sides on each side that a tangent is fitted to, 0..64; default 12.
    #[schemars(range(min = 0, max = 64))]
    pub fit_radius: u32,
    /// Reach of smoothing tangents, in sides, 0..64; default 16. More of it moves where strokes end.
    #[schemars(range(min = 0, max = 64))]
    pub tangent_radius: u32,
    /// Standard deviation of smoothing tangents, in sides, 0..64; default 5.
    #[schemars(range(min = 0.0, max = 64.0))]
    pub tangent_sigma: f32,
    /// How often tangents are smoothed, 0..16; default 2.
    #[schemars(range(min = 0, max = 16))]
    pub tangent_passes: u32,
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
        let path = PublishedPath::default();
        Self {
            convex_only: path.is_convex_only,
            oversampling: path.oversampling,
            depth_tolerance: path.depth_tolerance,
            least_visible: path.least_visible,
            rounds: path.rounds.unwrap_or(0),
            speck_area: path.speck_area,
            thin_speck_area: path.thin_speck_area,
            thinness: path.thinness,
            smooth_radius: path.smooth_radius,
            smooth_sigma: path.smooth_sigma,
            smooth_passes: path.smooth_passes,
            fit_radius: path.fit_radius,
            tangent_radius: path.tangent_radius,
            tangent_sigma: path.tangent_sigma,
            tangent_passes: path.tangent_passes,
            direction_radius: path.direction_radius,
            direction_sigma: path.direction_sigma,
            least_cos: path.least_cos,
            vote_radius: path.vote_radius,
            vote_margin: path.vote_margin,
            short: path.short,
        }
    }
}

impl Potrace {
    /// The constants as the path reads them.
    pub fn path(&self) -> PublishedPath {
        PublishedPath {
            is_convex_only: self.convex_only,
            oversampling: self.oversampling,
            depth_tolerance: self.depth_tolerance,
            least_visible: self.least_visible,
            rounds: (self.rounds > 0).then_some(self.rounds),
            speck_area: self.speck_area,
            thin_speck_area: self.thin_speck_area,
            thinness: self.thinness,
            smooth_places: true,
            smooth_radius: self.smooth_radius,
            smooth_sigma: self.smooth_sigma,
            smooth_passes: self.smooth_passes,
            fit_radius: self.fit_radius,
            tangent_radius: self.tangent_radius,
            tangent_sigma: self.tangent_sigma,
            tangent_passes: self.tangent_passes,
            direction_radius: self.direction_radius,
            direction_sigma: self.direction_sigma,
            least_cos: self.least_cos,
            vote_radius: self.vote_radius,
            vote_margin: self.vote_margin,
            short: self.short,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constants_of_styles_are_those_of_the_path() {
        assert_eq!(Potrace::default().path(), PublishedPath::default());
    }
}
