//! Parts of strokes against walks along them in small steps.

use super::*;
use crate::test_strokes::{ring_of, stroke_of, strokes};
use proptest::prelude::*;

/// The point a way along a stroke, by adding up its pieces.
fn walked(stroke: &Stroke, mut way: f64) -> [f64; 2] {
    let mut points: Vec<[f64; 2]> = stroke.points.iter().map(|point| point.position).collect();
    points.extend(stroke.closed.then(|| points[0]));
    for pair in points.windows(2) {
        let length = distance(pair[0], pair[1]);
        if way <= length {
            return [0, 1].map(|i| pair[0][i] + (pair[1][i] - pair[0][i]) * way / length);
        }
        way -= length;
    }
    points[points.len() - 1]
}

fn length_of(points: &[StrokePoint]) -> f64 {
    let steps = points.windows(2);
    steps
        .map(|pair| distance(pair[0].position, pair[1].position))
        .sum()
}

#[test]
fn ends_run_on_straight_and_are_cut_off() {
    let bent = stroke_of(&[[10.0, 90.0], [10.0, 50.0], [70.0, 50.0]]);
    let line = Measured::new(&bent).unwrap();
    let places = |by| {
        let points = line.with_ends(by);
        let rounded = |point: &StrokePoint| point.position.map(|at| (at * 1e6).round() / 1e6);
        points.iter().map(rounded).collect::<Vec<[f64; 2]>>()
    };
    assert_eq!(
        places([5.0, 7.0]),
        [
            [10.0, 95.0],
            [10.0, 90.0],
            [10.0, 50.0],
            [70.0, 50.0],
            [77.0, 50.0]
        ]
    );
    assert_eq!(
        places([-5.0, -7.0]),
        [[10.0, 85.0], [10.0, 50.0], [63.0, 50.0]]
    );
    assert_eq!(
        places([0.0, 0.0]),
        [[10.0, 90.0], [10.0, 50.0], [70.0, 50.0]]
    );
    // Texture runs on by as many pixels.
    let us: Vec<f64> = line.with_ends([5.0, 7.0]).iter().map(|p| p.u).collect();
    assert_eq!([us[0], us[4]], [us[1] - 5.0, us[3] + 7.0]);
}

#[test]
fn an_end_that_turns_back_onto_itself_has_no_way_on() {
    let back = stroke_of(&[[10.0, 10.0], [13.0, 10.0], [10.0, 10.0]]);
    let points = Measured::new(&back).unwrap().with_ends([5.0, 5.0]);
    assert_eq!(points, back.points);
}

#[test]
fn texture_goes_on_through_the_start_of_a_ring() {
    let ring = ring_of(&[[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]]);
    let line = Measured::new(&ring).unwrap();
    for part in [line.part(-15.0, 5.0), line.part(25.0, 45.0)] {
        let steps = part.windows(2);
        assert!(
            steps
                .map(|two| two[1].u - two[0].u)
                .all(|step| (step - 5.0).abs() < 1e-9 || (step - 10.0).abs() < 1e-9)
        );
        assert_eq!(part[0].position, [5.0, 10.0]);
        assert_eq!(part.last().unwrap().position, [5.0, 0.0]);
    }
}

#[test]
fn what_has_no_length_or_far_too_much_is_left_alone() {
    let at = |x: f64| Measured::new(&stroke_of(&[[0.0, 0.0], [x, 0.0]])).is_some();
    assert_eq!(
        [0.0, 1.0, 1e6, 1e7, f64::NAN, f64::INFINITY].map(at),
        [false, true, true, false, false, false]
    );
    assert!(Measured::new(&stroke_of(&[])).is_none());
    assert!(Measured::new(&ring_of(&[[3.0, 3.0]])).is_none());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    #[test]
    fn parts_are_as_long_as_asked_and_lie_on_the_line(
        strokes in strokes(), shares in prop::array::uniform2(-1.0..2.0f64),
    ) {
        for stroke in &strokes {
            let line = Measured::new(stroke).unwrap();
            let length = stroke.length();
            prop_assert!((line.length() - length).abs() < 1e-9 * length);
            let limit = |share: f64| match stroke.closed {
                true => share,
                false => share.clamp(0.0, 1.0),
            };
            let mut ways = shares.map(|share| limit(share) * length);
            ways.sort_by(f64::total_cmp);
            // At most one round, through one start.
            ways[1] = ways[1].min(ways[0] + length);
            if ways[1] - ways[0] < 0.01 || ways[0] < 0.0 && ways[1] > length || ways[0] >= length {
                continue;
            }
            if ways[1] <= 0.0 {
                continue;
            }
            let part = line.part(ways[0], ways[1]);
            prop_assert!((length_of(&part) - (ways[1] - ways[0])).abs() < 0.01);
            let ends = [&part[0], &part[part.len() - 1]];
            for (end, way) in ends.into_iter().zip(ways) {
                let is_within = (0.0..=length).contains(&way);
                let place = walked(stroke, if is_within { way } else { way.rem_euclid(length) });
                prop_assert!(distance(end.position, place) < 0.01, "{:?} {:?} {:?}", end, place, way);
            }
            prop_assert!(part.windows(2).all(|two| two[0].position != two[1].position));
        }
    }

    #[test]
    fn steps_are_short_and_keep_every_point(strokes in strokes(), step in 0.3..50.0f64) {
        for stroke in &strokes {
            let steps = Measured::new(stroke).unwrap().in_steps(step);
            let mut places = steps.iter().map(|(_, point)| point.position);
            prop_assert!(stroke.points.iter().all(|point| places.any(|place| place == point.position)));
            for two in steps.windows(2) {
                let apart = distance(two[0].1.position, two[1].1.position);
                prop_assert!(apart <= step + 1e-9 && (apart - (two[1].0 - two[0].0)).abs() < 1e-6);
            }
            let most = stroke.length() / step + stroke.points.len() as f64 + 1.0;
            prop_assert!(steps.len() as f64 <= most);
        }
    }
}
