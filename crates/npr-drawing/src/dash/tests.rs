//! Dashes of made-up strokes, looked at by the places that they ink.

use super::*;
use crate::test_strokes::{
    apart, distance_from, hostile_length, hostile_places, ring_of, stroke_of, strokes,
};
use proptest::prelude::*;

fn dashed(mut strokes: Vec<Stroke>, pattern_px: &[f64], fit: bool) -> Vec<Stroke> {
    let dash = Dash {
        pattern_px: pattern_px.to_vec(),
        fit,
        by_texture: false,
    };
    cut_to_dashes(&mut strokes, |_| Some(&dash));
    strokes
}

fn line(length: f64) -> Stroke {
    stroke_of(&[
        [20.0, 50.0],
        [20.0 + 0.3 * length, 50.0],
        [20.0 + length, 50.0],
    ])
}

/// Where a straight line from x = 20 is inked, in hundredths of a pixel.
fn inked(strokes: &[Stroke]) -> Vec<[i64; 2]> {
    let at = |point: &StrokePoint| ((point.position[0] - 20.0) * 100.0).round() as i64;
    strokes
        .iter()
        .map(|stroke| [at(&stroke.points[0]), at(stroke.points.last().unwrap())])
        .collect()
}

use npr_vector::stroke::StrokePoint;

#[test]
fn an_unstretched_pattern_begins_at_the_start_and_breaks_off() {
    let cut = |pattern: &[f64]| inked(&dashed(vec![line(30.0)], pattern, false));
    assert_eq!(cut(&[8.0, 4.0]), [[0, 800], [1200, 2000], [2400, 3000]]);
    // An odd number of lengths counts twice.
    assert_eq!(cut(&[7.0]), [[0, 700], [1400, 2100], [2800, 3000]]);
    // Dots are short pieces; the last one would lie at 32.
    assert_eq!(
        cut(&[0.0, 8.0]),
        [[0, 10], [795, 805], [1595, 1605], [2395, 2405]]
    );
    // Without a gap between them dashes are one.
    assert_eq!(cut(&[4.0, 0.0, 4.0, 7.0]), [[0, 800], [1500, 2300]]);
}

/// Dashes that lie by the texture, of a straight line whose `u` has these values at its start, after 30 % of it and at
/// its end.
fn by_texture(length: f64, pattern_px: &[f64], u: [f64; 3]) -> Vec<[i64; 2]> {
    let dash = Dash {
        pattern_px: pattern_px.to_vec(),
        fit: false,
        by_texture: true,
    };
    let mut stroke = line(length);
    stroke
        .points
        .iter_mut()
        .zip(u)
        .for_each(|(point, u)| point.u = u);
    let mut strokes = vec![stroke];
    cut_to_dashes(&mut strokes, |_| Some(&dash));
    inked(&strokes)
}

#[test]
fn a_pattern_lies_where_the_texture_does() {
    let cut = |u| by_texture(30.0, &[8.0, 4.0], u);
    assert_eq!(
        cut([0.0, 9.0, 30.0]),
        [[0, 800], [1200, 2000], [2400, 3000]]
    );
    assert_eq!(
        cut([5.0, 14.0, 35.0]),
        [[0, 300], [700, 1500], [1900, 2700]]
    );
    assert_eq!(
        cut([-2.0, 7.0, 28.0]),
        [[200, 1000], [1400, 2200], [2600, 3000]]
    );

    // A texture that runs the other way, and two that meet in a seam of no ink.
    assert_eq!(
        cut([30.0, 21.0, 0.0]),
        [[0, 600], [1000, 1800], [2200, 3000]]
    );
    assert_eq!(cut([0.0, 900.0, 921.0]), [[900, 1700], [2100, 2900]]);
    assert_eq!(
        by_texture(30.0, &[0.0, 8.0], [4.0, 13.0, 34.0]),
        [[395, 405], [1195, 1205], [1995, 2005], [2795, 2805]]
    );
}

