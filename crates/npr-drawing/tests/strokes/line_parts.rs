//! The parts of a line that goes on behind something are drawn as parts of one stroke of a pen.

use npr_drawing::dash::{Dash, cut_to_dashes};
use npr_drawing::hand::{Hand, draw_by_hand};
use npr_drawing::ink::{BrushLay, Images, ink_points};
use npr_drawing::pressure::{Curve, Pressure, press_strokes};
use npr_vector::ink_point::InkPoint;
use npr_vector::stroke::{Drawing, Kind, LinePart, Stroke, StrokePoint, StrokeSurface};
use proptest::prelude::*;

const LENGTH: f64 = 500.0;

/// The part of a row of the picture between two places on it.
fn row(id: u64, [from, to]: [f64; 2]) -> Stroke {
    let is_whole = [from, to] == [0.0, LENGTH];
    let count = ((to - from) / 4.0).ceil();
    let points = (0..=count as u32).map(|number| {
        let x = from + (to - from) * f64::from(number) / count;
        StrokePoint {
            position: [x + 20.0, 40.0],
            width: 4.0,
            depth: 5.0,
            u: x,
            ..StrokePoint::default()
        }
    });
    Stroke {
        id,
        kind: Kind::Contour,
        occluders: 0,
        surface: 0,
        closed: false,
        part: (!is_whole).then_some(LinePart {
            line: 7,
            ends_px: [from, to],
            length_px: LENGTH,
        }),
        points: points.collect(),
    }
}

/// The whole row, and its two parts beside a gap, with names of their own.
fn rows([left, right]: [f64; 2]) -> [Vec<Stroke>; 2] {
    [
        vec![row(7, [0.0, LENGTH])],
        vec![row(7, [0.0, left]), row(91, [right, LENGTH])],
    ]
}

fn gap() -> impl Strategy<Value = [f64; 2]> {
    (100.0..250.0_f64, 10.0..150.0).prop_map(|(left, width)| [left, left + width])
}

/// What `value_of` gives for the points of strokes around a place on the row, blended.
fn at(strokes: &[Stroke], x: f64, value_of: impl Fn(&StrokePoint) -> f64) -> f64 {
    let pairs = strokes.iter().flat_map(|stroke| stroke.points.windows(2));
    let place = |point: &StrokePoint| point.position[0] - 20.0;
    let mut around = pairs.filter(|pair| place(&pair[0]) <= x && x <= place(&pair[1]));
    let pair = around.next().expect("ink there");
    let share = (x - place(&pair[0])) / (place(&pair[1]) - place(&pair[0]));
    value_of(&pair[0]) * (1.0 - share) + value_of(&pair[1]) * share
}

/// Places on both parts, so far from their ends.
fn places([left, right]: [f64; 2], away: f64) -> impl Iterator<Item = f64> {
    let spread = move |[from, to]: [f64; 2]| {
        let room = to - from - 2.0 * away;
        (0..=8).map(move |i| from + away + room * f64::from(i) / 8.0)
    };
    let parts = [[0.0, left], [right, LENGTH]].into_iter();
    parts
        .filter(move |[from, to]| to - from > 2.0 * away)
        .flat_map(spread)
}

proptest! {
    #[test]
    fn a_pen_is_pressed_as_along_the_whole_line(gap in gap(), heights in prop::array::uniform3(0.1..2.0_f64)) {
        let stops = [[0.0, heights[0]], [0.4, heights[1]], [1.0, heights[2]]];
        let pressure = Pressure { along: Curve::new(&stops), depth: Curve::default(), range: [0.0, 1.0] };
        let [mut whole, mut parts] = rows(gap);
        press_strokes(&mut whole, |_| Some(&pressure));
        press_strokes(&mut parts, |_| Some(&pressure));
        for x in places(gap, 0.01) {
            let [a, b] = [&whole, &parts].map(|strokes| at(strokes, x, |point| point.width));
            prop_assert!((a - b).abs() < 0.05, "{} and {} at {}", a, b, x);
        }
    }

    #[test]
    fn a_line_sways_on_behind_what_hides_it(gap in gap(), wave_px in 20.0..60.0_f64) {
        let hand = Hand { wobble_px: 3.0, wave_px, copies: 1, spread_px: 0.0, by_texture: false };
        let [mut whole, mut parts] = rows(gap);
        draw_by_hand(&mut whole, |_| Some(&hand));
        draw_by_hand(&mut parts, |_| Some(&hand));
        let sway = |strokes: &[Stroke], x: f64| at(strokes, x, |point| point.position[1] - 40.0);
        // Ends stay where they are.
        for x in places(gap, 0.5 * wave_px + 4.0) {
            let [a, b] = [&whole, &parts].map(|strokes| sway(strokes, x));
            prop_assert!((a - b).abs() < 0.3, "{} and {} at {}", a, b, x);
        }
    }

    #[test]
    fn dashes_go_on_behind_what_hides_them(gap in gap(), ink in 4.0..20.0_f64, paper in 3.0..20.0_f64) {
        let dash = Dash { pattern_px: vec![ink, paper], fit: false, by_texture: false };
        let [mut whole, mut parts] = rows(gap);
        cut_to_dashes(&mut whole, |_| Some(&dash));
        cut_to_dashes(&mut parts, |_| Some(&dash));
        let is_inked = |strokes: &[Stroke], x: f64| strokes.iter().any(|stroke| {
            let ends = [0, stroke.points.len() - 1].map(|i| stroke.points[i].position[0] - 20.0);
            ends[0] <= x && x <= ends[1]
        });
        for x in places(gap, 1.0) {
            let from_edge = (x % (ink + paper)).min((x - ink).rem_euclid(ink + paper));
            if from_edge > 1e-3 {
                prop_assert_eq!(is_inked(&whole, x), is_inked(&parts, x), "at {}", x);
            }
        }
    }

    #[test]
    fn the_image_of_a_brush_goes_on_behind_what_hides_it(gap in gap(), length in prop::option::of(20.0..900.0_f64)) {
        let lay = BrushLay { brush: 3, images: length.map_or(Images::Once, Images::ByLength) };
        let inked = |strokes: Vec<Stroke>| {
            let drawing = Drawing {
                size: [600, 80],
                surfaces: vec![StrokeSurface::default()],
                strokes,
                ..Drawing::default()
            };
            ink_points(&drawing, &|_| 1.0, &|_| lay)
        };
        let [whole, parts] = rows(gap).map(inked);
        // All points of the parts but those beside the gap are points of the row, too.
        let mirrored = whole[0].flags & InkPoint::MIRRORED;
        for point in &parts {
            prop_assert_eq!(point.flags & InkPoint::MIRRORED, mirrored);
            let behind = whole.partition_point(|other| other.px[0] < point.px[0]).clamp(1, whole.len() - 1);
            let (a, b) = (&whole[behind - 1], &whole[behind]);
            let share = (point.px[0] - a.px[0]) / (b.px[0] - a.px[0]);
            let expected = a.u + (b.u - a.u) * share;
            prop_assert!((point.u - expected).abs() < 2e-3, "{} but {}", point.u, expected);
        }
    }
}
