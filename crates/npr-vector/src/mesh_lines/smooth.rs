//! Smooths runs without shrinking them, and leaves out what is too short to read.
//!
//! Corners are found before anything moves, and stay exactly where they are; every section between two is resampled and
//! smoothed with its ends pinned by alternating steps in and out [Taubin 1995].

use crate::mesh_lines::corner::{PINNED_COS, corners};
use crate::mesh_lines::run::{Run, RunPoint, SPECK_PX, distance, location_at};
use crate::project::Lens;
use npr_core::math;
use rayon::prelude::*;

/// Distance of samples, in pixels.
const STEP_PX: f64 = 1.5;

/// Rounds of smoothing: waves under about 20 samples disappear.
const ROUNDS: u32 = 16;

/// Step towards the mean of the neighbours, and the one back; their pass band ends at `1 / IN + 1 / OUT`, about 0.1.
const IN: f64 = 0.5;
const OUT: f64 = -0.526;

/// Runs up to this length are thinned, in pixels; not so parts cut at corners.
const SHORT_PX: f64 = 10.0;

/// Smooths all runs of a view in place and drops those too short to read; order is kept.
///
/// O(length of all runs).
pub fn smooth(runs: &mut Vec<Run>, lens: Lens) {
    runs.retain(|run| is_part(run) || run.length() >= SPECK_PX);
    runs.par_iter_mut().with_min_len(8).for_each(|run| {
        if !is_part(run) {
            run.weight = weight_of(run.length());
        }
        run.points = smoothed(&run.points, run.closed, lens);
    });
    runs.retain(|run| run.points.len() >= if run.closed { 3 } else { 2 });
}

fn is_part(run: &Run) -> bool {
    run.cut != [false; 2]
}

/// Short lines are thinner, so that they do not pop in and out in motion.
fn weight_of(length: f64) -> f64 {
    let [from, to] = [SPECK_PX, SHORT_PX].map(|v| v as f32);
    0.5 + 0.5 * f64::from(math::smoothstep(from, to, length as f32))
}

/// A polyline smoothed between its corners; its first point stays the first.
pub fn smoothed(points: &[RunPoint], closed: bool, lens: Lens) -> Vec<RunPoint> {
    if points.is_empty() {
        return Vec::new();
    }

    // Sample the line evenly between its corners.
    let corners: Vec<usize> = corners(points, closed, PINNED_COS)
        .iter()
        .map(|corner| corner.point)
        .collect();
    let (samples, pins) = resampled((points, closed), &corners, lens);
    if samples.len() < 4 {
        return samples;
    }

    // Relax the samples; corners stay.
    let mut places: Vec<[f64; 2]> = samples.iter().map(|sample| sample.place).collect();
    if closed && pins.is_empty() {
        relax_loop(&mut places);
    } else {
        relax_between(&mut places, closed, pins);
    }

    // Everything but the place stays.
    samples
        .iter()
        .zip(places)
        .map(|(sample, place)| RunPoint { place, ..*sample })
        .collect()
}

