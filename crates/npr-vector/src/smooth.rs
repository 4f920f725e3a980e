//! Smooths runs without shrinking them, and leaves out what is too short to read.
//!
//! A run is cut at its corners, which are found before anything moves; every section is resampled and
//! smoothed with its ends pinned by alternating steps in and out [Taubin 1995].

use crate::run::{Run, RunPoint, distance};
use npr_core::math;
use rayon::prelude::*;

/// Distance of samples, in pixels.
const STEP_PX: f64 = 1.5;

/// Rounds of smoothing: waves under about 20 samples disappear.
const ROUNDS: u32 = 16;

/// Step towards the mean of the neighbours, and the one back; their pass band ends at `1 / IN + 1 / OUT`, about 0.1.
const IN: f64 = 0.5;
const OUT: f64 = -0.526;

/// Over how much of a run on either side a corner is judged, in pixels.
const CORNER_PX: f64 = 8.0;

/// Cosine of the turn from which a point is a corner: about 45 degrees.
const CORNER_COS: f64 = 0.7;

/// Runs shorter than this are left out; up to the second length they are thinned, in pixels.
const SHORT_PX: [f64; 2] = [3.0, 10.0];

/// Smooths all runs in place and drops those too short to read; order is kept.
///
/// O(length of all runs).
pub fn smooth(runs: &mut Vec<Run>) {
    runs.retain(|run| run.closed || run.length() >= SHORT_PX[0]);
    runs.par_iter_mut().with_min_len(8).for_each(|run| {
        let length = run.length();
        run.points = smoothed(&run.points, run.closed);
        run.weight = weight_of(length);
    });
    runs.retain(|run| run.points.len() >= if run.closed { 3 } else { 2 });
}

/// Short lines are thinner, so that they do not pop in and out in motion.
fn weight_of(length: f64) -> f64 {
    let [from, to] = SHORT_PX.map(|v| v as f32);
    0.5 + 0.5 * f64::from(math::smoothstep(from, to, length as f32))
}

/// A polyline smoothed between its corners.
pub fn smoothed(points: &[RunPoint], closed: bool) -> Vec<RunPoint> {
    let samples = resampled(points, closed);
    if samples.len() < 4 {
        return samples;
    }
    let corners = corners(&samples, closed);
    let mut places: Vec<[f64; 2]> = samples.iter().map(|sample| sample.place).collect();
    if closed && corners.is_empty() {
        relax_loop(&mut places);
    } else {
        // Turn a closed run so that it starts at a corner, and close it there.
        let start = if closed { corners[0] } else { 0 };
        let count = places.len();
        let mut turned: Vec<[f64; 2]> = (0..count).map(|i| places[(start + i) % count]).collect();
        let mut pins: Vec<usize> = corners
            .iter()
            .map(|c| (c + count - start) % count)
            .collect();
        if closed {
            turned.push(turned[0]);
        }
        pins.extend([0, turned.len() - 1]);
        pins.sort_unstable();
        pins.dedup();
        for pair in pins.windows(2) {
            relax_section(&mut turned[pair[0]..=pair[1]]);
        }
        for i in 0..count {
            places[(start + i) % count] = turned[i];
        }
    }
    samples
        .iter()
        .zip(places)
        .map(|(sample, place)| RunPoint { place, ..*sample })
        .collect()
}

/// Points at equal distances along a polyline, its ends included.
fn resampled(points: &[RunPoint], closed: bool) -> Vec<RunPoint> {
    let mut path = points.to_vec();
    if closed {
        path.extend(points.first());
    }
    let length: f64 = path
        .windows(2)
        .map(|p| distance(p[0].place, p[1].place))
        .sum();
    let count = (length / STEP_PX).ceil().clamp(1.0, 1e7) as usize;
    let mut samples = vec![path[0]];
    let (mut passed, mut segment) = (0.0, 0);
    for k in 1..count {
        let target = length * k as f64 / count as f64;
        let mut span = distance(path[segment].place, path[segment + 1].place);
        while passed + span < target && segment + 2 < path.len() {
            passed += span;
            segment += 1;
            span = distance(path[segment].place, path[segment + 1].place);
        }
        let share = if span > 0.0 {
            ((target - passed) / span).clamp(0.0, 1.0)
        } else {
            0.0
        };
        samples.push(between(&path[segment], &path[segment + 1], share));
    }
    if !closed {
        samples.push(path[path.len() - 1]);
    }
    samples
}

fn between(a: &RunPoint, b: &RunPoint, share: f64) -> RunPoint {
    let mix = |p: f64, q: f64| p + (q - p) * share;
    let nearer = if share < 0.5 { a } else { b };
    RunPoint {
        place: [0, 1].map(|i| mix(a.place[i], b.place[i])),
        depth: mix(a.depth, b.depth),
        world: a.world.lerp(b.world, share),
        edge: nearer.edge,
        t: if a.edge == b.edge {
            mix(a.t.into(), b.t.into()) as f32
        } else {
            nearer.t
        },
    }
}

