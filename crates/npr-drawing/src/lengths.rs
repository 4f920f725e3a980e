//! Strokes no longer than an arm reaches: longer lines are drawn in several.

use crate::arc::Measured;
use npr_core::math::mix_bits;
use npr_vector::stroke::Stroke;
use rayon::prelude::*;

/// Shortest limit, in pixels: no hand draws shorter strokes.
const LEAST_PX: f64 = 4.0;

/// Most strokes that one line becomes.
const PARTS_MAX: f64 = 1024.0;

/// Cuts each visible stroke that is longer than `longest_px` and for which `is_cut` is true into equal parts that are
/// not, 1024 at most. 0 or less cuts none, and less than 4 pixels are 4.
///
/// The parts of a ring are open, and begin where it did. Each has its own id, made of its stroke's and its number, so
/// that chance tells them apart; the first keeps that of the stroke. Strokes longer than a million pixels stay whole.
/// O(points + parts log points), on all threads, with the same result for any number of them.
pub fn cut_long_strokes(
    strokes: &mut Vec<Stroke>,
    longest_px: f64,
    is_cut: impl Fn(&Stroke) -> bool + Sync,
) {
    if longest_px > 0.0 && longest_px.is_finite() {
        let longest_px = longest_px.max(LEAST_PX);
        let all = std::mem::take(strokes).into_par_iter();
        let parts = all.flat_map_iter(|stroke| {
            let measured = match stroke.is_visible() && is_cut(&stroke) {
                true => Measured::new(&stroke),
                false => None,
            };
            match measured.filter(|line| line.length() > longest_px) {
                Some(line) => parts_of(&stroke, &line, longest_px),
                None => vec![stroke],
            }
        });
        *strokes = parts.collect();
    }
}

/// The parts of a stroke.
fn parts_of(stroke: &Stroke, line: &Measured, longest_px: f64) -> Vec<Stroke> {
    let count = (line.length() / longest_px).ceil().min(PARTS_MAX);
    let way = |number: u32| line.length() * f64::from(number) / count;
    let parts = (0..count as u32).map(|number| Stroke {
        id: id_of(stroke.id, number),
        closed: false,
        part: None,
        points: line.part(way(number), way(number + 1)),
        ..*stroke
    });
    parts.collect()
}

/// The id of a part by its number.
pub(crate) fn id_of(stroke: u64, number: u32) -> u64 {
    match number {
        0 => stroke,
        _ => stroke ^ (u64::from(mix_bits(number)) << 32 | u64::from(number)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_strokes::{hostile_length, hostile_places, ring_of, stroke_of, strokes};
    use proptest::prelude::*;
    use std::collections::BTreeSet;

    fn cut(mut strokes: Vec<Stroke>, longest_px: f64) -> Vec<Stroke> {
        cut_long_strokes(&mut strokes, longest_px, |_| true);
        strokes
    }

    #[test]
    fn a_line_becomes_equal_parts() {
        let line = stroke_of(&[[0.0, 10.0], [30.0, 10.0], [100.0, 10.0]]);
        let parts = cut(vec![line.clone()], 40.0);
        let ends = |stroke: &Stroke| {
            [stroke.points[0], *stroke.points.last().unwrap()].map(|p| p.position[0])
        };
        let thirds: Vec<[f64; 2]> = parts.iter().map(ends).collect();
        let near = |a: f64, b: f64| (a - b).abs() < 1e-9;
        let wanted = [
            [0.0, 100.0 / 3.0],
            [100.0 / 3.0, 200.0 / 3.0],
            [200.0 / 3.0, 100.0],
        ];
        assert_eq!(parts.len(), 3);
        assert!(
            thirds
                .iter()
                .flatten()
                .zip(wanted.iter().flatten())
                .all(|(a, b)| near(*a, *b))
        );
        assert_eq!(
            cut(vec![line.clone()], 100.0),
            std::slice::from_ref(&line),
            "as long as it may be"
        );
        assert_eq!(cut(vec![line.clone()], 0.0), [line], "no limit");
    }

    #[test]
    fn a_ring_becomes_open_parts() {
        let ring = ring_of(&[[0.0, 0.0], [40.0, 0.0], [40.0, 40.0], [0.0, 40.0]]);
        let parts = cut(vec![ring], 80.0);
        assert_eq!(parts.len(), 2);
        assert!(
            parts
                .iter()
                .all(|part| !part.closed && (part.length() - 80.0).abs() < 1e-9)
        );
    }

    proptest! {
        /// Parts are no longer than asked for, follow on each other, and are as long together as their line.
        #[test]
        fn parts_follow_on_each_other(before in strokes(), longest_px in 5.0..300.0f64) {
            let after = cut(before.clone(), longest_px);
            let mut parts = after.iter().peekable();
            for stroke in &before {
                let is_whole = !stroke.is_visible() || stroke.length() <= longest_px || stroke.length() <= 1e-3;
                if is_whole {
                    prop_assert_eq!(parts.next(), Some(stroke));
                    continue;
                }
                let count = (stroke.length() / longest_px).ceil() as usize;
                let own: Vec<&Stroke> = parts.by_ref().take(count).collect();
                let total: f64 = own.iter().map(|part| part.length()).sum();
                prop_assert!((total - stroke.length()).abs() < 1e-6 * total.max(1.0));
                prop_assert!(own.iter().all(|part| part.length() <= longest_px * (1.0 + 1e-9)));
                for pair in own.windows(2) {
                    prop_assert_eq!(pair[0].points.last().unwrap().position, pair[1].points[0].position);
                }
                let ids: BTreeSet<u64> = own.iter().map(|part| part.id).collect();
                prop_assert_eq!(ids.len(), own.len());
            }
            prop_assert!(parts.next().is_none());
        }

        /// Whatever strokes and limits hold, there are few parts, and nothing breaks.
        #[test]
        fn hostile_strokes_stay_few(places in hostile_places(), closed: bool, longest_px in hostile_length()) {
            let stroke = if closed { ring_of(&places) } else { stroke_of(&places) };
            prop_assert!(cut(vec![stroke], longest_px).len() <= 1024);
        }
    }
}
