//! The constants of strokes from pixels: what styles state and the steps of the path read.

/// Every constant of the published path [Jiang et al. 2022]; sides are those of pixels. [`Default`] is as published.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PublishedPath {
    /// Leaves out contours in valleys, which their own surface hides; default true, as published.
    pub is_convex_only: bool,
    /// Steps of the grid that lines are drawn on to a pixel, 1..8; default 2.
    pub oversampling: u32,
    /// How far behind a surface a line still shows, as a share of the scene's radius; default 0.02.
    ///
    /// Larger lets hidden lines through thin parts, smaller breaks lines on steep slopes. The publication's is
    /// absolute.
    pub depth_tolerance: f32,
    /// Of a pixel and the eight around it, how many have to show a line; default 2.
    pub least_visible: u32,
    /// Rounds of pointer jumping for each of loop breaking and ranking, of which the published 16 rank loops up to
    /// 65,536 sides; default as many as it takes.
    pub rounds: Option<u32>,
    /// A loop of less area is a speck and dropped, in pixels; default 32.
    pub speck_area: f32,
    /// A thin loop of less area is a speck too; default 64.
    pub thin_speck_area: f32,
    /// Area for each side up to which a loop is thin, in pixels; default 1.
    pub thinness: f32,
    /// Smooths places along loops; default true. Without, strokes run through the middles of sides.
    pub smooth_places: bool,
    /// Reach of the filter that smooths places, in sides, up to 64; default 16.
    pub smooth_radius: u32,
    /// Standard deviation of its Gaussian, in sides; default 5.
    pub smooth_sigma: f32,
    /// How often places are smoothed, up to 16; default 2.
    pub smooth_passes: u32,
    /// Sides on each side that a tangent is fitted to, up to 64; default 12.
    pub fit_radius: u32,
    /// Reach of the filter that smooths tangents, in sides, up to 64; default 16.
    pub tangent_radius: u32,
    /// Standard deviation of its Gaussian, in sides; default 5.
    pub tangent_sigma: f32,
    /// How often tangents are smoothed, up to 16; default 2.
    pub tangent_passes: u32,
    /// Reach of the mean of directions of contours, in sides, up to 64; default 16.
    pub direction_radius: u32,
    /// Standard deviation of that mean, in sides; default 6.5.
    pub direction_sigma: f32,
    /// Cosine between loop and contour over which a side is kept, 0..1; default 0.1.
    pub least_cos: f32,
    /// Sides on each side that vote on whether one is kept, up to 64; default 7.
    pub vote_radius: u32,
    /// By how many votes it has to win; default 2.
    pub vote_margin: u32,
    /// Strokes of at most as many sides are dropped; default 8.
    pub short: u32,
}

impl Default for PublishedPath {
    fn default() -> Self {
        Self {
            is_convex_only: true,
            oversampling: 2,
            depth_tolerance: 0.02,
            least_visible: 2,
            rounds: None,
            speck_area: 32.0,
            thin_speck_area: 64.0,
            thinness: 1.0,
            smooth_places: true,
            smooth_radius: 16,
            smooth_sigma: 5.0,
            smooth_passes: 2,
            fit_radius: 12,
            tangent_radius: 16,
            tangent_sigma: 5.0,
            tangent_passes: 2,
            direction_radius: 16,
            direction_sigma: 6.5,
            least_cos: 0.1,
            vote_radius: 7,
            vote_margin: 2,
            short: 8,
        }
    }
}

/// Widest window along a loop, in sides on each side.
const RADIUS_LIMIT: u32 = 64;

/// Most rounds of smoothing.
const PASS_LIMIT: u32 = 16;

impl PublishedPath {
    /// The same with every value within its limits.
    pub fn within_limits(&self) -> Self {
        let radius = |radius: u32| radius.min(RADIUS_LIMIT);
        Self {
            oversampling: self.oversampling.clamp(1, 8),
            least_visible: self.least_visible.min(9),
            smooth_passes: self.smooth_passes.min(PASS_LIMIT),
            tangent_passes: self.tangent_passes.min(PASS_LIMIT),
            tangent_radius: radius(self.tangent_radius),
            smooth_radius: radius(self.smooth_radius),
            fit_radius: radius(self.fit_radius),
            direction_radius: radius(self.direction_radius),
            vote_radius: radius(self.vote_radius),
            vote_margin: self.vote_margin.min(2 * RADIUS_LIMIT + 1),
            ..*self
        }
    }
}
