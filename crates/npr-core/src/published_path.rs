//! The constants of strokes from pixels: what styles state and the steps of the path read.

/// Hands every constant of the path to a macro: what it is, its range, its name, its type and what was published.
///
/// [`PublishedPath`] and the table of styles are both made of this list. Sides are those of pixels.
#[macro_export]
macro_rules! published_constants {
    ($table:ident) => {
        $table! {
        /// Leaves out contours in valleys; default true. Off shows those of open surfaces from behind.
        convex_only: bool = true;
        /// Steps of the grid that lines are drawn on to a pixel, 1..8; default 2.
        #[schemars(range(min = 1, max = 8))]
        oversampling: u32 = 2;
        /// How far behind a surface a line still shows, as a share of the scene's radius, 0..1; default 0.02.
        /// Larger lets hidden lines through thin parts, smaller breaks lines on steep slopes.
        #[schemars(range(min = 0.0, max = 1.0))]
        depth_tolerance: f32 = 0.02;
        /// Of a pixel and the eight around it, how many have to show a line, 0..9; default 2.
        #[schemars(range(min = 0, max = 9))]
        least_visible: u32 = 2;
        /// Rounds of pointer jumping, 0..32; default 0, as many as it takes. Where they are too few the picture fails.
        #[schemars(range(min = 0, max = 32))]
        rounds: u32 = 0;
        /// Pixels under which a loop is a speck, 0..1000000; default 32. Lines shorter than that vanish.
        #[schemars(range(min = 0.0, max = 1_000_000.0))]
        speck_area: f32 = 32.0;
        /// Pixels under which a thin loop is a speck, 0..1000000; default 64.
        #[schemars(range(min = 0.0, max = 1_000_000.0))]
        thin_speck_area: f32 = 64.0;
        /// Area for each side up to which a loop is thin, in pixels, 0..1000; default 1.
        #[schemars(range(min = 0.0, max = 1000.0))]
        thinness: f32 = 1.0;
        /// Reach of smoothing places, in sides, 0..64; default 16.
        #[schemars(range(min = 0, max = 64))]
        smooth_radius: u32 = 16;
        /// Standard deviation of smoothing, in sides, 0..64; default 5. 1 keeps the steps of pixels, 12 rounds every
        /// corner.
        #[schemars(range(min = 0.0, max = 64.0))]
        smooth_sigma: f32 = 5.0;
        /// How often places are smoothed, 0..16; default 2.
        #[schemars(range(min = 0, max = 16))]
        smooth_passes: u32 = 2;
        /// Sides on each side that a tangent is fitted to, 0..64; default 12.
        #[schemars(range(min = 0, max = 64))]
        fit_radius: u32 = 12;
        /// Reach of smoothing tangents, in sides, 0..64; default 16. More of it moves where strokes end.
        #[schemars(range(min = 0, max = 64))]
        tangent_radius: u32 = 16;
        /// Standard deviation of smoothing tangents, in sides, 0..64; default 5.
        #[schemars(range(min = 0.0, max = 64.0))]
        tangent_sigma: f32 = 5.0;
        /// How often tangents are smoothed, 0..16; default 2.
        #[schemars(range(min = 0, max = 16))]
        tangent_passes: u32 = 2;
        /// Reach of the mean of contours' directions, in sides, 0..64; default 16.
        #[schemars(range(min = 0, max = 64))]
        direction_radius: u32 = 16;
        /// Standard deviation of that mean, in sides, 0..64; default 6.5.
        #[schemars(range(min = 0.0, max = 64.0))]
        direction_sigma: f32 = 6.5;
        /// Cosine between loop and contour over which a side is kept, 0..1; default 0.1.
        #[schemars(range(min = 0.0, max = 1.0))]
        least_cos: f32 = 0.1;
        /// Sides on each side that vote on whether one is kept, 0..64; default 7.
        #[schemars(range(min = 0, max = 64))]
        vote_radius: u32 = 7;
        /// By how many votes a side has to win, 0..129; default 2.
        #[schemars(range(min = 0, max = 129))]
        vote_margin: u32 = 2;
        /// Strokes of at most as many sides are dropped, 0..1000000; default 8.
        #[schemars(range(min = 0, max = 1_000_000))]
        short: u32 = 8;
        }
    };
}

macro_rules! path {
    ($($(#[doc = $doc:literal])+ $(#[schemars $range:tt])? $key:ident: $type:ty = $published:expr;)+) => {
        /// Every constant of the published path [Jiang et al. 2022]; sides are those of pixels. [`Default`] is as
        /// published.
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub struct PublishedPath {
            $($(#[doc = $doc])+ pub $key: $type,)+
            /// Smooths places along loops; default true. Without, strokes run through the middles of sides.
            pub smooth_places: bool,
        }

        impl Default for PublishedPath {
            fn default() -> Self {
                Self { $($key: $published,)+ smooth_places: true }
            }
        }
    };
}

published_constants!(path);

/// Widest window along a loop, in sides on each side.
const RADIUS_LIMIT: u32 = 64;

/// Most rounds of smoothing.
const PASS_LIMIT: u32 = 16;

impl PublishedPath {
    /// Rounds of pointer jumping for each of loop breaking and ranking, of which the published 16 rank loops up to
    /// 65,536 sides; none where as many are made as it takes.
    pub fn round_limit(&self) -> Option<u32> {
        (self.rounds > 0).then_some(self.rounds)
    }

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
