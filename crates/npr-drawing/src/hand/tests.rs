//! What a hand makes of made-up strokes: how far it strays, where it holds, how often it draws.

use super::*;
use crate::test_strokes::{
    apart, distance_from, hostile_length, hostile_places, ring_of, stroke_of, strokes,
};
use proptest::prelude::*;

const CALM: Hand = Hand {
    wobble_px: 4.0,
    wave_px: 40.0,
    copies: 1,
    spread_px: 3.0,
    by_texture: false,
};

fn drawn(mut strokes: Vec<Stroke>, hand: &Hand) -> Vec<Stroke> {
    draw_by_hand(&mut strokes, |_| Some(hand));
    strokes
}

fn line(id: u64) -> Stroke {
    Stroke {
        id,
        ..stroke_of(&[[20.0, 50.0], [1020.0, 50.0]])
    }
}

/// A circle of 90 points.
fn circle(radius: f64) -> Stroke {
    let turn = |i: u32| f64::from(i) * std::f64::consts::PI / 45.0;
    let places: Vec<[f64; 2]> = (0..90)
        .map(|i| {
            [
                200.0 + radius * turn(i).cos(),
                150.0 + radius * turn(i).sin(),
            ]
        })
        .collect();
    ring_of(&places)
}

/// A line that was cut off at its start sways as it did, away from the ends, where its texture stays.
#[test]
fn a_line_by_texture_sways_as_it_did_before_its_start_moved() {
    let places =
        |from: u32| -> Vec<[f64; 2]> { (from..=30).map(|i| [10.0 * f64::from(i), 50.0]).collect() };
    let sways = |by_texture| {
        let hand = Hand { by_texture, ..CALM };
        let [whole, part] = [0_u32, 7].map(|from| {
            let mut stroke = stroke_of(&places(from));
            for point in &mut stroke.points {
                point.u = point.position[0];
            }
            let mut strokes = vec![stroke];
            draw_by_hand(&mut strokes, |_| Some(&hand));
            strokes.remove(0)
        });
        let near = |u: f64| part.points.iter().find(|point| (point.u - u).abs() < 1e-6);
        let middle = whole
            .points
            .iter()
            .filter(|point| (150.0..220.0).contains(&point.u));
        let pairs: Vec<f64> = middle
            .filter_map(|point| Some(near(point.u)?.position[1] - point.position[1]))
            .collect();
        assert!(pairs.len() > 5);
        pairs.into_iter().map(f64::abs).fold(0.0, f64::max)
    };
    assert!(sways(true) < 1e-6, "{}", sways(true));
    assert!(sways(false) > 0.1, "{}", sways(false));
}

#[test]
fn a_straight_line_sways_both_ways_and_ends_where_it_ended() {
    let swayed = &drawn(vec![line(1)], &CALM)[0];
    let off: Vec<f64> = swayed
        .points
        .iter()
        .map(|point| point.position[1] - 50.0)
        .collect();
    let most = off.iter().fold(0.0, |most: f64, px| most.max(px.abs()));
    assert!(most < 4.0 && most > 2.0, "{most}");
    let ends = [&swayed.points[0], &swayed.points[off.len() - 1]].map(|p| p.position);
    assert_eq!(ends, [[20.0, 50.0], [1020.0, 50.0]]);
}

/// A wave crosses the line twice: 25 waves are on each of these lines.
#[test]
fn waves_are_about_as_long_as_asked() {
    let all = drawn((0..40).map(line).collect(), &CALM);
    let crossings = |stroke: &Stroke| {
        let two = stroke.points.windows(2);
        two.filter(|two| (two[0].position[1] - 50.0) * (two[1].position[1] - 50.0) < 0.0)
            .count()
    };
    let mean = all.iter().map(crossings).sum::<usize>() as f64 / 40.0;
    assert!((45.0..55.0).contains(&mean), "{mean}");
}

