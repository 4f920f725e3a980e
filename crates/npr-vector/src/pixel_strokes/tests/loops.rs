//! Specks, filters, tangents and strips.

use crate::pixel_strokes::looped::{
    Filter, Gathered, Ordered, SpeckRule, Spot, drop_specks, fit_tangents, gather_sides, gaussian,
    smooth_loops, tent,
};
use crate::pixel_strokes::planar::Planar;
use crate::pixel_strokes::segment::Segment;
use crate::pixel_strokes::side::{Ink, InkPicture};
use crate::pixel_strokes::strip::{
    CullRule, StripSpot, cull_sides, drop_short, strips, vote_sides,
};
use crate::pixel_strokes::{ranked_sides, standings_of};
use crate::rank::scan::exclusive_scan;
use npr_core::geometry::NONE;
use proptest::prelude::*;

/// The spots of loops of these lengths.
fn spots_of(lengths: &[u32]) -> Vec<Spot> {
    let mut start = 0;
    let mut spots = Vec::new();
    for length in lengths {
        spots.extend(std::iter::repeat_n(
            Spot {
                start,
                length: *length,
            },
            *length as usize,
        ));
        start += length;
    }
    spots
}

fn lengths() -> impl Strategy<Value = Vec<u32>> {
    prop::collection::vec(1u32..40, 1..6)
}

/// The element `step` after another around its loop, by counting.
fn around(spots: &[Spot], element: usize, step: i64) -> usize {
    let spot = spots[element];
    let offset = element as i64 - i64::from(spot.start) + step;
    spot.start as usize + offset.rem_euclid(i64::from(spot.length)) as usize
}

