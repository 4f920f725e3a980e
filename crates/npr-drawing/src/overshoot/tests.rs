//! Ends of made-up strokes that are moved.

use super::*;
use crate::test_strokes::{
    SIZE, apart, hostile_length, hostile_places, ring_of, stroke_of, strokes,
};
use proptest::prelude::*;

fn moved(mut strokes: Vec<Stroke>, beyond_px: f64, short_px: f64) -> Vec<Stroke> {
    let overshoot = Overshoot {
        beyond_px,
        short_px,
    };
    move_ends(&mut strokes, SIZE, |_| Some(&overshoot));
    strokes
}

/// A straight line from x = 100 to x = 300, with an id.
fn line(id: u64) -> Stroke {
    Stroke {
        id,
        ..stroke_of(&[[100.0, 50.0], [140.0, 50.0], [300.0, 50.0]])
    }
}

/// By how many pixels both ends lie beyond those of [`line`].
fn beyond(stroke: &Stroke) -> [f64; 2] {
    let [first, last] = [stroke.points.first(), stroke.points.last()].map(|p| p.unwrap().position);
    assert_eq!([first[1], last[1]], [50.0; 2], "straight on");
    [100.0 - first[0], last[0] - 300.0]
}

#[test]
fn ends_run_on_by_half_of_it_to_all_of_it() {
    let all = moved((0..2000).map(line).collect(), 20.0, 0.0);
    let ends: Vec<f64> = all.iter().flat_map(beyond).collect();
    assert!(ends.iter().all(|px| (10.0..=20.0).contains(px)));
    let mean = ends.iter().sum::<f64>() / ends.len() as f64;
    assert!((mean - 15.0).abs() < 0.3, "{mean}");
    // Both ends of a stroke have chances of their own.
    let unlike = all.iter().map(beyond).filter(|[a, b]| (a - b).abs() > 1.0);
    assert!(unlike.count() > 1400);
}

#[test]
fn ends_stop_short_or_do_either() {
    let short = moved((0..2000).map(line).collect(), 0.0, 12.0);
    assert!(
        short
            .iter()
            .flat_map(beyond)
            .all(|px| (-12.0..=-6.0).contains(&px))
    );
    let either = moved((0..2000).map(line).collect(), 20.0, 12.0);
    let on = either.iter().flat_map(beyond).filter(|px| *px > 0.0);
    assert!((1800..2200).contains(&on.count()));
    assert!(
        either
            .iter()
            .flat_map(beyond)
            .all(|px| (10.0..=20.0).contains(&px) || (-12.0..=-6.0).contains(&px))
    );
}

#[test]
fn rings_hidden_lines_and_ends_at_the_border_stay() {
    let ring = ring_of(&[[50.0, 50.0], [90.0, 50.0], [90.0, 90.0]]);
    let hidden = Stroke {
        occluders: 1,
        ..line(3)
    };
    let cut = stroke_of(&[[0.5, 20.0], [160.0, 20.0]]);
    let before = vec![ring, hidden, cut];
    let after = moved(before.clone(), 20.0, 0.0);
    assert_eq!(after[..2], before[..2]);
    assert_eq!(after[2].points[0], before[2].points[0]);
    assert!(after[2].points.last().unwrap().position[0] >= 170.0);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    /// Ends run on along the last piece where that is long, and all between stays.
    #[test]
    fn lengths_change_by_what_is_asked(strokes in strokes(), px in 0.0..90.0f64, is_short: bool) {
        let [beyond, short] = if is_short { [0.0, px] } else { [px, 0.0] };
        let after = moved(strokes.clone(), beyond, short);
        for (old, new) in strokes.iter().zip(&after) {
            if old.closed {
                prop_assert_eq!(old, new);
                continue;
            }
            let gained = new.length() - old.length();
            let most = [0.12, 1.0 / 3.0][usize::from(is_short)] * old.length();
            let each = [0.5 * px, px].map(|px| px.min(most));
            let gained = if is_short { -gained } else { gained };
            // A line that turns back within its last pixels has no way on.
            let piece = |from: usize, to: usize| apart(old.points[from].position, old.points[to].position);
            let last = old.points.len() - 1;
            let has_way = is_short || piece(0, 1) > 6.0 && piece(last - 1, last) > 6.0;
            let least = if has_way { 2.0 * each[0] } else { 0.0 };
            prop_assert!(gained >= least - 1e-6 && gained <= 2.0 * each[1] + 1e-6, "{} {:?}", gained, each);
            prop_assert!(new.length() >= old.length() / 3.0 - 1e-6);
            if !is_short && has_way && px > 1.0 {
                let mut places: Vec<[f64; 2]> = new.points.iter().map(|point| point.position).collect();
                for _ in 0..2 {
                    let [tip, end, inner] = [places[0], places[1], places[2]];
                    let on = [0, 1].map(|i| [end[i] - inner[i], tip[i] - end[i]]);
                    let cross = on[0][0] * on[1][1] - on[0][1] * on[1][0];
                    let dot = on[0][0] * on[0][1] + on[1][0] * on[1][1];
                    prop_assert!(dot > 0.0 && cross.abs() < 1e-6 * dot);
                    places.reverse();
                }
            }
        }
        prop_assert_eq!(&moved(strokes, beyond, short), &after, "chance is the same again");
    }

    #[test]
    fn nothing_hostile_stops_it(
        places in hostile_places(), beyond in hostile_length(), short in hostile_length(),
    ) {
        let count = places.len();
        let after = moved(vec![stroke_of(&places), line(1)], beyond, short);
        prop_assert!(after[0].points.len() <= count + 2);
        prop_assert!(after[1].points.iter().all(|point| point.position[0].abs() <= 400.0));
        prop_assert!(after[1].length() >= 33.0);
    }
}