/// A kink bends the more, the closer it is looked at; a smooth course does not.
#[test]
fn a_sway_has_no_kinks() {
    for comes_back in [false, true] {
        let sway = Sway::new(&CALM, (0.0, 1000.0), Seed::new(1, 0), comes_back);
        let bend = |apart: f64| {
            let bends = (1..99_000).map(|i| {
                let [before, here, after] =
                    [-1.0, 0.0, 1.0].map(|side| sway.at(0.01 * f64::from(i) + side * apart)[0]);
                (before - 2.0 * here + after).abs() / (apart * apart)
            });
            bends.fold(0.0, f64::max)
        };
        let [wide, close] = [bend(0.5), bend(0.005)];
        assert!(close < 1.5 * wide, "{wide} {close}");
    }
    // Where a ring begins it goes on as it ends.
    let ring = Sway::new(&CALM, (0.0, 333.0), Seed::new(1, 0), true);
    for i in [0, 1] {
        let [start, soon, late, end] = [0.0, 1e-4, 333.0 - 1e-4, 333.0].map(|way| ring.at(way)[i]);
        assert!((start - end).abs() < 1e-9 && ((soon - start) - (end - late)).abs() < 1e-6);
    }
}

#[test]
fn each_line_and_each_copy_sways_for_itself() {
    let three = Hand { copies: 3, ..CALM };
    let all = drawn(vec![line(1), line(1), line(2)], &three);
    assert_eq!(all.len(), 9);
    assert_eq!(all[0..3], all[3..6]);
    let heights = |stroke: &Stroke| -> Vec<f64> {
        let at = |x: f64| {
            let nearest = stroke.points.iter().min_by(|a, b| {
                (a.position[0] - x)
                    .abs()
                    .total_cmp(&(b.position[0] - x).abs())
            });
            nearest.unwrap().position[1] - 50.0
        };
        (1..10).map(|i| at(20.0 + 100.0 * f64::from(i))).collect()
    };
    for (one, other) in [(0, 1), (1, 2), (0, 2), (0, 6), (1, 7)] {
        let [one, other] = [one, other].map(|i| heights(&all[i]));
        let apart: f64 = one.iter().zip(&other).map(|(a, b)| (a - b).abs()).sum();
        assert!(apart > 4.0, "{one:?} {other:?}");
    }
}

/// The image of a brush lies elsewhere on every copy, and runs on as on the line.
#[test]
fn each_copy_has_its_own_place_in_the_image() {
    let all = drawn(vec![line(1), line(2)], &Hand { copies: 8, ..CALM });
    let ahead = |stroke: &Stroke| stroke.points[0].u - stroke.points[0].position[0];
    for strokes in all.chunks(8) {
        let mut places: Vec<f64> = strokes.iter().map(ahead).collect();
        places.sort_by(f64::total_cmp);
        assert!(
            places.windows(2).all(|two| two[1] - two[0] > 4.0),
            "{places:?}"
        );
        for stroke in strokes {
            let [first, last] = [&stroke.points[0], &stroke.points[stroke.points.len() - 1]];
            let along = last.position[0] - first.position[0];
            // Ends sway and lie beside the line by at most this much each.
            let most = 2.0 * (CALM.wobble_px + 2.0 * CALM.spread_px);
            assert!((last.u - first.u - along).abs() < most);
        }
    }
}

/// A line that ends on another one still does once both sway; the other way round, a free end stays.
#[test]
fn ends_follow_the_line_that_they_lie_on() {
    let wild = Hand {
        wobble_px: 12.0,
        wave_px: 150.0,
        ..CALM
    };
    let (mut farthest, mut strayed): (f64, f64) = (0.0, 0.0);
    for id in 0..200 {
        let at = 200.0 + 3.0 * id as f64;
        let branch = Stroke {
            id: 1000 + id,
            // Lines are 3 pixels wide.
            ..stroke_of(&[[at, 50.0 + 0.02 * id as f64], [at + 30.0, 250.0]])
        };
        let both = drawn(vec![line(id), branch.clone()], &wild);
        let [first, last] = [&both[1].points[0], both[1].points.last().unwrap()];
        assert_eq!(last.position, branch.points[1].position);
        let gap = branch.points[0].position[1] - 50.0;
        farthest = farthest.max(distance_from(&both[0], first.position) - gap);
        strayed = strayed.max(apart(first.position, branch.points[0].position));
        // Alone it keeps both ends.
        let alone = drawn(vec![branch.clone()], &wild);
        assert_eq!(alone[0].points[0].position, branch.points[0].position);
    }
    // Chords of the swayed line lie beside its curve: second derivatives of both splines times the step squared, by 8.
    assert!(farthest < 0.17, "{farthest}");
    assert!(strayed > 8.0, "{strayed}");
}

