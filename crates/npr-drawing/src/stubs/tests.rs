//! Stubs of made-up strokes, and what meets them by trial of every pair.

use super::*;
use crate::test_strokes::{
    SIZE, distance_from, hostile_length, hostile_places, ring_of, stroke_of, strokes,
};
use npr_vector::stroke::{Kind, StrokePoint};
use proptest::prelude::*;

const LEAST_PX: f64 = 40.0;

/// A frame around what the tests draw: nothing in it is at the outside.
fn frame() -> Stroke {
    let [right, low] = SIZE.map(|side| f64::from(side) - 0.25);
    Stroke {
        id: u64::MAX,
        ..ring_of(&[[0.25, 0.25], [right, 0.25], [right, low], [0.25, low]])
    }
}

/// The strokes that stay within a frame.
fn kept(mut strokes: Vec<Stroke>) -> Vec<Stroke> {
    strokes.push(frame());
    remove_stubs(&mut strokes, SIZE, |_| LEAST_PX);
    assert_eq!(strokes.pop(), Some(frame()));
    strokes
}

/// The numbers of the strokes that stay within a frame.
fn left(lines: &[&[[f64; 2]]]) -> Vec<u64> {
    let numbered = (0..).zip(lines);
    let strokes = numbered.map(|(id, places)| Stroke {
        id,
        ..stroke_of(places)
    });
    kept(strokes.collect())
        .iter()
        .map(|stroke| stroke.id)
        .collect()
}

#[test]
fn what_is_short_and_alone_goes() {
    let short: &[[f64; 2]] = &[[50.0, 50.0], [80.0, 50.0]];
    let long: &[[f64; 2]] = &[[50.0, 90.0], [95.0, 90.0]];
    assert_eq!(left(&[short, long]), [1]);
}

#[test]
fn rings_that_a_pen_fills_go() {
    let ring = |side: f64| {
        ring_of(&[
            [50.0, 50.0],
            [50.0 + side, 50.0],
            [50.0 + side, 50.0 + side],
            [50.0, 50.0 + side],
        ])
    };
    let [dot, eye] = [ring(4.9), ring(5.1)];
    assert_eq!(kept(vec![dot.clone(), eye.clone()]), [eye]);
    let hidden = Stroke {
        occluders: 1,
        ..dot
    };
    assert_eq!(
        kept(vec![hidden.clone()]),
        [hidden],
        "files may show hidden lines"
    );
}

#[test]
fn a_rung_stays_and_what_ends_in_the_open_goes() {
    let posts: [&[[f64; 2]]; 2] = [
        &[[50.0, 20.0], [50.0, 220.0]],
        &[[80.0, 20.0], [80.0, 220.0]],
    ];
    let rung: &[[f64; 2]] = &[[50.0, 60.0], [80.0, 60.0]];
    let half: &[[f64; 2]] = &[[50.0, 90.0], [65.0, 90.0]];
    assert_eq!(left(&[posts[0], posts[1], rung, half]), [0, 1, 2]);
}

/// Lines are 3 pixels wide.
#[test]
fn a_dash_between_two_lines_goes_unless_its_ink_touches_both() {
    let between = |right: f64, [from, to]: [f64; 2]| {
        let posts = [50.0, right].map(|x| [[x, 20.0], [x, 220.0]]);
        let dash = [[from, 60.0], [to, 60.0]];
        left(&[&posts[0], &posts[1], &dash]).contains(&2)
    };
    assert!(!between(63.0, [54.0, 59.0]), "gaps of a pixel are seen");
    assert!(!between(63.0, [53.4, 59.0]), "beside one of them, too");
    assert!(between(63.0, [53.4, 59.6]), "gaps of 0.4 are not");
    assert!(between(67.2, [54.0, 63.2]), "it is a line");
}

/// A mast on a roof is no stub, though its top is open.
#[test]
fn what_stands_out_stays() {
    let roof = ring_of(&[[50.0, 100.0], [150.0, 100.0], [150.0, 200.0], [50.0, 200.0]]);
    let inside = stroke_of(&[[100.0, 100.0], [100.0, 120.0]]);
    let mast = stroke_of(&[[100.0, 100.0], [100.0, 80.0]]);
    let mut strokes = vec![roof.clone(), inside, mast.clone()];
    remove_stubs(&mut strokes, SIZE, |_| LEAST_PX);
    assert_eq!(strokes, [roof, mast]);
}

#[test]
fn a_star_of_stubs_goes() {
    let arm = |x: f64, y: f64| [[100.0, 100.0], [100.0 + x, 100.0 + y]];
    let arms = [arm(30.0, 0.0), arm(-15.0, 26.0), arm(-15.0, -26.0)];
    assert!(left(&arms.each_ref().map(|arm| &arm[..])).is_empty());
}

