//! Tapers of made-up strokes, and ends that meet lines by trial of every pair.

use super::*;
use npr_vector::stroke::Kind;
use proptest::prelude::*;

const SIZE: [u32; 2] = [200, 160];

const PLAIN: Taper = Taper {
    lengths_px: [20.0, 30.0],
    share: 0.5,
    tip: 0.0,
    at_all_ends: false,
    short_px: 0.0,
};

fn stroke(places: &[[f64; 2]], width: f64) -> Stroke {
    let points = places.iter().map(|position| StrokePoint {
        position: *position,
        width,
        depth: position[0],
        u: position[1],
        ..StrokePoint::default()
    });
    Stroke {
        id: 0,
        kind: Kind::Contour,
        occluders: 0,
        surface: 0,
        closed: false,
        part: None,
        points: points.collect(),
    }
}

fn tapered(mut strokes: Vec<Stroke>, taper: &Taper) -> Vec<Stroke> {
    taper_strokes(&mut strokes, SIZE, |_| Some(taper), |_| [false; 2]);
    strokes
}

/// Widths at the start and at the end.
fn tips(stroke: &Stroke) -> [f64; 2] {
    [stroke.points.first(), stroke.points.last()].map(|point| point.unwrap().width)
}

#[test]
fn a_lone_stroke_runs_to_points_and_is_whole_between() {
    let line = tapered(vec![stroke(&[[20.0, 50.0], [180.0, 50.0]], 8.0)], &PLAIN);
    let points = &line[0].points;
    assert_eq!(tips(&line[0]), [0.0, 0.0]);
    for point in points {
        let [from_start, from_end] = [point.position[0] - 20.0, 180.0 - point.position[0]];
        assert_eq!(
            point.width == 8.0,
            from_start >= 20.0 && from_end >= 30.0,
            "{point:?}"
        );
        // What lies between points is between them in everything.
        assert!((point.depth - point.position[0]).abs() < 1e-9 && point.u == 50.0);
    }
    // A quarter of the way along the taper 7/16 of the width are there: x (2 - x).
    let quarter = points
        .iter()
        .find(|point| (point.position[0] - 25.0).abs() < 1e-9);
    assert!((quarter.unwrap().width - 8.0 * 7.0 / 16.0).abs() < 1e-9);
}

#[test]
fn a_line_that_ends_on_another_keeps_its_width_there() {
    let bar = stroke(&[[100.0, 20.0], [100.0, 140.0]], 6.0);
    for (away, is_met) in [
        (0.0, true),
        (2.9, true),
        (8.9, true),
        (9.1, false),
        (20.0, false),
    ] {
        let line = stroke(&[[20.0, 80.0], [100.0 - away, 80.0]], 6.0);
        let drawn = tapered(vec![bar.clone(), line], &PLAIN);
        assert_eq!(
            tips(&drawn[1]),
            [0.0, if is_met { 6.0 } else { 0.0 }],
            "{away}"
        );
        assert_eq!(tips(&drawn[0]), [0.0; 2]);
    }
    // A line that nobody sees holds no pen.
    let hidden = Stroke {
        occluders: 1,
        ..bar
    };
    let line = stroke(&[[20.0, 80.0], [100.0, 80.0]], 6.0);
    let drawn = tapered(vec![hidden.clone(), line], &PLAIN);
    assert_eq!(tips(&drawn[1]), [0.0; 2]);
    assert_eq!(drawn[0], hidden);
}

#[test]
fn lines_that_go_on_taper_only_where_all_ends_do() {
    let first = stroke(&[[20.0, 80.0], [100.0, 80.0]], 6.0);
    let second = stroke(&[[100.0, 80.0], [100.0, 30.0]], 6.0);
    let both = vec![first, second];
    let drawn = tapered(both.clone(), &PLAIN);
    assert_eq!([tips(&drawn[0]), tips(&drawn[1])], [[0.0, 6.0], [6.0, 0.0]]);
    let all = Taper {
        at_all_ends: true,
        ..PLAIN
    };
    let drawn = tapered(both, &all);
    assert_eq!([tips(&drawn[0]), tips(&drawn[1])], [[0.0; 2]; 2]);
}

