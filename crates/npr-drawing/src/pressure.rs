//! The width of strokes along themselves and over depth, by curves.

use crate::color_runs::point_between;
use npr_vector::mesh_lines::run::distance;
use npr_vector::stroke::{Stroke, StrokePoint};
use rayon::prelude::*;

/// Pixels between points where the width bends.
const STEP_PX: f64 = 4.0;

/// Most points added to a straight piece.
const STEPS_MAX: f64 = 64.0;

/// Share of the width by which a straight change may miss the curve.
const FLAT: f64 = 0.01;

/// A smooth curve through stops: it rises and falls only where they do.
///
/// Cubic pieces whose slopes are the harmonic means of the steps beside them [Fritsch, Butland 1984]. Before the first
/// stop and behind the last it is even.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Curve {
    /// Place, height and slope of every stop.
    stops: Vec<[f64; 3]>,
}

impl Curve {
    /// A curve through places with heights, sorted by place; of two at one place the curve steps from one to the other.
    /// Without any it is 1 everywhere.
    pub fn new(stops: &[[f64; 2]]) -> Self {
        let slope = |i: usize| {
            let [a, b] = [stops.get(i)?, stops.get(i + 1)?];
            (b[0] > a[0]).then(|| (b[1] - a[1]) / (b[0] - a[0]))
        };
        let with_slope = |i: usize| {
            let before = i.checked_sub(1).and_then(slope);
            let slope = match (before, slope(i)) {
                (Some(a), Some(b)) if a * b > 0.0 => 2.0 * a * b / (a + b),
                _ => 0.0,
            };
            [stops[i][0], stops[i][1], slope]
        };
        Self {
            stops: (0..stops.len()).map(with_slope).collect(),
        }
    }

    /// Whether it is 1 everywhere.
    pub fn is_one(&self) -> bool {
        self.stops.iter().all(|[_, height, _]| *height == 1.0)
    }

    /// Its height at a place.
    pub fn at(&self, place: f64) -> f64 {
        // Find the stops on both sides.
        let behind = self.stops.partition_point(|[at, ..]| *at <= place);
        let (Some(a), Some(b)) = (
            behind.checked_sub(1).map(|i| self.stops[i]),
            self.stops.get(behind),
        ) else {
            let nearest = self.stops.get(behind).or(self.stops.last());
            return nearest.map_or(1.0, |[_, height, _]| *height);
        };

        // Blend heights and slopes between them.
        let width = b[0] - a[0];
        let t = (place - a[0]) / width;
        let s = 1.0 - t;
        let heights = a[1] * s * s * (1.0 + 2.0 * t) + b[1] * t * t * (1.0 + 2.0 * s);
        heights + width * s * t * (a[2] * s - b[2] * t)
    }
}

/// What strokes are pressed by: factors on their width.
#[derive(Debug, Clone, PartialEq)]
pub struct Pressure {
    /// Along open strokes, from 0 at their start to 1 at their end; along parts of a line, from its start to its end.
    pub along: Curve,
    /// Over depth, from 0 at the first depth to 1 at the second, in scene units along the view axis.
    pub depth: Curve,
    /// These depths.
    pub range: [f64; 2],
}

impl Pressure {
    /// Whether it leaves every stroke as it is.
    pub fn is_even(&self) -> bool {
        self.along.is_one() && self.depth.is_one()
    }

    fn factor(&self, along: Option<f64>, depth: f64) -> f64 {
        let [near, far] = self.range;
        let of_depth = self.depth.at((depth - near) / (far - near));
        let factor = of_depth * along.map_or(1.0, |along| self.along.at(along));
        if factor.is_finite() {
            factor.max(0.0)
        } else {
            1.0
        }
    }
}

/// Multiplies the widths of the strokes for which `pressure_of` gives a pressure.
///
/// Points are added where the width bends; those that were there stay. Rings have no start, so pressure along strokes
/// leaves them alone. O(points), on all threads, with the same result for any number of them.
pub fn press_strokes<'a>(
    strokes: &mut [Stroke],
    pressure_of: impl Fn(&Stroke) -> Option<&'a Pressure> + Sync,
) {
    strokes.par_iter_mut().for_each(|stroke| {
        if let Some(pressure) = pressure_of(stroke).filter(|pressure| !pressure.is_even()) {
            press(stroke, pressure);
        }
    });
}

fn press(stroke: &mut Stroke, pressure: &Pressure) {
    // Know how far along every point lies.
    let length = stroke.length();
    let is_open = !stroke.closed && length.is_finite() && length > 0.0;
    let factor = |point: &StrokePoint, along: f64| {
        let share = is_open.then(|| along / length);
        let of_line = |share: f64| stroke.part.map_or(share, |part| part.share_at(share));
        let share = share.map(of_line);
        pressure.factor(share, point.depth)
    };
    let pressed = |point: StrokePoint, along: f64| StrokePoint {
        width: point.width * factor(&point, along),
        ..point
    };

    // Press every piece, and cut it where a straight change of width would miss the curve.
    let old = std::mem::take(&mut stroke.points);
    let mut points = Vec::with_capacity(old.len());
    let mut along = 0.0;
    let back = old.first().copied().filter(|_| stroke.closed);
    let ends = old.iter().skip(1).chain(&back);
    for (a, b) in old.iter().zip(ends) {
        let piece = distance(a.position, b.position);
        let steps = (piece / STEP_PX).ceil().clamp(1.0, STEPS_MAX) as usize;
        let at = |step: usize| {
            let share = step as f64 / steps as f64;
            (point_between(a, b, share), along + piece * share)
        };
        points.push(pressed(*a, along));
        let [from, to] = [0, steps].map(|step| {
            let (point, along) = at(step);
            factor(&point, along)
        });
        let bends = (1..steps).any(|step| {
            let share = step as f64 / steps as f64;
            let (point, along) = at(step);
            (factor(&point, along) - (from + (to - from) * share)).abs() > FLAT
        });
        if bends {
            points.extend(
                (1..steps)
                    .map(at)
                    .map(|(point, along)| pressed(point, along)),
            );
        }
        along += piece;
    }
    if !stroke.closed {
        points.extend(old.last().map(|last| pressed(*last, along)));
    }
    stroke.points = points;
}