/// A line through a star, and an arm that ends on it.
#[test]
fn a_star_of_a_line_and_a_stub_goes() {
    let line: &[[f64; 2]] = &[[82.0, 100.0], [118.0, 100.0]];
    let arm: &[[f64; 2]] = &[[100.0, 100.0], [100.0, 120.0]];
    assert_eq!(left(&[line, arm]), [0; 0]);
}

#[test]
fn what_a_rung_has_beyond_a_post_goes() {
    let posts: [&[[f64; 2]]; 2] = [
        &[[50.0, 20.0], [50.0, 220.0]],
        &[[70.0, 20.0], [70.0, 220.0]],
    ];
    let rung = [[40.0, 60.0], [70.0, 60.0]];
    let strokes = kept([posts[0], posts[1], &rung].map(stroke_of).to_vec());
    let ends =
        [strokes[2].points.first(), strokes[2].points.last()].map(|point| point.unwrap().position);
    assert!(
        (ends[0][0] - 50.0).abs() < 0.6 && ends[1] == rung[1],
        "{ends:?}"
    );
    assert_eq!(strokes[..2], posts.map(stroke_of));
}

#[test]
fn a_long_line_in_short_strokes_stays() {
    let piece = |i: u32| {
        [f64::from(i), f64::from(i + 1)].map(|i| [50.0 + 15.0 * i, 100.0 + (5.0 * i) % 10.0])
    };
    let pieces: Vec<_> = (0..5).map(piece).collect();
    let lines: Vec<&[[f64; 2]]> = pieces.iter().map(|piece| &piece[..]).collect();
    assert_eq!(left(&lines), [0, 1, 2, 3, 4]);
    assert!(left(&lines[..2]).is_empty());
}

#[test]
fn the_border_holds_ends() {
    let width = f64::from(SIZE[0]);
    let held: &[[f64; 2]] = &[[width, 50.0], [width - 20.0, 50.0]];
    let post: &[[f64; 2]] = &[[width - 20.0, 20.0], [width - 20.0, 220.0]];
    assert_eq!(left(&[held, post]), [0, 1]);
    assert_eq!(left(&[held]), [0; 0]);
}

proptest! {
    /// Dots go, and of others only short open visible strokes that may go lose anything; of those that are left none is
    /// alone; the order of strokes changes nothing.
    #[test]
    fn what_is_left_holds(strokes in strokes(), least_px in 10.0..300.0f64, turn in 0..8_usize) {
        let strokes: Vec<Stroke> = strokes
            .into_iter()
            .map(|stroke| Stroke { kind: Kind::ALL[stroke.id as usize % 2], ..stroke })
            .chain([frame()])
            .collect();
        let may_go = |stroke: &Stroke| stroke.kind == Kind::ALL[0];
        let left = |mut strokes: Vec<Stroke>| {
            remove_stubs(&mut strokes, SIZE, |stroke| if may_go(stroke) { least_px } else { 0.0 });
            strokes
        };
        let kept = left(strokes.clone());

        // Others stay, and what is left of one is a part of it.
        let is_short = |stroke: &Stroke| stroke.length() < least_px && !stroke.closed && may_go(stroke);
        for stroke in &strokes {
            let left = kept.iter().find(|other| other.id == stroke.id);
            let part = left.is_none_or(|left| {
                let on = |point: &StrokePoint| distance_from(stroke, point.position) < 1e-6;
                left.length() <= stroke.length() && left.points.iter().all(on)
            });
            let is_dot = stroke.closed && stroke.length() < 0.5 * least_px && may_go(stroke);
            prop_assert_eq!(is_dot && stroke.is_visible(), is_dot && left.is_none());
            prop_assert!(is_dot || left == Some(stroke) || is_short(stroke) && part);
        }

        // Something meets both ends of what is short and left, near to them; or it is a part of a longer line.
        let is_met = |stroke: &Stroke, place: [f64; 2]| {
            let others = kept.iter().filter(|other| other.id != stroke.id);
            let mut near = others.filter(|other| distance_from(other, place) <= MEETS_PX + HELD_PX);
            near.next().is_some() || is_cut_off(place, SIZE)
        };
        for stroke in kept.iter().filter(|stroke| is_short(stroke)) {
            let ends = [stroke.points[0].position, stroke.points[stroke.points.len() - 1].position];
            prop_assert!(ends.iter().any(|place| is_met(stroke, *place)), "{stroke:?}");
        }

        // Turn the list.
        let mut turned = strokes.clone();
        turned.rotate_left(turn % strokes.len());
        let ids = |strokes: &[Stroke]| {
            let mut ids: Vec<u64> = strokes.iter().map(|stroke| stroke.id).collect();
            ids.sort_unstable();
            ids
        };
        prop_assert_eq!(ids(&left(turned)), ids(&kept));
    }

    #[test]
    fn nothing_is_too_odd(places in hostile_places(), least_px in hostile_length()) {
        let mut strokes = vec![stroke_of(&places), stroke_of(&places)];
        remove_stubs(&mut strokes, SIZE, |_| least_px);
        prop_assert!(strokes.len() <= 2);
    }
}