#[test]
fn copies_of_a_ruler_are_straight_and_lie_beside() {
    let ruled = Hand {
        wobble_px: 0.0,
        copies: 8,
        ..CALM
    };
    let all = drawn(vec![line(5)], &ruled);
    assert_eq!(all.len(), 8);
    assert_eq!(all[0], line(5));
    for copy in &all[1..] {
        let [a, b] = [&copy.points[0], copy.points.last().unwrap()].map(|p| p.position);
        assert!(a != [20.0, 50.0] && b != [1020.0, 50.0]);
        for (end, place) in [(a, [20.0, 50.0]), (b, [1020.0, 50.0])] {
            let [along, across] = [0, 1].map(|i| (end[i] - place[i]).abs());
            assert!(
                along <= 4.0 * 3.0 && across <= 3.0,
                "an end by three spreads, and all by one: {along} {across}"
            );
        }
        // It is turned: its ends lie beside the line by amounts of their own.
        assert!((a[1] - b[1]).abs() > 0.05 && (a[1] - 50.0).abs() + (b[1] - 50.0).abs() > 0.3);
        // All between lies on the straight line between the ends.
        let rise = (b[1] - a[1]) / (b[0] - a[0]);
        let off = |p: &StrokePoint| p.position[1] - a[1] - rise * (p.position[0] - a[0]);
        assert!(copy.points.iter().all(|point| off(point).abs() < 0.1));
    }
}

#[test]
fn rings_come_back_and_their_copies_run_on() {
    let hand = Hand { copies: 4, ..CALM };
    let all = drawn(vec![circle(80.0)], &hand);
    assert!(all[0].closed && all[1..].iter().all(|copy| !copy.closed));
    // The closing piece is as short as the others: nothing leaps where the ring begins.
    let points = &all[0].points;
    let closing = apart(points[0].position, points[points.len() - 1].position);
    assert!(closing < 3.0, "{closing}");
    // Its start sways as all of it does.
    let starts = (0..40).map(|id| {
        let ring = Stroke { id, ..circle(80.0) };
        let swayed = drawn(vec![ring.clone()], &CALM);
        apart(swayed[0].points[0].position, ring.points[0].position)
    });
    assert!(starts.fold(0.0, f64::max) > 2.0);
    for copy in &all[1..] {
        let over = copy.length() - circle(80.0).length();
        assert!(over > 1.0 && over < 63.0, "{over}");
        // Texture only grows, round the start too.
        let us = copy.points.windows(2).map(|two| two[1].u - two[0].u);
        assert!(us.fold(f64::MAX, f64::min) > -1e-9);
    }
}

#[test]
fn small_rings_stay_rings() {
    let wild = Hand {
        wobble_px: 50.0,
        copies: 3,
        spread_px: 50.0,
        ..CALM
    };
    for stroke in drawn(vec![circle(3.0)], &wild) {
        let far = stroke
            .points
            .iter()
            .map(|point| apart(point.position, [200.0, 150.0]));
        assert!(far.fold(0.0, f64::max) < 3.0 * 3.0);
    }
}