#[cfg(test)]
mod tests {
    use super::*;
    use npr_vector::stroke::Kind;
    use proptest::prelude::*;

    fn stroke(places: &[[f64; 3]], closed: bool) -> Stroke {
        let points = places.iter().map(|[x, y, depth]| StrokePoint {
            position: [*x, *y],
            depth: *depth,
            width: 2.0,
            ..StrokePoint::default()
        });
        Stroke {
            id: 1,
            kind: Kind::Crease,
            occluders: 0,
            surface: 0,
            closed,
            part: None,
            points: points.collect(),
        }
    }

    fn along(stops: &[[f64; 2]]) -> Pressure {
        Pressure {
            along: Curve::new(stops),
            depth: Curve::default(),
            range: [0.0, 1.0],
        }
    }

    #[test]
    fn a_curve_meets_its_stops_and_is_even_beyond_them() {
        let curve = Curve::new(&[[0.2, 0.5], [0.5, 2.0], [0.9, 1.0]]);
        for (place, height) in [(0.2, 0.5), (0.5, 2.0), (0.9, 1.0), (-3.0, 0.5), (7.0, 1.0)] {
            assert!((curve.at(place) - height).abs() < 1e-12, "{place}");
        }
        assert_eq!(Curve::new(&[]).at(0.3), 1.0);
        let step = Curve::new(&[[0.5, 1.0], [0.5, 3.0]]);
        assert_eq!([step.at(0.49), step.at(0.51)], [1.0, 3.0]);
    }

    #[test]
    fn a_line_of_two_points_takes_the_curve() {
        let pressure = along(&[[0.0, 0.0], [0.5, 1.0], [1.0, 0.0]]);
        let mut strokes = [stroke(&[[0.0, 0.0, 1.0], [100.0, 0.0, 1.0]], false)];
        press_strokes(&mut strokes, |_| Some(&pressure));
        assert!(strokes[0].points.len() > 20);
        for point in &strokes[0].points {
            let want = 2.0 * pressure.along.at(point.position[0] / 100.0);
            assert!((point.width - want).abs() < 1e-9);
        }
    }

    #[test]
    fn far_lines_are_thinner() {
        let pressure = Pressure {
            along: Curve::default(),
            depth: Curve::new(&[[0.0, 1.5], [1.0, 0.5]]),
            range: [10.0, 20.0],
        };
        let mut strokes = [stroke(
            &[[0.0, 0.0, 10.0], [90.0, 0.0, 20.0], [0.0, 50.0, 30.0]],
            true,
        )];
        press_strokes(&mut strokes, |_| Some(&pressure));
        for point in &strokes[0].points {
            let want = 2.0 * pressure.depth.at((point.depth - 10.0) / 10.0);
            assert!((point.width - want).abs() < 1e-9, "rings are far as well");
        }
        assert!(
            strokes[0]
                .points
                .iter()
                .any(|point| (point.width - 3.0).abs() < 1e-9)
        );
    }

    #[test]
    fn rings_have_no_start() {
        let ring = stroke(&[[0.0, 0.0, 1.0], [90.0, 0.0, 1.0], [0.0, 50.0, 1.0]], true);
        let mut strokes = [ring.clone(), ring.clone()];
        let rising = along(&[[0.0, 0.3], [1.0, 2.0]]);
        press_strokes(&mut strokes, |_| Some(&rising));
        assert_eq!(strokes[0], ring);
    }

    proptest! {
        /// A curve goes nowhere but between the heights of the stops around, and has no jumps.
        #[test]
        fn curves_keep_between_their_stops(
            heights in prop::collection::vec(0f64..4.0, 2..7), place in 0f64..1.0,
        ) {
            let last = (heights.len() - 1) as f64;
            let stops: Vec<[f64; 2]> =
                heights.iter().enumerate().map(|(i, height)| [i as f64 / last, *height]).collect();
            let curve = Curve::new(&stops);
            let before = ((place * last) as usize).min(heights.len() - 2);
            let (low, high) = (heights[before].min(heights[before + 1]), heights[before].max(heights[before + 1]));
            let at = curve.at(place);
            prop_assert!(low - 1e-9 <= at && at <= high + 1e-9, "{} {} {}", low, at, high);
            prop_assert!((curve.at(place + 1e-6) - at).abs() < 1e-3);
        }

        /// Points that were there stay, in their order; whatever strokes hold, nothing breaks.
        #[test]
        fn points_stay_in_their_order(
            places in prop::collection::vec([any::<f64>(), any::<f64>(), any::<f64>()], 0..12), closed: bool,
        ) {
            let before = stroke(&places, closed);
            let mut strokes = [before.clone()];
            let uneven = along(&[[0.0, 0.1], [0.3, 2.0], [1.0, 0.5]]);
            press_strokes(&mut strokes, |_| Some(&uneven));
            let mut after = strokes[0].points.iter();
            let same = |a: &StrokePoint, b: &StrokePoint| {
                (0..2).all(|i| a.position[i].to_bits() == b.position[i].to_bits())
            };
            prop_assert!(before.points.iter().all(|old| after.any(|new| same(old, new))));
        }
    }
}