/// Gathers the sides of an image, inked by one segment.
fn gathered(ink: &Ink<'_>, segment: Segment) -> (Vec<Spot>, Vec<Planar>, Vec<Planar>, Vec<u32>) {
    let picture = InkPicture {
        segments: &[segment],
        ..(*ink).into()
    };
    let (sides, ranked) = ranked_sides(&picture, &ink.bits(), None).expect("loops");
    let count = sides.len();
    let (mut spots, mut areas) = (vec![Spot::default(); count], vec![0; count]);
    let (mut places, mut directions) = (
        vec![Planar::default(); count],
        vec![Planar::default(); count],
    );
    let on = Ordered {
        width: ink.size[0],
        order: &ranked.order,
        standings: &standings_of(&ranked),
        sides: &sides,
    };
    let into = Gathered {
        spots: &mut spots,
        places: &mut places,
        directions: &mut directions,
        areas: &mut areas,
    };
    gather_sides(&on, into);
    (spots, places, directions, areas)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn areas_of_loops_add_up_to_the_ink(width in 1u32..12, cells in prop::collection::vec(any::<bool>(), 0..120)) {
        let height = cells.len() as u32 / width;
        let pixels: Vec<u32> = cells[..(width * height) as usize].iter().map(|c| u32::from(*c)).collect();
        let ink = Ink { size: [width, height], pixels: &pixels };
        let (spots, places, _, areas) = gathered(&ink, Segment::default());
        prop_assert_eq!(areas.iter().fold(0, |sum: u32, area| sum.wrapping_add(*area)), pixels.iter().sum::<u32>());
        // Neighbours along a loop lie half a pixel or a whole one apart.
        for (element, place) in places.iter().enumerate() {
            let next = places[around(&spots, element, 1)];
            let square = (next.x - place.x).powi(2) + (next.y - place.y).powi(2);
            prop_assert!([0.5, 1.0].contains(&square) || spots[element].length <= 2, "{square}");
        }
    }

    #[test]
    fn specks_are_loops_of_little_area(side in prop::array::uniform2(1u32..12)) {
        let [width, height] = side;
        let pixels = vec![1; (width * height) as usize];
        let (spots, _, _, areas) = gathered(&Ink { size: side, pixels: &pixels }, Segment::default());
        let rule = SpeckRule { area: 32.0, thin_area: 64.0, thinness: 1.0, unused: 0 };
        let mut kept = vec![7; spots.len()];
        drop_specks(&rule, &spots, &areas, &exclusive_scan(&areas).0, &mut kept);
        let area = width * height;
        let is_speck = area < 32 || area < 64 && area <= 2 * (width + height);
        prop_assert!(kept.iter().all(|kept| *kept == u32::from(!is_speck)));
    }

    #[test]
    fn filters_are_circular_means(
        lengths in lengths(), radius in 0u32..30, sigma in 0.3..9.0f32,
        values in prop::collection::vec(-9.0..9.0f32, 400),
    ) {
        let spots = spots_of(&lengths);
        let from: Vec<Planar> = (0..spots.len()).map(|i| Planar { x: values[i], y: values[i + 199] }).collect();
        let weights = gaussian(radius, sigma);
        let total: f64 = weights.iter().enumerate().map(|(i, w)| f64::from(*w) * if i == 0 { 1.0 } else { 2.0 }).sum();
        prop_assert!((total - 1.0).abs() < 1e-5 && weights.is_sorted_by(|a, b| a >= b));
        let mut to = vec![Planar::default(); from.len()];
        let filter = Filter { radius, ..Filter::default() };
        smooth_loops(&filter, &weights, &spots, &from, &mut to);
        for (element, found) in to.iter().enumerate() {
            let mut mean = [0.0f64; 2];
            for step in -i64::from(radius)..=i64::from(radius) {
                let there = from[around(&spots, element, step)];
                let weight = f64::from(weights[step.unsigned_abs() as usize]);
                mean = [mean[0] + weight * f64::from(there.x), mean[1] + weight * f64::from(there.y)];
            }
            prop_assert!((mean[0] - f64::from(found.x)).abs() < 1e-4 && (mean[1] - f64::from(found.y)).abs() < 1e-4);
        }
    }

    #[test]
    fn tangents_of_circles_and_lines_are_exact(
        count in 40u32..200, radius in 2.0..90.0f64, turn in 0.0..6.3f64, clockwise: bool,
    ) {
        let spots = spots_of(&[count]);
        let sign = if clockwise { -1.0 } else { 1.0 };
        let angle = |i: u32| turn + sign * std::f64::consts::TAU * f64::from(i) / f64::from(count);
        let place = |i| Planar {
            x: (radius * libm_cos(angle(i))) as f32,
            y: (radius * libm_sin(angle(i))) as f32,
        };
        let places: Vec<Planar> = (0..count).map(place).collect();
        let mut tangents = vec![Planar::default(); places.len()];
        fit_tangents(&Filter { radius: 12, ..Filter::default() }, &tent(12), &spots, &places, &mut tangents);
        for (i, tangent) in (0..).zip(&tangents) {
            let [x, y] = [-sign * libm_sin(angle(i)), sign * libm_cos(angle(i))];
            prop_assert!((f64::from(tangent.x) - x).abs() + (f64::from(tangent.y) - y).abs() < 2e-3);
        }
    }

    /// Against the least squares of a parabola over arc length, in double precision and by elimination.
    #[test]
    fn tangents_are_those_of_least_squares(
        steps in prop::collection::vec((-1.0..1.0f32, -1.0..1.0f32), 30..60), radius in 3u32..14,
    ) {
        let spots = spots_of(&[steps.len() as u32]);
        let mut at = Planar::default();
        let step = |(x, y): &(f32, f32)| {
            at = Planar { x: at.x + 1.5 + x, y: at.y + y };
            at
        };
        let places: Vec<Planar> = steps.iter().map(step).collect();
        let weights = tent(radius);
        let mut tangents = vec![Planar::default(); places.len()];
        fit_tangents(&Filter { radius, ..Filter::default() }, &weights, &spots, &places, &mut tangents);
        let whole = radius as usize..places.len() - radius as usize;
        for (element, found) in whole.clone().zip(&tangents[whole]) {
            let [x, y] = fitted(&places, &weights, element, radius as usize);
            let length = (x * x + y * y).sqrt();
            prop_assert!((f64::from(found.x) - x / length).abs() + (f64::from(found.y) - y / length).abs() < 1e-3);
        }
    }

    #[test]
    fn votes_are_counted(
        lengths in lengths(), kept in prop::collection::vec(0u32..2, 240), radius in 0u32..12, margin in 0u32..5,
    ) {
        let spots = spots_of(&lengths);
        let kept = &kept[..spots.len()];
        let rule = CullRule { vote_radius: radius, vote_margin: margin, ..CullRule::default() };
        let mut found = vec![7; spots.len()];
        vote_sides(&rule, &spots, kept, &mut found);
        for (element, found) in found.iter().enumerate() {
            let votes = (-i64::from(radius)..=i64::from(radius)).map(|step| kept[around(&spots, element, step)]);
            let (for_it, against) = votes.fold((0, 0), |(a, b), vote| (a + vote, b + 1 - vote));
            prop_assert_eq!(*found, u32::from(for_it >= against + margin));
        }
    }

    #[test]
    fn strips_are_what_a_walk_finds(
        lengths in lengths(),
        kept in prop::collection::vec(prop_oneof![3 => Just(1u32), 1 => Just(0u32)], 240), short in 0u32..6,
    ) {
        let spots = spots_of(&lengths);
        let kept = &kept[..spots.len()];
        let found = strips(&spots, kept);
        let mut expected = vec![StripSpot { start: NONE, rank: 0 }; spots.len()];
        let mut sizes = vec![0; spots.len()];
        for element in (0..spots.len()).filter(|element| kept[*element] != 0) {
            let length = spots[element].length;
            let is_kept = |step: &u32| kept[around(&spots, element, -i64::from(*step))] != 0;
            let back = (1..length).take_while(is_kept).count() as u32;
            let is_whole = back + 1 == length;
            let start = match is_whole {
                true => spots[element].start as usize,
                false => around(&spots, element, -i64::from(back)),
            };
            let rank = if is_whole { element as u32 - spots[element].start } else { back };
            expected[element] = StripSpot { start: start as u32, rank };
            sizes[start] += 1;
        }
        prop_assert_eq!(&found.spots, &expected);
        prop_assert_eq!(&found.lengths, &sizes);
        let mut left = kept.to_vec();
        drop_short(&CullRule { short, ..CullRule::default() }, &found.spots, &found.lengths, &mut left);
        for (element, left) in left.iter().enumerate() {
            let size = expected[element].start;
            prop_assert_eq!(*left, u32::from(size != NONE && sizes[size as usize] > short));
        }
    }

    #[test]
    fn of_a_line_one_of_both_ways_stays(length in 20u32..60, is_back: bool) {
        let pixels: Vec<u32> = (0..64 * 3).map(|i| u32::from(i / 64 == 1 && i % 64 < length)).collect();
        let ends = if is_back { [60.0, 0.0] } else { [0.0, 60.0] };
        let segment = Segment { start: [ends[0], 3.0], end: [ends[1], 3.0], ..Segment::default() };
        let (spots, places, directions, _) = gathered(&Ink { size: [64, 3], pixels: &pixels }, segment);
        let mut tangents = vec![Planar::default(); places.len()];
        fit_tangents(&Filter { radius: 6, ..Filter::default() }, &tent(6), &spots, &places, &mut tangents);
        let mut kept = vec![0; places.len()];
        let rule = CullRule { least_cos: 0.1, ..CullRule::default() };
        cull_sides(&rule, &tangents, &directions, &vec![1; places.len()], &mut kept);
        // Above where the line runs to the right, below where it runs back; the surface is on its left.
        let expected = if is_back { 2.0 } else { 1.0 };
        let held = places.iter().zip(&kept).filter(|(_, kept)| **kept != 0);
        let heights: Vec<f32> = held.map(|(place, _)| place.y).collect();
        let on_it = heights.iter().filter(|y| **y == expected).count();
        prop_assert!(on_it + 4 >= length as usize && heights.len() <= on_it + 2, "{on_it} {}", heights.len());
    }
}