/// Samples where the run turns sharply: the sharpest within its neighbourhood.
fn corners(samples: &[RunPoint], closed: bool) -> Vec<usize> {
    let reach = (CORNER_PX / STEP_PX).round() as usize;
    let count = samples.len();
    if count < 2 * reach + 1 {
        return Vec::new();
    }
    let turn = |i: usize| -> f64 {
        let at = |k: usize| samples[k % count].place;
        if !closed && (i < reach || i + reach >= count) {
            return 1.0;
        }
        let (before, here, after) = (at(i + count - reach), at(i), at(i + reach));
        let (a, b) = (distance(before, here), distance(here, after));
        if a == 0.0 || b == 0.0 {
            return 1.0;
        }
        ((here[0] - before[0]) * (after[0] - here[0])
            + (here[1] - before[1]) * (after[1] - here[1]))
            / (a * b)
    };
    let turns: Vec<f64> = (0..count).map(turn).collect();
    let is_sharpest = |i: usize| {
        (1..=reach).all(|k| {
            let (before, after) = ((i + count - k) % count, (i + k) % count);
            turns[i] < turns[before] && turns[i] <= turns[after]
        })
    };
    (0..count)
        .filter(|i| turns[*i] < CORNER_COS && is_sharpest(*i))
        .collect()
}

/// Smooths between the first and the last place, which stay.
fn relax_section(places: &mut [[f64; 2]]) {
    let count = places.len();
    if count < 3 {
        return;
    }
    let mut moved = places.to_vec();
    for _ in 0..ROUNDS {
        for step in [IN, OUT] {
            for i in 1..count - 1 {
                moved[i] = stepped(places[i - 1], places[i], places[i + 1], step);
            }
            places.copy_from_slice(&moved);
        }
    }
}

/// Smooths a closed run.
fn relax_loop(places: &mut [[f64; 2]]) {
    let count = places.len();
    let mut moved = places.to_vec();
    for _ in 0..ROUNDS {
        for step in [IN, OUT] {
            for i in 0..count {
                let (before, after) = (places[(i + count - 1) % count], places[(i + 1) % count]);
                moved[i] = stepped(before, places[i], after, step);
            }
            places.copy_from_slice(&moved);
        }
    }
}

fn stepped(before: [f64; 2], here: [f64; 2], after: [f64; 2], step: f64) -> [f64; 2] {
    [0, 1].map(|i| here[i] + step * ((before[i] + after[i]) * 0.5 - here[i]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::testing::run_along;
    use proptest::prelude::*;

    fn circle(radius: f64, noise: f64) -> Vec<[f64; 2]> {
        let count = (radius * 2.0) as usize;
        (0..count)
            .map(|i| {
                let a = i as f64 * std::f64::consts::TAU / count as f64;
                let r = radius + if i % 2 == 0 { noise } else { -noise };
                [200.0 + r * a.cos(), 200.0 + r * a.sin()]
            })
            .collect()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        /// Zigzags of up to a pixel go, and the circle keeps its size.
        #[test]
        fn smoothing_does_not_shrink(radius in 20.0_f64..150.0, noise in 0.0_f64..1.0) {
            let run = Run { closed: true, ..run_along(1, &circle(radius, noise)) };
            let smooth = smoothed(&run.points, true);
            let mean = smooth
                .iter()
                .map(|p| distance(p.place, [200.0; 2]))
                .sum::<f64>() / smooth.len() as f64;
            prop_assert!((mean - radius).abs() < 0.25 + noise * 0.15, "{} for {}", mean, radius);
            for point in &smooth {
                let off = (distance(point.place, [200.0; 2]) - radius).abs();
                prop_assert!(off < 0.5 + noise * 0.6, "{}", off);
            }
        }

        /// Ends and corners stay where they are.
        #[test]
        fn ends_and_corners_are_pinned(turn in 1.2_f64..2.5, length in 30.0_f64..200.0) {
            let corner = [100.0, 100.0];
            let end = [100.0 + length * turn.cos(), 100.0 + length * turn.sin()];
            let run = run_along(1, &[[100.0 - length, 100.0], corner, end]);
            let smooth = smoothed(&run.points, false);
            prop_assert_eq!(smooth[0].place, [100.0 - length, 100.0]);
            prop_assert!(distance(smooth[smooth.len() - 1].place, end) < 1e-9);
            let nearest = smooth
                .iter()
                .map(|p| distance(p.place, corner))
                .fold(f64::MAX, f64::min);
            prop_assert!(nearest < 1.0, "{}", nearest);
        }
    }

    #[test]
    fn specks_are_left_out_and_short_lines_thinned() {
        let mut runs = vec![
            run_along(1, &[[0.0, 0.0], [2.0, 0.0]]),
            run_along(2, &[[0.0, 9.0], [6.0, 9.0]]),
            run_along(3, &[[0.0, 20.0], [90.0, 20.0]]),
        ];
        smooth(&mut runs);
        assert_eq!(runs.len(), 2);
        assert!(runs[0].weight < 0.95 && runs[1].weight == 1.0);
    }
}
