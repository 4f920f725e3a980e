//! Visibility of lines sampled on depth and object images, where exact sights would cost too much.
//!
//! Visibility is a property of a line's spine, not of the pixels that its stroke covers [Cole & Finkelstein 2010]:
//! every sample looks at the pixel under it and at some on the outer side, away from its own surface, and gets the
//! share that does not hide it; a filter along the line turns shares into runs. [`place_samples`] is plain;
//! [`sample_visibility`], [`weigh_samples`] and [`filter_visibility`] are the twins of passes.

mod filter;
mod place;

pub use filter::{filter_visibility, visible_samples, weigh_samples};
pub use place::{SampledLines, Spine, place_samples};

use bytemuck::{Pod, Zeroable};
use npr_core::geometry::{GPixel, NONE};
use npr_core::gpu_layout;
use npr_core::window::{View, Window};
use rayon::prelude::*;

/// Places that a sample looks at, from the spine towards its outer side.
///
/// The first is the spine's own pixel, where half of all samples meet their own surface.
pub const TAP_COUNT: u32 = 4;

/// Distance from one of these places to the next, in grid pixels.
pub const TAP_STEP_PX: f32 = 0.75;

/// Number of pixels by which the depth on a slope of the sample's own part may be off.
///
/// A spine runs where its own surface turns away, so the depth under it may come from the next pixel of a steep
/// slope. The pixel's plane is continued up to half a pixel; as much again is what it may be wrong by. More shows
/// lines just behind a limb of their own part: of a helmet's samples 97.0 % agree with exact visibility at one half,
/// 96.3 % at one, 93.4 % at two.
pub const SLOPE_PIXELS: f32 = 0.5;

/// Steepest slope that counts, in depth per pixel of a pixel's size: the limb of a ball has no bound.
pub const LARGEST_SLOPE: f32 = 2.0;

/// Difference of depths, as a share of depth, that rounding explains.
pub const DEPTH_ROUNDING: f32 = 1.0 / 65536.0;

/// A point of a line's spine.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct SpineSample {
    /// Place in the frame, in pixels.
    pub place_px: [f32; 2],
    /// Unit vector in the frame, away from the line's own surface; zero for lines within a surface.
    pub outward: [f32; 2],
    /// Distance from the eye along the view axis.
    pub depth: f32,
    /// Index of its part.
    pub part: u32,
    /// Number of its line.
    pub line: u32,
    /// Keeps the size a multiple of 8 bytes.
    pub unused: u32,
}
gpu_layout!(SpineSample {
    place_px,
    outward,
    depth,
    part,
    line,
    unused
});

/// The images that samples are tested on.
#[derive(Debug, Clone, Copy)]
pub struct Surroundings<'a> {
    /// Camera and frame.
    pub view: &'a View,
    /// The pixel grid of the G-buffer.
    pub window: &'a Window,
    /// The surface seen at every pixel of the grid.
    pub gbuffer: &'a [GPixel],
}

/// Writes for every sample the share of its taps, 0..1, at which no surface lies in front of it.
///
/// Samples outside the grid read its nearest pixel; where there is no grid nothing hides. O(samples), parallel.
pub fn sample_visibility(on: &Surroundings<'_>, samples: &[SpineSample], shares: &mut [f32]) {
    shares
        .par_iter_mut()
        .zip(samples)
        .with_min_len(1024)
        .for_each(|(share, sample)| *share = on.visible_share(sample));
}

impl Surroundings<'_> {
    fn visible_share(&self, sample: &SpineSample) -> f32 {
        let mut open = 0.0;
        for tap in 0..TAP_COUNT {
            let step = self.window.frame_step.map(|s| tap as f32 * TAP_STEP_PX * s);
            let at_px = [
                sample.place_px[0] + step[0] * sample.outward[0],
                sample.place_px[1] + step[1] * sample.outward[1],
            ];
            if !self.hides(sample, at_px) {
                open += 1.0;
            }
        }
        open / TAP_COUNT as f32
    }

    /// Whether the surface seen at a place of the frame lies in front of the sample.
    fn hides(&self, sample: &SpineSample, at_px: [f32; 2]) -> bool {
        if self.window.size[0] * self.window.size[1] == 0 {
            return false;
        }
        let [x, y] = self.window.pixel_at(at_px);
        let pixel = &self.gbuffer[(y * self.window.size[0] + x) as usize];
        if pixel.part == NONE {
            return false;
        }
        let own = pixel.part == sample.part;
        let mut tolerance = sample.depth * DEPTH_ROUNDING;
        if own {
            let slope = self
                .view
                .slope_of(self.window, pixel.depth, pixel.plane_step);
            let footprint = self.view.pixel_at(pixel.depth) * self.window.frame_step[1];
            tolerance = tolerance.max(SLOPE_PIXELS * footprint * slope.clamp(1.0, LARGEST_SLOPE));
        }
        self.depth_at(pixel, [x, y], at_px) < sample.depth - tolerance
    }

    /// Depth of a pixel's plane at a place beside the pixel's centre.
    fn depth_at(&self, pixel: &GPixel, [x, y]: [u32; 2], at_px: [f32; 2]) -> f32 {
        let centre_px = self.window.frame_at(x, y);
        // Beyond the pixel, as outside the grid, its plane says nothing.
        let off =
            |i: usize| ((at_px[i] - centre_px[i]) / self.window.frame_step[i]).clamp(-0.5, 0.5);
        let change = off(0) * pixel.plane_step[0] + off(1) * pixel.plane_step[1];
        let coordinate = self.view.plane_coordinate(pixel.depth) + change;
        self.view.depth_of_coordinate(coordinate)
    }
}