#[test]
fn a_line_that_runs_into_itself_keeps_its_width_there() {
    // A hook whose end comes back to its own shaft.
    let hook = [
        [20.0, 80.0],
        [120.0, 80.0],
        [120.0, 120.0],
        [60.0, 120.0],
        [60.0, 80.0],
    ];
    let drawn = tapered(vec![stroke(&hook, 4.0)], &PLAIN);
    assert_eq!(tips(&drawn[0]), [0.0, 4.0]);
}

#[test]
fn lines_that_the_border_cuts_keep_their_width_there() {
    let drawn = tapered(vec![stroke(&[[0.0, 80.0], [100.0, 80.0]], 4.0)], &PLAIN);
    assert_eq!(tips(&drawn[0]), [4.0, 0.0]);
}

#[test]
fn rings_and_lines_of_others_stay() {
    let ring = Stroke {
        closed: true,
        ..stroke(&[[50.0, 50.0], [90.0, 50.0], [70.0, 90.0]], 4.0)
    };
    let line = stroke(&[[20.0, 20.0], [60.0, 20.0]], 4.0);
    let before = vec![ring, line];
    let mut after = before.clone();
    taper_strokes(&mut after, SIZE, |_| None, |_| [false; 2]);
    assert_eq!(after, before);
    assert_eq!(tapered(before.clone(), &PLAIN)[0], before[0]);
}

#[test]
fn short_lines_fade_and_specks_are_gone_where_they_meet_nothing() {
    let fading = Taper {
        lengths_px: [0.0; 2],
        short_px: 20.0,
        ..PLAIN
    };
    let line = |length: f64| stroke(&[[60.0, 80.0], [60.0 + length, 80.0]], 4.0);
    let width = |strokes: Vec<Stroke>| tapered(strokes, &fading).first().map(|s| s.points[0].width);
    for (length, left) in [
        (30.0, Some(4.0)),
        (20.0, Some(4.0)),
        (15.0, Some(2.0)),
        (9.9, None),
    ] {
        assert_eq!(width(vec![line(length)]), left, "{length}");
    }
    // A short line that holds others together stays, and so does one that nobody sees.
    let bar = stroke(&[[60.0, 20.0], [60.0, 140.0]], 4.0);
    assert_eq!(width(vec![line(5.0), bar]), Some(4.0));
    assert_eq!(
        width(vec![Stroke {
            occluders: 1,
            ..line(5.0)
        }]),
        Some(4.0)
    );
    // Rings are as long as they are round.
    let ring = |side: f64| {
        let corners = [
            [60.0, 60.0],
            [60.0 + side, 60.0],
            [60.0 + side, 60.0 + side],
            [60.0, 60.0 + side],
        ];
        Stroke {
            closed: true,
            ..stroke(&corners, 4.0)
        }
    };
    assert_eq!(
        [5.0, 2.0].map(|side| width(vec![ring(side)])),
        [Some(4.0), None]
    );
}

fn place() -> impl Strategy<Value = [f64; 2]> {
    prop::array::uniform2(2.0..150.0f64)
}

fn strokes() -> impl Strategy<Value = Vec<Stroke>> {
    let one = (
        prop::collection::vec(place(), 2..7),
        0.1..20.0f64,
        0u32..4,
        0u32..4,
    );
    let one = one.prop_map(|(places, width, closed, occluders)| Stroke {
        closed: closed == 0 && places.len() > 2,
        occluders: u32::from(occluders == 0),
        ..stroke(&places, width)
    });
    prop::collection::vec(one, 1..12)
}

/// Pixels by which a place found by trial may lie farther away than the nearest one.
const TRIAL_PX: f64 = 0.1;