#[test]
fn a_ruler_that_draws_once_changes_nothing() {
    let none = Hand {
        wobble_px: 0.0,
        copies: 1,
        ..CALM
    };
    let hidden = Stroke {
        occluders: 2,
        ..line(1)
    };
    assert!(none.is_none());
    assert_eq!(drawn(vec![line(1)], &none), vec![line(1)]);
    assert_eq!(drawn(vec![hidden.clone()], &CALM), vec![hidden]);
    let mut kept = vec![line(1)];
    draw_by_hand(&mut kept, |_| None);
    assert_eq!(kept, vec![line(1)]);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn nothing_strays_farther_than_asked(
        strokes in strokes(), wobble in 0.0..20.0f64, wave in 1.0..200.0f64, copies in 1u32..9, spread in 0.0..20.0f64,
    ) {
        let hand = Hand { wobble_px: wobble, wave_px: wave, copies, spread_px: spread, by_texture: false };
        let after = drawn(strokes.clone(), &hand);
        prop_assert_eq!(after.len(), strokes.len() * copies as usize);
        let count: usize = after.iter().map(|stroke| stroke.points.len()).sum();
        prop_assert!(count as u64 <= points_by_hand(&strokes, |_| Some(&hand)));
        for (old, new) in strokes.iter().zip(after.chunks(copies as usize)) {
            let own = &new[0];
            prop_assert!(new.iter().all(|copy| copy.id == old.id));
            prop_assert!(own.points.iter().all(|p| distance_from(old, p.position) <= wobble + 1e-6));
            let others = || strokes.iter().filter(|other| other.id != old.id || old.points.len() > 2);
            let ends = [old.points.first().zip(own.points.first()), old.points.last().zip(own.points.last())];
            for (before, after) in ends.into_iter().flatten().filter(|_| !old.closed) {
                // An end that meets no line, its own included, stays.
                let is_free = others().all(|other| other.id != old.id && distance_from(other, before.position) > 4.6);
                prop_assert!(!is_free || after.position == before.position);
            }
            for copy in &new[1..] {
                // Its ends may also lie three spreads farther on.
                let most = wobble + 4.0 * spread + 1e-6;
                prop_assert!(copy.points.iter().all(|p| distance_from(old, p.position) <= most));
                let inner = copy.points.iter().filter(|p| old.closed || {
                    let ends = [old.points[0].position, old.points[old.points.len() - 1].position];
                    ends.iter().all(|end| apart(*end, p.position) > 5.0 * spread + wobble)
                });
                for point in inner {
                    prop_assert!(distance_from(old, point.position) <= wobble + spread + 1e-6);
                }
            }
        }
        prop_assert_eq!(&drawn(strokes, &hand), &after, "chance is the same again");
    }

    #[test]
    fn any_number_of_threads_draws_the_same(strokes in strokes()) {
        let hand = Hand { copies: 3, ..CALM };
        let of_threads = |count: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build().unwrap();
            pool.install(|| drawn(strokes.clone(), &hand))
        };
        prop_assert_eq!(of_threads(1), of_threads(5));
    }

    #[test]
    fn nothing_hostile_stops_it(
        places in hostile_places(), wobble in hostile_length(), wave in hostile_length(), copies: u32,
        spread in hostile_length(), closed: bool,
    ) {
        let hand = Hand { wobble_px: wobble, wave_px: wave, copies, spread_px: spread, by_texture: false };
        let strokes = vec![Stroke { closed, ..stroke_of(&places) }, line(1)];
        let bound = points_by_hand(&strokes, |_| Some(&hand));
        // What a caller refuses is not drawn.
        prop_assume!(bound < 1_000_000);
        let after = drawn(strokes, &hand);
        let count: usize = after.iter().map(|stroke| stroke.points.len()).sum();
        prop_assert!(count as u64 <= bound && after.len() <= 16);
        let mut own = after.iter().filter(|stroke| !stroke.closed && stroke.points.len() > 1);
        let is_near = |p: &StrokePoint| p.position.iter().all(|at| at.abs() < 2000.0);
        prop_assert!(own.next_back().unwrap().points.iter().all(is_near));
    }
}