/// Smooths the sections between pins and the ends; a closed run has at least one pin.
fn relax_between(places: &mut [[f64; 2]], closed: bool, mut pins: Vec<usize>) {
    let count = places.len();
    // Turn a closed run so that it starts at a corner, and close it there.
    let start = if closed { pins[0] } else { 0 };
    let mut turned: Vec<[f64; 2]> = (0..count).map(|i| places[(start + i) % count]).collect();
    pins.iter_mut()
        .for_each(|pin| *pin = (*pin + count - start) % count);
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

/// Points at about equal distances along a polyline, its ends and corners included, and the indices of its corners.
fn resampled(
    (points, closed): (&[RunPoint], bool),
    corners: &[usize],
    lens: Lens,
) -> (Vec<RunPoint>, Vec<usize>) {
    let mut path = points.to_vec();
    if closed {
        path.extend(points.first());
    }
    let mut samples = vec![path[0]];
    let mut pins = Vec::with_capacity(corners.len());
    let mut from = 0;
    for corner in corners {
        push_even(&path[from..=*corner], &mut samples, lens);
        pins.push(samples.len() - 1);
        from = *corner;
    }
    push_even(&path[from..], &mut samples, lens);
    // The last sample of a closed run is its first; that of an open one lies on what the line has come along.
    if closed && samples.len() > 1 {
        samples.pop();
    }
    if let (false, Some(last)) = (closed, samples.last_mut()) {
        last.leaps = false;
        last.location = location_at(points, closed, points.len() - 1);
    }
    (samples, pins)
}

/// Adds points at equal distances along a polyline, its end included; `samples` holds its start already.
fn push_even(path: &[RunPoint], samples: &mut Vec<RunPoint>, lens: Lens) {
    // Choose a count of even steps.
    let steps = path
        .windows(2)
        .map(|pair| distance(pair[0].place, pair[1].place));
    let length: f64 = steps.sum();
    if path.len() < 2 || length == 0.0 {
        return;
    }
    let count = (length / STEP_PX).ceil().clamp(1.0, 1e7) as usize;
    let (mut passed, mut segment) = (0.0, 0);
    let mut leaps = Leaps::new(path);
    for k in 1..count {
        // Walk to the next step.
        let target = length * k as f64 / count as f64;
        let mut span = distance(path[segment].place, path[segment + 1].place);
        while passed + span < target && segment + 2 < path.len() {
            passed += span;
            segment += 1;
            span = distance(path[segment].place, path[segment + 1].place);
        }

        // Sample there, and carry over the leaps that were passed.
        let share = if span > 0.0 {
            ((target - passed) / span).clamp(0.0, 1.0)
        } else {
            0.0
        };
        mark_leap(samples, leaps.is_any_before(segment as f64 + share));
        samples.push(between(&path[segment], &path[segment + 1], share, lens));
    }
    mark_leap(samples, leaps.is_any_before((path.len() - 1) as f64));
    samples.extend(path.last());
}

/// Sets whether the last sample leaps to the next one in the world.
fn mark_leap(samples: &mut [RunPoint], leaps: bool) {
    if let Some(last) = samples.last_mut() {
        last.leaps = leaps;
    }
}

/// Finds, in order, where a polyline moves to another edge or face: at points, and in the middle of pieces that leap.
struct Leaps<'a> {
    path: &'a [RunPoint],
    /// Place up to which such moves were looked for, in pieces from the start.
    station: f64,
}

impl<'a> Leaps<'a> {
    fn new(path: &'a [RunPoint]) -> Self {
        Self { path, station: 0.0 }
    }

    /// Whether the line moves to another edge or face between that place and `station`: then no straight way in the
    /// world lies between the two.
    fn is_any_before(&mut self, station: f64) -> bool {
        let (from, to) = (self.station, station);
        self.station = station;
        let pieces = from as usize..(to.ceil() as usize).min(self.path.len() - 1);
        pieces.into_iter().any(|i| {
            let (at, middle) = (i as f64, i as f64 + 0.5);
            let changes = i > 0 && self.path[i].location != self.path[i - 1].location;
            changes && from < at && at < to || self.path[i].leaps && from < middle && middle <= to
        })
    }
}