#[test]
fn a_stretched_pattern_begins_and_ends_with_half_a_dash() {
    let cut = |length: f64, pattern: &[f64]| inked(&dashed(vec![line(length)], pattern, true));
    assert_eq!(
        cut(30.0, &[6.0, 4.0]),
        [[0, 300], [700, 1300], [1700, 2300], [2700, 3000]]
    );
    // 27 pixels are nearest to three patterns, each nine long.
    assert_eq!(
        cut(27.0, &[6.0, 4.0]),
        [[0, 270], [630, 1170], [1530, 2070], [2430, 2700]]
    );
    // Dots at both ends.
    assert_eq!(cut(20.0, &[0.0, 9.0]), [[0, 10], [995, 1005], [1990, 2000]]);
    // Dashes and dots.
    assert_eq!(
        cut(32.0, &[8.0, 4.0, 0.0, 4.0]),
        [
            [0, 400],
            [795, 805],
            [1200, 2000],
            [2395, 2405],
            [2800, 3200]
        ]
    );
}

#[test]
fn a_ring_has_whole_patterns_and_one_dash_through_its_start() {
    let square = [[0.0, 0.0], [25.0, 0.0], [25.0, 25.0], [0.0, 25.0]];
    let dashes = dashed(vec![ring_of(&square)], &[6.0, 4.0], true);
    assert_eq!(dashes.len(), 10);
    assert!(
        dashes
            .iter()
            .all(|dash| (dash.length() - 6.0).abs() < 1e-9 && !dash.closed)
    );
    let first: Vec<[f64; 2]> = dashes[0].points.iter().map(|p| p.position).collect();
    assert_eq!(first, [[0.0, 3.0], [0.0, 0.0], [3.0, 0.0]]);
    // Unstretched, the dash that breaks off at 100 and the one at 0 are one: 9 + 12 pixels.
    let dashes = dashed(vec![ring_of(&square)], &[12.0, 1.0], false);
    let lengths: Vec<f64> = dashes.iter().map(|dash| dash.length().round()).collect();
    assert_eq!(lengths, [21.0, 12.0, 12.0, 12.0, 12.0, 12.0, 12.0]);
}

#[test]
fn what_has_no_room_for_a_pattern_stays_whole() {
    let whole = |length: f64, pattern: &[f64]| {
        [true, false].map(|fit| dashed(vec![line(length)], pattern, fit) == [line(length)])
    };
    assert_eq!(whole(9.9, &[6.0, 4.0]), [true; 2], "shorter than a pattern");
    assert_eq!(whole(10.0, &[6.0, 4.0]), [false; 2]);
    for none in [
        &[][..],
        &[0.1, 0.1],
        &[0.0, 0.0],
        &[5.0, 0.0],
        &[5.0, -1.0],
        &[f64::NAN, 4.0],
        &[1e30, 4.0],
        &[f64::INFINITY, 4.0],
    ] {
        assert_eq!(whole(90.0, none), [true; 2], "{none:?}");
    }
    let hidden = Stroke {
        occluders: 1,
        ..line(90.0)
    };
    assert_eq!(
        dashed(vec![hidden.clone()], &[6.0, 4.0], true),
        vec![hidden]
    );
}

/// What is between points is between them in everything, so tapers go on over dashes.
#[test]
fn dashes_keep_the_width_of_their_place() {
    let mut tapered = line(100.0);
    for point in &mut tapered.points {
        point.width = point.position[0] - 20.0;
    }
    for point in dashed(vec![tapered], &[6.0, 4.0], true)
        .iter()
        .flat_map(|dash| &dash.points)
    {
        assert!((point.width - (point.position[0] - 20.0)).abs() < 1e-9);
        assert!((point.u - (point.position[0] - 20.0)).abs() < 1e-9);
    }
}

