//! Samples along lines, a pixel apart.

use super::SpineSample;
use npr_core::window::View;

/// Most samples of a line; longer ones are sampled more coarsely.
pub const LINE_SAMPLES: u32 = 1 << 16;

/// A line to be sampled.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Spine {
    /// Its points in order: place in the frame in pixels, and distance from the eye along the view axis.
    pub points: Vec<[f32; 3]>,
    /// The side away from its own surface, as seen along it: 1 right, -1 left, 0 for lines within a surface.
    pub outer_side: f32,
    /// Index of its part.
    pub part: u32,
}

/// The samples of lines.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SampledLines {
    /// Samples, line after line.
    pub samples: Vec<SpineSample>,
    /// Where each line starts in `samples`; one more than there are lines.
    pub line_starts: Vec<u32>,
}

/// Places samples along lines at equal distances of at most a pixel, in the middle of what each stands for.
///
/// Lines without a finite length have none. O(points + samples).
pub fn place_samples(view: &View, spines: &[Spine]) -> SampledLines {
    let mut placed = SampledLines {
        samples: Vec::new(),
        line_starts: vec![0],
    };
    for (line, spine) in (0..).zip(spines) {
        spine.place(view, line, &mut placed.samples);
        placed.line_starts.push(placed.samples.len() as u32);
    }
    placed
}

impl Spine {
    fn place(&self, view: &View, line: u32, samples: &mut Vec<SpineSample>) {
        let length: f32 = self.points.windows(2).map(distance).sum();
        // No comparison holds for what is no number.
        if !(length > 0.0 && length.is_finite()) {
            return;
        }
        let count = (length.ceil() as u32).min(LINE_SAMPLES);
        let step = length / count as f32;
        let (mut next, mut passed) = (0, 0.0);
        for ends in self.points.windows(2) {
            let own = distance(ends);
            while next < count && (next as f32 + 0.5) * step < passed + own {
                let share = ((next as f32 + 0.5) * step - passed) / own;
                samples.push(self.sample(view, line, ends, share.clamp(0.0, 1.0)));
                next += 1;
            }
            passed += own;
        }
    }

    /// The sample at a share of the way from one point to the next.
    fn sample(&self, view: &View, line: u32, ends: &[[f32; 3]], share: f32) -> SpineSample {
        let between = |from: f32, to: f32| from + (to - from) * share;
        let [a, b] = [ends[0], ends[1]];
        let [along_x, along_y] = [0, 1].map(|i| (b[i] - a[i]) / distance(ends));
        let coordinates = [a, b].map(|p| view.plane_coordinate(p[2]));
        SpineSample {
            place_px: [between(a[0], b[0]), between(a[1], b[1])],
            // The picture's y runs down, so right of the way is a quarter turn from x to y.
            outward: [-along_y * self.outer_side, along_x * self.outer_side],
            depth: view.depth_of_coordinate(between(coordinates[0], coordinates[1])),
            part: self.part,
            line,
            unused: 0,
        }
    }
}

fn distance(ends: &[[f32; 3]]) -> f32 {
    let (dx, dy) = (ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]);
    (dx * dx + dy * dy).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn view(perspective: f32) -> View {
        View {
            perspective,
            view_height: 1.0,
            frame_px: [100.0; 2],
            ..View::default()
        }
    }

    #[test]
    fn a_line_is_sampled_in_the_middle_of_every_pixel() {
        let spine = Spine {
            points: vec![[10.0, 20.0, 1.0], [14.0, 20.0, 2.0]],
            outer_side: 1.0,
            ..Spine::default()
        };
        let placed = place_samples(&view(1.0), &[Spine::default(), spine]);
        assert_eq!(placed.line_starts, [0, 0, 4]);
        let places: Vec<[f32; 2]> = placed.samples.iter().map(|s| s.place_px).collect();
        assert_eq!(
            places,
            [[10.5, 20.0], [11.5, 20.0], [12.5, 20.0], [13.5, 20.0]]
        );
        // 1 / depth is linear over the picture: 1 at the start, 1 / 2 at the end.
        assert!((placed.samples[1].depth - 1.0 / 0.8125).abs() < 1e-6);
        // Right of a line that runs right is below.
        assert!(
            placed
                .samples
                .iter()
                .all(|s| s.outward == [0.0, 1.0] && s.line == 1)
        );
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        #[test]
        fn samples_lie_on_their_line_and_a_pixel_apart(
            points in proptest::collection::vec(prop::array::uniform3(1f32..90.0), 0..12), parallel: bool,
        ) {
            let view = view(if parallel { 0.0 } else { 1.0 });
            let spine = Spine { points: points.clone(), outer_side: -1.0, ..Spine::default() };
            let placed = place_samples(&view, &[spine]);
            let whole: f32 = points.windows(2).map(distance).sum();
            prop_assert_eq!(placed.samples.len(), whole.ceil() as usize);
            prop_assert_eq!(placed.line_starts, [0, whole.ceil() as u32]);
            for sample in &placed.samples {
                let [x, y] = sample.place_px;
                let on_piece = |ends: &[[f32; 3]]| {
                    let via = |p: [f32; 3]| distance(&[p, [x, y, 0.0]]);
                    via(ends[0]) + via(ends[1]) <= distance(ends) + 0.02
                };
                prop_assert!(points.windows(2).any(on_piece), "{:?}", sample);
                prop_assert!((distance(&[[0.0; 3], [sample.outward[0], sample.outward[1], 0.0]]) - 1.0).abs() < 1e-4);
                prop_assert!((0.99..90.1).contains(&sample.depth));
            }
        }

        #[test]
        fn any_numbers_give_few_finite_samples(
            points in proptest::collection::vec(prop::array::uniform3(any::<f32>()), 0..6),
        ) {
            let placed = place_samples(&view(1.0), &[Spine { points, ..Spine::default() }]);
            prop_assert!(placed.samples.len() <= LINE_SAMPLES as usize);
        }
    }
}