/// Closes hidden gaps in a line shorter than `least`, then hides visible specks shorter than that between hidden parts.
///
/// `hidden` and `lengths` hold one entry per sample of one line; its ends stay as they are. O(samples).
pub fn settle_runs(hidden: &mut [bool], lengths: &[f64], least: f64) {
    for turns in [true, false] {
        let mut from = 0;
        while from < hidden.len() {
            let same = hidden[from..]
                .iter()
                .take_while(|h| **h == hidden[from])
                .count();
            let to = from + same;
            let length: f64 = lengths[from..to].iter().sum();
            let inner = from > 0 && to < hidden.len();
            if inner && hidden[from] == turns && length < least {
                hidden[from..to].fill(!turns);
            }
            from = to;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use npr_core::camera::{Camera, Projection};
    use proptest::prelude::*;

    const SIDE: u32 = 32;

    fn frame(perspective: bool) -> (View, Window) {
        let projection = match perspective {
            true => Projection::Perspective { fov_y: 0.7 },
            false => Projection::Parallel { height: 4.0 },
        };
        let camera = Camera {
            eye: [0.0, 0.0, 4.0],
            target: [0.0; 3],
            up: [0.0, 1.0, 0.0],
            projection,
        };
        let view = camera.view([SIDE; 2], ([-9.0; 3], [9.0; 3]));
        (
            view,
            Window::over(view.frame_px, [0.0; 2], view.frame_px, [SIDE; 2]),
        )
    }

    fn pixel(depth: f32, part: u32) -> GPixel {
        GPixel {
            depth,
            part,
            ..GPixel::EMPTY
        }
    }

    /// A sample of part 0 in the middle of the frame, its surface on the left.
    fn sample(depth: f32) -> SpineSample {
        SpineSample {
            place_px: [16.0, 16.5],
            outward: [1.0, 0.0],
            depth,
            ..SpineSample::default()
        }
    }

    fn share(perspective: bool, paint: impl Fn(u32) -> GPixel) -> f32 {
        let (view, window) = frame(perspective);
        let gbuffer: Vec<GPixel> = (0..SIDE * SIDE).map(|i| paint(i % SIDE)).collect();
        let on = Surroundings {
            view: &view,
            window: &window,
            gbuffer: &gbuffer,
        };
        let mut shares = [0.0];
        sample_visibility(&on, &[sample(4.0)], &mut shares);
        shares[0]
    }

    #[test]
    fn a_line_before_nothing_or_something_farther_is_visible() {
        for perspective in [true, false] {
            assert_eq!(share(perspective, |_| GPixel::EMPTY), 1.0);
            assert_eq!(share(perspective, |_| pixel(5.0, 1)), 1.0);
            assert_eq!(
                share(perspective, |x| if x < 16 {
                    pixel(4.0, 0)
                } else {
                    pixel(5.0, 1)
                }),
                1.0
            );
        }
    }

    #[test]
    fn a_line_behind_another_part_is_hidden_even_if_it_is_near() {
        for perspective in [true, false] {
            assert_eq!(share(perspective, |_| pixel(3.999, 1)), 0.0);
            assert_eq!(share(perspective, |_| pixel(2.0, 0)), 0.0);
            let half = share(perspective, |x| {
                if x < 17 { pixel(5.0, 1) } else { pixel(2.0, 1) }
            });
            assert!(half > 0.2 && half < 0.8, "{half}");
        }
    }

    #[test]
    fn its_own_slope_does_not_hide_a_line() {
        assert_eq!(share(true, |_| pixel(3.97, 0)), 1.0);
        assert_eq!(share(true, |_| pixel(3.97, 1)), 0.0);
    }

    #[test]
    fn nothing_hides_where_there_is_no_picture() {
        let (view, window) = frame(true);
        let on = Surroundings {
            view: &view,
            window: &Window {
                size: [0; 2],
                ..window
            },
            gbuffer: &[],
        };
        let mut shares = [0.0];
        sample_visibility(&on, &[sample(4.0)], &mut shares);
        assert_eq!(shares, [1.0]);
    }

    #[test]
    fn samples_outside_the_frame_are_read_at_its_border() {
        let (view, window) = frame(true);
        let gbuffer = vec![pixel(2.0, 1); (SIDE * SIDE) as usize];
        let on = Surroundings {
            view: &view,
            window: &window,
            gbuffer: &gbuffer,
        };
        let odd = [
            [-1e9, 5.0],
            [1e30, -1e30],
            [f32::INFINITY; 2],
            [f32::NAN; 2],
        ];
        let samples = odd.map(|place_px| SpineSample {
            place_px,
            ..sample(4.0)
        });
        let mut shares = [9.0; 4];
        sample_visibility(&on, &samples, &mut shares);
        assert_eq!(shares[..3], [0.0; 3]);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        #[test]
        fn settled_runs_are_long_or_at_an_end(
            mut hidden in proptest::collection::vec(any::<bool>(), 0..60), least in 0.0f64..6.0,
        ) {
            let ends = [hidden.first().copied(), hidden.last().copied()];
            let lengths = vec![1.0; hidden.len()];
            settle_runs(&mut hidden, &lengths, least);
            prop_assert_eq!(ends, [hidden.first().copied(), hidden.last().copied()]);
            let runs: Vec<&[bool]> = hidden.chunk_by(|a, b| a == b).collect();
            for run in runs.iter().take(runs.len().saturating_sub(1)).skip(1) {
                // A gap may outlive a speck beside it, but no speck is left.
                prop_assert!(run[0] || run.len() as f64 >= least);
            }
        }
    }
}
