//! Strokes for the tests of what changes strokes.

use crate::fit::distance2_to_segment;
use kurbo::Point;
use npr_vector::stroke::{Kind, Stroke, StrokePoint};
use proptest::prelude::*;

/// Width and height of the picture that [`strokes`] lie in.
pub(crate) const SIZE: [u32; 2] = [400, 300];

/// A visible open stroke of width 3 whose texture coordinate counts pixels.
pub(crate) fn stroke_of(places: &[[f64; 2]]) -> Stroke {
    let mut u = 0.0;
    let points = places.iter().enumerate().map(|(i, position)| {
        let before = places[i.saturating_sub(1)];
        u += apart(before, *position);
        StrokePoint {
            position: *position,
            width: 3.0,
            depth: 5.0,
            u,
            ..StrokePoint::default()
        }
    });
    Stroke {
        id: 7,
        kind: Kind::Contour,
        occluders: 0,
        surface: 0,
        closed: false,
        part: None,
        points: points.collect(),
    }
}

/// The same, closed.
pub(crate) fn ring_of(places: &[[f64; 2]]) -> Stroke {
    Stroke {
        closed: true,
        ..stroke_of(places)
    }
}

/// Visible strokes, each with an id of its own; some are rings.
pub(crate) fn strokes() -> impl Strategy<Value = Vec<Stroke>> {
    let place = (2.0..390.0f64, 2.0..290.0f64);
    let one = (prop::collection::vec(place, 2..9), any::<bool>());
    prop::collection::vec(one, 1..8).prop_map(|all| {
        let numbered = (0..).zip(all);
        let strokes = numbered.map(|(id, (places, closed))| {
            // The simplest places have no two neighbours in one.
            let apart = (0..).zip(places);
            let places: Vec<[f64; 2]> = apart.map(|(i, (x, y))| [x + f64::from(i), y]).collect();
            Stroke {
                id: 1000 + id,
                closed: closed && places.len() > 2,
                ..stroke_of(&places)
            }
        });
        strokes.collect()
    })
}

/// Places that no stroke should have, and a few that it may.
pub(crate) fn hostile_places() -> impl Strategy<Value = Vec<[f64; 2]>> {
    let number = prop_oneof![
        any::<f64>(),
        Just(f64::NAN),
        Just(f64::INFINITY),
        -1e7..1e7f64,
        Just(50.0),
    ];
    prop::collection::vec(prop::array::uniform2(number), 0..6)
}

/// Lengths that no style should ask for, and some that it may.
pub(crate) fn hostile_length() -> impl Strategy<Value = f64> {
    let known = [0.0, -3.0, 1e-9, 1e30, f64::NAN, f64::INFINITY, 5.0];
    prop_oneof![any::<f64>(), prop::sample::select(known.to_vec())]
}

/// Distance of two places.
pub(crate) fn apart(a: [f64; 2], b: [f64; 2]) -> f64 {
    at(a).distance(at(b))
}

fn at([x, y]: [f64; 2]) -> Point {
    Point::new(x, y)
}

/// Distance of a place from a stroke, by trial of every piece.
pub(crate) fn distance_from(stroke: &Stroke, place: [f64; 2]) -> f64 {
    let points = &stroke.points;
    let count = points.len() - usize::from(!stroke.closed);
    let squares = (0..count).map(|i| {
        let [a, b] = [i, (i + 1) % points.len()].map(|i| at(points[i].position));
        distance2_to_segment(at(place), a, b)
    });
    squares.fold(f64::MAX, f64::min).sqrt()
}