fn pattern() -> impl Strategy<Value = Vec<f64>> {
    // Gaps are longer than a dot, or two dots could be one.
    let pair = (0.0..30.0f64, 0.5..20.0f64);
    let pairs = prop::collection::vec(pair, 1..5);
    pairs.prop_map(|pairs| {
        pairs
            .into_iter()
            .flat_map(|(ink, gap)| [ink, gap])
            .collect()
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    #[test]
    fn the_share_of_ink_is_that_of_the_pattern(strokes in strokes(), pattern in pattern()) {
        let period: f64 = pattern.iter().sum();
        let ink: f64 = pattern.iter().step_by(2).sum();
        for stroke in &strokes {
            let dashes = dashed(vec![stroke.clone()], &pattern, true);
            let length = stroke.length();
            let total: f64 = dashes.iter().map(Stroke::length).sum();
            if length < period {
                prop_assert_eq!(&dashes, std::slice::from_ref(stroke));
                continue;
            }
            // Dots add a tenth of a pixel each, and corners take what points within a thousandth leave out.
            let slack = 0.11 * dashes.len() as f64 + 0.01;
            prop_assert!((total - length * ink / period).abs() <= slack, "{} {}", total, length * ink / period);
            let ends = [&stroke.points[0], &stroke.points[stroke.points.len() - 1]].map(|p| p.position);
            if !stroke.closed {
                prop_assert_eq!(dashes[0].points[0].position, ends[0]);
                prop_assert_eq!(dashes[dashes.len() - 1].points.last().unwrap().position, ends[1]);
            }
        }
    }

    #[test]
    fn dashes_lie_on_the_line_one_after_the_other(strokes in strokes(), pattern in pattern(), fit: bool) {
        let dash = Dash { pattern_px: pattern.clone(), fit, by_texture: false };
        let mut after = strokes.clone();
        cut_to_dashes(&mut after, |_| Some(&dash));
        let count: usize = after.iter().map(|stroke| stroke.points.len()).sum();
        prop_assert!(count as u64 <= points_of_dashes(&strokes, |_| Some(&dash)));
        for stroke in &strokes {
            let dashes: Vec<&Stroke> = after.iter().filter(|dash| dash.id == stroke.id).collect();
            for point in dashes.iter().flat_map(|dash| &dash.points) {
                prop_assert!(distance_from(stroke, point.position) < 1e-6);
            }
            for dash in &dashes {
                prop_assert!(dash.points.len() >= 2);
                prop_assert!(dash.points.windows(2).all(|two| apart(two[0].position, two[1].position) > 0.0));
            }
            // Ways count pixels here, so gaps are differences of `u`.
            if dashes.len() < 2 {
                continue;
            }
            let ends = |dash: &Stroke| [dash.points[0].u, dash.points[dash.points.len() - 1].u];
            let length = stroke.length();
            let period: f64 = pattern.iter().sum();
            let scale = if fit { length / period / (length / period).round().max(1.0) } else { 1.0 };
            let mut gaps: Vec<f64> = dashes.windows(2).map(|two| ends(two[1])[0] - ends(two[0])[1]).collect();
            if stroke.closed {
                // A first dash that begins before the start counts from the round before.
                let from = ends(dashes[0])[0];
                let first = ends(dashes[0]);
                if first[1] > length {
                    gaps[0] += length;
                }
                let from = if from > 0.0 && first[1] > length { from - length } else { from };
                gaps.push(from + length - ends(dashes[dashes.len() - 1])[1]);
            }
            let last = gaps.len() - 1;
            let is_known = |(number, gap): (usize, &f64)| {
                // A dot takes a tenth of a pixel from the gaps beside it, half from either; one at an end of a line
                // takes all of it from the only gap that it has.
                let ends = [number == 0, number == last].map(|is_end| f64::from(is_end && !stroke.closed));
                let taken = 0.11 + 0.05 * (ends[0] + ends[1]);
                let known = pattern.iter().skip(1).step_by(2).map(|gap| gap * scale);
                known.into_iter().any(|known| *gap <= known + 1e-6 && *gap >= known - taken - 2e-3)
            };
            // Where a pattern breaks off at the start of a ring, the last gap may be cut off.
            let whole = gaps.len() - usize::from(stroke.closed && !fit);
            prop_assert!(gaps[..whole].iter().enumerate().all(is_known), "{:?} {:?} {}", gaps, pattern, scale);
        }
    }

    #[test]
    fn nothing_hostile_stops_it(
        places in hostile_places(), pattern in prop::collection::vec(hostile_length(), 0..9), fit: bool, closed: bool,
        by_texture: bool,
    ) {
        let strokes = vec![Stroke { closed, ..stroke_of(&places) }, line(100.0)];
        let dash = Dash { pattern_px: pattern, fit, by_texture };
        let bound = points_of_dashes(&strokes, |_| Some(&dash));
        // What a caller refuses is not drawn.
        prop_assume!(bound < 1_000_000);
        let mut after = strokes;
        cut_to_dashes(&mut after, |_| Some(&dash));
        let count: usize = after.iter().map(|stroke| stroke.points.len()).sum();
        prop_assert!(count as u64 <= bound);
        prop_assert!(after.last().unwrap().points.iter().all(|p| p.position[0] >= 20.0 && p.position[0] <= 120.0));
    }
}