/// A point a share of the way from a point of a run to the next, as the picture shows it.
pub(crate) fn between(a: &RunPoint, b: &RunPoint, share: f64, lens: Lens) -> RunPoint {
    let mix = |p: f64, q: f64| p + (q - p) * share;
    let along = lens.world_share(share, [a.depth, b.depth]);
    let mix_in_world = |p: f64, q: f64| p + (q - p) * along;
    let nearer = if share < 0.5 { a } else { b };

    // Across a leap nothing is mixed but what the picture shows.
    if a.leaps {
        return RunPoint {
            place: [0, 1].map(|i| mix(a.place[i], b.place[i])),
            depth: mix_in_world(a.depth, b.depth),
            leaps: share < 0.5,
            ..*nearer
        };
    }
    RunPoint {
        place: [0, 1].map(|i| mix(a.place[i], b.place[i])),
        depth: mix_in_world(a.depth, b.depth),
        world: a.world.lerp(b.world, along),
        edge: nearer.edge,
        t: if a.edge == b.edge {
            mix_in_world(a.t.into(), b.t.into()) as f32
        } else {
            nearer.t
        },
        location: a.location,
        leaps: false,
    }
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
    use crate::mesh_lines::corner::split;
    use crate::mesh_lines::run::testing::{ring, run_along};
    use glam::DVec3;
    use proptest::prelude::*;

    const EVEN: Lens = Lens::Parallel;

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
            let smooth = smoothed(&run.points, true, EVEN);
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

        /// A point of a long piece is the one that the picture shows there.
        #[test]
        fn points_of_long_pieces_lie_where_they_are_seen(
            from in prop::array::uniform2(-5.0_f64..5.0), to in prop::array::uniform2(-5.0_f64..5.0),
            depths in prop::array::uniform2(1.0_f64..50.0), share in 0.0_f64..1.0,
        ) {
            let seen = |world: DVec3| [world.x, world.y].map(|v| 100.0 * v / world.z);
            let mut run = run_along(1, &[[0.0; 2]; 2]);
            for (point, (at, depth)) in run.points.iter_mut().zip([from, to].into_iter().zip(depths)) {
                point.world = DVec3::new(at[0], at[1], depth);
                (point.place, point.depth) = (seen(point.world), depth);
            }
            let between = between(&run.points[0], &run.points[1], share, Lens::Perspective);
            prop_assert!(distance(seen(between.world), between.place) < 1e-6);
            prop_assert!((between.world.z - between.depth).abs() < 1e-9);
            let evenly = super::between(&run.points[0], &run.points[1], share, EVEN);
            prop_assert!((evenly.world - run.points[0].world.lerp(run.points[1].world, share)).length() < 1e-9);
        }

        /// Ends and corners stay where they are.
        #[test]
        fn ends_and_corners_are_pinned(turn in 1.2_f64..2.5, length in 30.0_f64..200.0) {
            let corner = [100.0, 100.0];
            let end = [100.0 + length * turn.cos(), 100.0 + length * turn.sin()];
            let run = run_along(1, &[[100.0 - length, 100.0], corner, end]);
            let smooth = smoothed(&run.points, false, EVEN);
            prop_assert_eq!(smooth[0].place, [100.0 - length, 100.0]);
            prop_assert!(distance(smooth[smooth.len() - 1].place, end) < 1e-9);
            let nearest = smooth
                .iter()
                .map(|p| distance(p.place, corner))
                .fold(f64::MAX, f64::min);
            prop_assert_eq!(nearest, 0.0);
        }

        /// All corners of a polygon stay, and what is smoothed again stays too.
        #[test]
        fn polygons_keep_their_corners(count in 3_usize..7, radius in 20.0_f64..200.0, turned in 0_usize..7) {
            let mut run = ring(1, radius, count);
            run.points.rotate_left(turned % count);
            let smooth = smoothed(&smoothed(&run.points, true, EVEN), true, EVEN);
            prop_assert_eq!(smooth[0].place, run.points[0].place);
            for corner in &run.points {
                prop_assert!(smooth.iter().any(|p| p.place == corner.place), "{:?}", corner.place);
            }
        }

        /// A circle keeps its size.
        #[test]
        fn circles_keep_their_size(radius in 10.0_f64..150.0) {
            let run = ring(1, radius, 40 + (radius * 3.0) as usize);
            let smooth = smoothed(&smoothed(&run.points, true, EVEN), true, EVEN);
            for point in &smooth {
                let off = distance(point.place, [200.0; 2]) - radius;
                prop_assert!(off.abs() < 0.1, "{}", off);
            }
        }

        /// Parts cut at a corner still meet there exactly after smoothing, however short they are.
        #[test]
        fn parts_meet_where_they_were_cut(turn in 1.1_f64..2.5, length in 8.5_f64..100.0) {
            let corner = [100.0, 100.0];
            let end = [100.0 + length * turn.cos(), 100.0 + length * turn.sin()];
            let run = run_along(1, &[[100.0 - length, 100.0], corner, end]);
            let mut parts = split(vec![run], 1.0);
            prop_assert_eq!(parts.len(), 2);
            smooth(&mut parts, EVEN);
            prop_assert_eq!(parts.len(), 2);
            let last = parts[0].points.len() - 1;
            prop_assert_eq!(parts[0].points[last].place, corner);
            prop_assert_eq!(parts[1].points[0].place, corner);
            prop_assert!(parts.iter().all(|part| part.weight == 1.0));
        }
    }

    #[test]
    fn specks_are_left_out_and_short_lines_thinned() {
        let mut runs = vec![
            run_along(1, &[[0.0, 0.0], [2.0, 0.0]]),
            run_along(2, &[[0.0, 9.0], [6.0, 9.0]]),
            run_along(3, &[[0.0, 20.0], [90.0, 20.0]]),
        ];
        smooth(&mut runs, EVEN);
        assert_eq!(runs.len(), 2);
        assert!(runs[0].weight < 0.95 && runs[1].weight == 1.0);
    }
}