/// The slope at an element of the parabola through it that fits the sides around it best.
fn fitted(places: &[Planar], weights: &[f32], element: usize, radius: usize) -> [f64; 2] {
    let at = |i: usize| [f64::from(places[i].x), f64::from(places[i].y)];
    let step =
        |i: usize| ((at(i + 1)[0] - at(i)[0]).powi(2) + (at(i + 1)[1] - at(i)[1]).powi(2)).sqrt();
    let mut m = [[0.0; 4]; 2];
    for i in element - radius..=element + radius {
        let s: f64 = if i < element {
            -(i..element).map(step).sum::<f64>()
        } else {
            (element..i).map(step).sum()
        };
        let basis = [s, s * s / 2.0];
        let weight = f64::from(weights[i.abs_diff(element)]);
        for row in 0..2 {
            for column in 0..2 {
                m[row][column] += weight * basis[row] * basis[column];
                m[row][2 + column] += weight * basis[row] * (at(i)[column] - at(element)[column]);
            }
        }
    }
    let factor = m[0][1] / m[1][1];
    [2, 3].map(|k| (m[0][k] - factor * m[1][k]) / (m[0][0] - factor * m[1][0]))
}

fn libm_cos(angle: f64) -> f64 {
    npr_core::math::cos_f64(angle)
}

fn libm_sin(angle: f64) -> f64 {
    npr_core::math::sin_f64(angle)
}