/// Whether anything comes within its reach of an end, and `slack` pixels more, by trial of every piece of every stroke.
fn is_met(strokes: &[Stroke], (number, is_end): (usize, bool), slack: f64) -> bool {
    let own = &strokes[number];
    let point = if is_end {
        own.points.last()
    } else {
        own.points.first()
    }
    .unwrap();
    strokes
        .iter()
        .enumerate()
        .filter(|(_, other)| other.is_visible())
        .any(|(other, stroke)| {
            let mut along = 0.0;
            let count = stroke.points.len();
            (0..count - usize::from(!stroke.closed)).any(|piece| {
                let [a, b] = [&stroke.points[piece], &stroke.points[(piece + 1) % count]];
                let touch = 3.0 * (0.5 * a.width).max(1.0);
                let length = distance(a.position, b.position);
                let from_end = if is_end {
                    own.length() - along - length
                } else {
                    along
                };
                along += length;
                // The nearest of many places on the piece, by trial.
                let nearest = (0..=2000).map(|i| {
                    let share = f64::from(i) / 2000.0;
                    let at =
                        [0, 1].map(|k| a.position[k] + (b.position[k] - a.position[k]) * share);
                    distance(point.position, at)
                });
                let is_near = nearest.fold(f64::MAX, f64::min) <= touch + slack;
                is_near && (other != number || stroke.closed || from_end >= 4.0 * touch)
            })
        })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn ends_meet_what_every_pair_says(strokes in strokes()) {
        let lengths: Vec<f64> = strokes.iter().map(Stroke::length).collect();
        let found = met_ends(&strokes, &lengths, SIZE);
        for (number, stroke) in strokes.iter().enumerate() {
            if stroke.closed || !stroke.is_visible() {
                continue;
            }
            for (side, met) in found[number].into_iter().enumerate() {
                let end = (number, side == 1);
                prop_assert!(met || !is_met(&strokes, end, 0.0), "{end:?}");
                prop_assert!(!met || is_met(&strokes, end, TRIAL_PX), "{end:?}");
            }
        }
    }

    #[test]
    fn widths_only_shrink_and_points_stay(
        strokes in strokes(), lengths_px in prop::array::uniform2(0.0..80.0f64), share in 0.0..0.6f64,
        tip in 0.0..1.0f64, at_all_ends: bool,
    ) {
        let taper = Taper {
            lengths_px,
            share,
            tip,
            at_all_ends,
            short_px: 0.0,
        };
        let after = tapered(strokes.clone(), &taper);
        for (old, new) in strokes.iter().zip(&after) {
            let width = old.points[0].width;
            prop_assert!(new.points.iter().all(|p| p.width <= width && p.width >= tip * width - 1e-9));
            // Every point is still there, in order, and the line is as long as before.
            let mut left = new.points.iter();
            prop_assert!(old.points.iter().all(|p| left.any(|q| q.position == p.position)));
            prop_assert!((new.length() - old.length()).abs() < 1e-6);
            // The middle is whole as far as neither taper reaches.
            let reach = lengths_px.map(|px| px.min(share.min(0.5) * old.length()));
            let mut along = 0.0;
            for (i, point) in new.points.iter().enumerate() {
                along += if i > 0 { distance(new.points[i - 1].position, point.position) } else { 0.0 };
                let is_beyond = along > reach[0] + 1e-6 && old.length() - along > reach[1] + 1e-6;
                prop_assert!(!is_beyond || point.width == width);
            }
        }
    }

    #[test]
    fn nothing_hostile_stops_it(
        places in prop::collection::vec(prop::array::uniform2(prop_oneof![
            any::<f64>(), Just(f64::NAN), Just(f64::INFINITY), -1e7..1e7f64, Just(50.0),
        ]), 0..6),
        width in prop_oneof![any::<f64>(), Just(1e30), Just(f64::NAN)],
        length in prop_oneof![any::<f64>(), 0.0..9.0f64],
    ) {
        let taper = Taper { lengths_px: [length; 2], ..PLAIN };
        let line = stroke(&[[10.0, 50.0], [90.0, 50.0]], 3.0);
        let drawn = tapered(vec![stroke(&places, width), line], &taper);
        prop_assert!(drawn[1].points.len() <= 2 + 2 * STEPS);
    }
}
